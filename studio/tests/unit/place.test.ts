import { describe, expect, it } from "vitest";
import { Fault } from "../../src/core/fault.ts";
import { cornersOfPlace, fileAddress, isInside, placeAddress, readPlace, standsAlone } from "../../src/core/place.ts";

function manifest(change: Record<string, unknown> = {}, part: Record<string, unknown> = {}): string {
  return JSON.stringify({
    schema: "veduta/place",
    version: 1,
    parts: [
      {
        id: "a",
        name: "A",
        model: "a/model.glb",
        photo: "a/rectified.jpg",
        transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 7, 8, 9, 1],
        arrangement: "single",
        bounds: { min: [0, 0, 0], max: [1, 1, 1] },
        ...part,
      },
    ],
    start: { eye: [0, -10, 1.7], target: [0, 0, 2] },
    ...change,
  });
}

describe("what stands alone", () => {
  const house = { name: "House", arrangement: "single" } as const;
  const garden = { name: "Garden", arrangement: "invented" } as const;

  it("is the house, not its garden", () => {
    expect(standsAlone([house, garden])?.name).toBe("House");
  });

  it("is none of several buildings that somebody arranged", () => {
    expect(standsAlone([garden, garden])).toBeNull();
    expect(standsAlone([])).toBeNull();
  });
});

describe("reading a place", () => {
  it("hides at first what its maker says, and knows no other words", () => {
    expect(readPlace(manifest(), "place.json").hidden).toEqual(new Set());
    const told = { hidden: ["photos", "points", "roofs", 3] };
    expect(readPlace(manifest(told), "place.json").hidden).toEqual(new Set(["points", "photos"]));
    expect(readPlace(manifest({ hidden: "points" }), "place.json").hidden).toEqual(new Set());
  });

  it("gives its parts and its start", () => {
    const place = readPlace(manifest(), "place.json");
    expect(place.parts[0]?.worldFromPart.slice(12)).toEqual([7, 8, 9, 1]);
    expect(place.start.eye).toEqual([0, -10, 1.7]);
  });

  it("gives what its maker says of it, and nothing where that is no text", () => {
    const { about } = readPlace(manifest({ title: "A street", author: 7, licence: null }), "place.json");
    expect(about).toEqual({ title: "A street", description: "", author: "", licence: "" });
  });

  it("lets a part do without a photo and a transform", () => {
    const place = readPlace(manifest({}, { photo: null, transform: undefined }), "place.json");
    expect(place.parts[0]?.photo).toBeNull();
    expect(place.parts[0]?.worldFromPart[15]).toBe(1);
  });

  it("tells the walls that were found from the model", () => {
    const layerOf = (part: Record<string, unknown>): string | null | undefined =>
      readPlace(manifest({}, part), "place.json").parts[0]?.layer;
    expect(layerOf({})).toBe("model");
    expect(layerOf({ id: "walls" })).toBe("walls");
    expect(layerOf({ ground: true })).toBeNull();
  });

  it("knows the ground, and what else there is to see", () => {
    const ground = { ...(JSON.parse(manifest()) as { parts: object[] }).parts[0], id: "g", ground: true };
    const { parts } = JSON.parse(manifest()) as { parts: object[] };
    const place = readPlace(manifest({ parts: [...parts, ground] }), "place.json");
    expect(place.parts.map(({ isGround }) => isGround)).toEqual([false, true]);
    const corners = cornersOfPlace(place);
    expect(corners).toHaveLength(8);
    expect(corners).toContainEqual([7, 8, 9]);
    expect(corners).toContainEqual([8, 9, 10]);
    expect(cornersOfPlace(readPlace(manifest({}, { bounds: { min: [0, 0], max: "far" } }), "place.json"))).toEqual([]);
  });

  it("is its ground where it is nothing else", () => {
    const ground = readPlace(manifest({}, { ground: true }), "place.json");
    expect(cornersOfPlace(ground)).toEqual(cornersOfPlace(readPlace(manifest(), "place.json")));
  });

  it("is looked at where nearly all of it is, not where its strays are", () => {
    const strewn = { bounds: { min: [-90, -90, -90], max: [90, 90, 90] }, core: { min: [0, 0, 0], max: [2, 2, 2] } };
    const corners = cornersOfPlace(readPlace(manifest({}, strewn), "place.json"));
    expect(corners).toContainEqual([9, 10, 11]);
    expect(Math.max(...corners.flat())).toBe(11);
  });

  it.each([
    ["no JSON", "{", "not JSON"],
    ["a list", "[]", "place"],
    ["another file", JSON.stringify({ schema: "veduta/facade" }), "not a Veduta place"],
    ["a later version", manifest({ version: 2 }), "version is 2"],
    ["no parts", manifest({ parts: [] }), "no parts"],
    ["too many parts", manifest({ parts: new Array(10_001).fill({}) }), "more than"],
    ["a part that stands nowhere", manifest({}, { transform: new Array(16).fill(0) }), "no placement"],
    ["a part that is out of reach", manifest({}, { transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1e9, 0, 0, 1] }), "10000 km"],
    ["a transform of 15 numbers", manifest({}, { transform: new Array(15).fill(0) }), "transform"],
    ["a model elsewhere", manifest({}, { model: "../../secret.glb" }), "model"],
    ["a start without an eye", manifest({ start: { target: [0, 0, 0] } }), "start.eye"],
  ])("refuses %s", (_, text, words) => {
    expect(() => readPlace(text, "place.json")).toThrow(Fault);
    expect(() => readPlace(text, "place.json")).toThrow(words);
  });
});

describe("addresses", () => {
  it.each(["a/model.glb", "Straße 1/model.glb", "a..b/c", "100%/x", "a?b/#1.glb", "%2e%2e/a"])("%s lies inside", (path) => {
    expect(isInside(path)).toBe(true);
  });

  it.each(["", "/a", "../a", "a/../../b", "http://evil/a", "//evil/a", "a\\b", 7, null])(
    "%j does not",
    (path) => {
      expect(isInside(path)).toBe(false);
    },
  );

  it("finds the manifest beside the page, or where the page's address says", () => {
    const address = (page: string): string => placeAddress(new URL(page)).href;
    expect(address("http://h:1/sub/index.html")).toBe("http://h:1/sub/place.json");
    expect(address("http://h:1/sub/?place=other/")).toBe("http://h:1/sub/other/place.json");
    expect(address("http://h:1/?place=/x/place.json")).toBe("http://h:1/x/place.json");
  });

  it.each(["http://evil/place.json", "//evil/", "data:application/json,{}", "https://h:1/", "file:///etc/"])(
    "refuses a place from %s",
    (asked) => {
      expect(() => placeAddress(new URL(`http://h:1/?place=${encodeURIComponent(asked)}`))).toThrow(Fault);
    },
  );

  it("escapes what a file name may hold", () => {
    const manifestAt = new URL("http://h:1/place/place.json");
    expect(fileAddress("a b#1/model.glb", manifestAt).href).toBe("http://h:1/place/a%20b%231/model.glb");
    expect(fileAddress("%2e%2e/a?b", manifestAt).pathname).toBe("/place/%252e%252e/a%3Fb");
  });
});
