import { Matrix4, Quaternion, Vector3 } from "three";
import { describe, expect, it } from "vitest";
import { drawnFromWorld } from "../../src/core/frames.ts";
import { axesOf, clipFromCamera, drawnFromCamera, onPicture } from "../../src/core/pinhole.ts";
import type { Shot } from "../../src/core/place.ts";

const [WIDTH, HEIGHT] = [640, 400];

/** Turned about all axes, with a principal point off the middle; `size` scales the frame. */
function shot(size = 1): Shot {
  const turn = new Quaternion(0.3, -0.5, 0.2, 0.7).normalize();
  const matrix = new Matrix4().compose(new Vector3(4, -7, 2), turn, new Vector3(size, size, size));
  return {
    id: "a",
    name: "a.jpg",
    picture: "a.jpg",
    width_px: WIDTH,
    height_px: HEIGHT,
    focal_px: [510, 480],
    centre_px: [330, 170],
    worldFromCamera: matrix.toArray(),
  };
}

/** A point that lies at these pixels at this depth, by the pinhole's own formula. */
function pointAt(seen: Shot, x: number, y: number, depth: number): [number, number, number] {
  const inCamera = new Vector3((depth * (x - 330)) / 510, (depth * (y - 170)) / 480, depth);
  const point = inCamera.applyMatrix4(new Matrix4().fromArray([...seen.worldFromCamera]));
  return [point.x, point.y, point.z];
}

const PIXELS = [
  [0, 0, 3],
  [WIDTH, 0, 10],
  [0, HEIGHT, 1.5],
  [WIDTH, HEIGHT, 80],
  [330, 170, 5],
  [17, 333, 42],
] as const;

describe("a photo as a camera", () => {
  it.each(PIXELS)("finds the pixel %s, %s of a point %s deep", (x, y, depth) => {
    const seen = shot();
    const at = onPicture(seen, axesOf(seen), pointAt(seen, x, y, depth));
    expect(at?.x).toBeCloseTo(x, 8);
    expect(at?.y).toBeCloseTo(y, 8);
    expect(at?.depth).toBeCloseTo(depth, 8);
  });

  it("sees nothing behind it", () => {
    const seen = shot();
    expect(onPicture(seen, axesOf(seen), pointAt(seen, 100, 100, -2))).toBeNull();
  });

  it("keeps unit axes where the place is larger than the photo says", () => {
    const { right, down, ahead } = axesOf(shot(3));
    for (const axis of [right, down, ahead]) expect(Math.hypot(...axis)).toBeCloseTo(1, 12);
  });

  it.each(PIXELS)("projects pixel %s, %s to the same share of the screen", (x, y, depth) => {
    const seen = shot();
    const [near, far] = [0.5, 100];
    const camera = new Matrix4().fromArray(drawnFromCamera(axesOf(seen))).invert();
    const clip = new Matrix4().fromArray(clipFromCamera(seen, near, far)).multiply(camera);
    const point = new Vector3(...drawnFromWorld(pointAt(seen, x, y, depth)));
    const onScreen = point.clone().applyMatrix4(clip);
    expect(onScreen.x).toBeCloseTo((2 * x) / WIDTH - 1, 8);
    expect(onScreen.y).toBeCloseTo(1 - (2 * y) / HEIGHT, 8);
    // As the shader reads the depth picture back.
    const d = 0.5 + 0.5 * onScreen.z;
    expect((near * far) / (far - d * (far - near))).toBeCloseTo(depth, 6);
  });
});
