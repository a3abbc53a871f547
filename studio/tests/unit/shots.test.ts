import { describe, expect, it } from "vitest";
import { Fault } from "../../src/core/fault.ts";
import { readPlace, type Shot } from "../../src/core/place.ts";
import { boundsOfShots, cornersOfShot, depthOfFrusta, fovOfShot, outlookOf } from "../../src/core/shots.ts";

const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

function shot(change: Partial<Shot> = {}): Shot {
  return {
    id: "photo-1",
    name: "1.jpg",
    picture: "pictures/1.jpg",
    width_px: 600,
    height_px: 400,
    focal_px: [500, 500],
    centre_px: [300, 200],
    worldFromCamera: IDENTITY,
    ...change,
  };
}

function at(x: number, y: number, z: number): Shot {
  return shot({ worldFromCamera: [...IDENTITY.slice(0, 12), x, y, z, 1] });
}

describe("the corners of a photo", () => {
  it("project to the corners of its picture", () => {
    const seen = shot({ centre_px: [310, 180], focal_px: [500, 450] });
    const onPicture = cornersOfShot(seen, 2).map(([x, y, z]) => [
      (500 * x) / z + 310,
      (450 * y) / z + 180,
    ]);
    const wanted = [[0, 0], [600, 0], [0, 400], [600, 400]];
    for (const [k, corner] of onPicture.entries()) {
      expect(corner[0]).toBeCloseTo(wanted[k]?.[0] ?? NaN, 9);
      expect(corner[1]).toBeCloseTo(wanted[k]?.[1] ?? NaN, 9);
    }
  });
});

describe("the view that shows a photo whole", () => {
  it.each([[0.5], [1], [1.5], [3]])("holds all corners on a screen of aspect %s", (aspect) => {
    const seen = shot({ centre_px: [340, 170] });
    const { fov_deg, shift } = fovOfShot(seen, aspect);
    const half = Math.tan((fov_deg * Math.PI) / 360);
    // Shares of the screen, from its middle: where the lens's axis is, and the corners about it.
    const places = cornersOfShot(seen, 1).map(([x, y]) => [
      shift[0] + x / (2 * half * aspect),
      shift[1] + y / (2 * half),
    ]);
    const xs = places.map(([x]) => x ?? NaN);
    const ys = places.map(([, y]) => y ?? NaN);
    expect(Math.min(...xs) + Math.max(...xs)).toBeCloseTo(0, 9);
    expect(Math.min(...ys) + Math.max(...ys)).toBeCloseTo(0, 9);
    const largest = Math.max(...xs, ...ys);
    expect(largest).toBeLessThan(0.5);
    expect(largest).toBeGreaterThan(0.42);
  });
});

describe("the pyramids", () => {
  it("are small in the place, and do not touch their neighbours", () => {
    expect(depthOfFrusta([at(0, 0, 0)], 100)).toBeCloseTo(4.5);
    expect(depthOfFrusta([at(0, 0, 0), at(2, 0, 0), at(4, 0, 0)], 100)).toBeCloseTo(1.2);
    expect(depthOfFrusta([at(0, 0, 0), at(0, 0, 0)], 100)).toBeCloseTo(0.8);
  });

  it("lie in the box of the place", () => {
    const cloud = {
      file: "points.ply",
      layer: "points",
      worldFromPoints: [...IDENTITY.slice(0, 12), 10, 0, 0, 1],
      count: null,
      bounds: { min: [0, 0, 0], max: [1, 2, 3] },
    } as const;
    expect(boundsOfShots([cloud], [at(-5, 0, 7)])).toEqual({ min: [-5, 0, 0], max: [11, 2, 7] });
  });
});

describe("where photos look to", () => {
  /** Its axis at an angle from east towards north, dipped by 30 degrees. */
  const towards = (degrees: number): Shot => {
    const [c, s] = [Math.cos((degrees * Math.PI) / 180), Math.sin((degrees * Math.PI) / 180)];
    const [level, dip] = [Math.sqrt(3) / 2, 0.5];
    const axes = [s, -c, 0, 0, -dip * c, -dip * s, -level, 0, level * c, level * s, -dip, 0];
    return shot({ worldFromCamera: [...axes, 7, 8, 9, 1] });
  };

  it("is level, and in the middle of them", () => {
    const outlook = outlookOf([towards(100), towards(160), towards(130)]);
    expect(outlook?.[0]).toBeCloseTo(Math.cos((130 * Math.PI) / 180), 9);
    expect(outlook?.[1]).toBeCloseTo(Math.sin((130 * Math.PI) / 180), 9);
    expect(outlook?.[2]).toBe(0);
  });

  it("is nowhere where they look all about, or where there are none", () => {
    expect(outlookOf([0, 90, 180, 270].map(towards))).toBeNull();
    expect(outlookOf([])).toBeNull();
  });
});

describe("reading a place of photos", () => {
  const camera = {
    id: "photo-1",
    name: "1.jpg",
    picture: "pictures/1.jpg",
    width_px: 600,
    height_px: 400,
    focal_px: [500, 510],
    centre_px: [300, 200],
    transform: IDENTITY,
  };
  const text = (cameraChange: object = {}, cloudChange: object = {}): string =>
    JSON.stringify({
      schema: "veduta/place",
      version: 1,
      parts: [],
      points: [{ id: "points", file: "points.ply", count: 3, bounds: { min: [0, 0, 0], max: [1, 1, 1] }, ...cloudChange }],
      cameras: [{ ...camera, ...cameraChange }],
      scale: "unknown",
      start: { eye: [0, -10, 1.7], target: [0, 0, 2] },
    });

  it("needs no parts", () => {
    const place = readPlace(text(), "place.json");
    expect(place.shots[0]?.focal_px).toEqual([500, 510]);
    expect(place.clouds[0]?.worldFromPoints).toEqual(IDENTITY);
    expect(place.scaleKnown).toBe(false);
    expect(place.clouds[0]?.layer).toBe("points");
  });

  it("has points again by their distances", () => {
    expect(readPlace(text({}, { layer: "distances" }), "place.json").clouds[0]?.layer).toBe("distances");
  });

  it.each([
    ["a picture elsewhere", { picture: "../a.jpg" }, {}, "picture"],
    ["a focal length of zero", { focal_px: [0, 500] }, {}, "focal_px"],
    ["a size that is none", { width_px: "wide" }, {}, "width_px"],
    ["a short transform", { transform: [1, 2] }, {}, "transform"],
    ["points elsewhere", {}, { file: "/etc/passwd" }, "file"],
    ["a box inside out", {}, { bounds: { min: [2, 0, 0], max: [1, 1, 1] } }, "bounds"],
    ["no box", {}, { bounds: null }, "bounds"],
    ["a layer that is none", {}, { layer: "walls" }, "layer"],
  ])("refuses %s", (_, cameraChange, cloudChange, words) => {
    expect(() => readPlace(text(cameraChange, cloudChange), "place.json")).toThrow(Fault);
    expect(() => readPlace(text(cameraChange, cloudChange), "place.json")).toThrow(words);
  });
});
