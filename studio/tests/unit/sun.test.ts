import { describe, expect, it } from "vitest";
import { DAY_HOUR, daylightAt, sunAt, sunPathOf } from "../../src/core/daylight.ts";
import { changeBy } from "../../src/core/house-keys.ts";
import { lowestGround, readPlace, type SunDay } from "../../src/core/place.ts";
import { INITIAL_STATE } from "../../src/core/state.ts";
import { sunVector } from "../../src/core/sun.ts";
import type { Vec3 } from "../../src/core/vector.ts";

const DEGREE = Math.PI / 180;

function anglesOf([x, y, z]: Vec3): { azimuth: number; elevation: number } {
  return { azimuth: (Math.atan2(x, y) / DEGREE + 360) % 360, elevation: Math.asin(z) / DEGREE };
}

function place(sun: unknown): string {
  const part = {
    id: "a", name: "A", model: "a.glb", arrangement: "single", bounds: { min: [0, 0, 0], max: [1, 1, 1] },
  };
  const parts = [part, { ...part, id: "panorama", backdrop: true }];
  return JSON.stringify({ schema: "veduta/place", version: 1, parts, sun, start: { eye: [0, 0, 1], target: [0, 1, 1] } });
}

const SYDNEY = { latitude_deg: -33.8568, longitude_deg: 151.2153, time: "2026-12-21T09:00:00+10:00", assumed: [] };

describe("the sun over a place", () => {
  it("stands where NREL's report has it (TP-560-34302, A.5)", () => {
    const { azimuth, elevation } = anglesOf(sunVector(39.742476, -105.1786, Date.parse("2003-10-17T12:30:30-07:00")));
    expect(azimuth).toBeCloseTo(194.34024, 1);
    expect(elevation).toBeCloseTo(90 - 50.11162, 1);
  });

  it.each(["2026-06-21T04:43+01:00", "2026-06-21T21:21+01:00", "2026-12-21T08:04+00:00", "2026-12-21T15:53+00:00"])(
    "rises and sets in London when almanacs say so: %s",
    (time) => {
      const { elevation } = anglesOf(sunVector(51.5, -0.1167, Date.parse(time)));
      expect(Math.abs(elevation + 0.833)).toBeLessThan(0.15);
    },
  );

  it("is a unit vector at any place and time", () => {
    for (const latitude of [-90, -40, 0, 66, 90])
      for (let day = 0; day < 365; day += 40)
        expect(Math.hypot(...sunVector(latitude, 17 * day, day * 86_400_000 + 5e6 * latitude))).toBeCloseTo(1, 12);
  });

  it("goes through the day by the clock of the place", () => {
    const path = sunPathOf(readPlace(place(SYDNEY), "place.json").sun);
    expect(path.firstHour).toBe(9);
    expect(path.dayHour).toBe(9);
    expect(path.sunAt(9)).toEqual(sunVector(-33.8568, 151.2153, Date.parse("2026-12-20T23:00:00Z")));
    expect(path.sunAt(9)[0]).toBeGreaterThan(0.5); // in the east
    expect(path.sunAt(path.nightHour)[2]).toBeLessThan(-0.4);
    expect(daylightAt(9, path)).toMatchObject({ day: 1 });
    expect(path.words).toBe("The sun of 2026-12-21 at 33.9° S 151.2° E, UTC+10:00");
  });

  it("has a day to change to where the place is looked at by night", () => {
    const path = sunPathOf(readPlace(place({ ...SYDNEY, time: "2026-12-21T23:30:00+10:00" }), "place.json").sun);
    const { change, words } = changeBy("daylight", { ...INITIAL_STATE, hour: path.firstHour }, path);
    expect(path.firstHour).toBe(23.5);
    expect(change.hour).toBeCloseTo(12, 0); // 12:00 by the sun there is 11:53
    expect(words).toMatch(/, day$/);
    expect(changeBy("daylight", { ...INITIAL_STATE, hour: 12 }, path).words).toMatch(/, night$/);
  });

  it.each([
    ["a midnight sun", "2026-06-21T14:00:00+01:00"],
    ["a midnight sun, looked at by night", "2026-06-21T00:00:00+01:00"],
    ["a polar night", "2026-12-21T14:00:00+01:00"],
  ])("has two times to change between under %s", (_, time) => {
    const svalbard = { ...SYDNEY, latitude_deg: 78.2, longitude_deg: 15.6, time };
    const path = sunPathOf(readPlace(place(svalbard), "place.json").sun);
    let hour = path.firstHour;
    const seen = new Set<number>();
    for (let press = 0; press < 4; press++) {
      const { change, words } = changeBy("daylight", { ...INITIAL_STATE, hour }, path);
      expect(change.hour).not.toBe(hour);
      hour = change.hour ?? Number.NaN;
      expect(words).toMatch(daylightAt(hour, path).day > 0.5 ? /, day$/ : /, night$/);
      seen.add(hour);
    }
    expect([...seen].toSorted((a, b) => a - b)).toEqual([path.nightHour, path.dayHour].toSorted((a, b) => a - b));
  });

  it("is the usual one where nobody knows the place, and says what is assumed", () => {
    const unknown = readPlace(place({ latitude_deg: null, longitude_deg: null, time: null, assumed: ["place", "time"] }), "place.json");
    const path = sunPathOf(unknown.sun);
    expect(path.firstHour).toBe(DAY_HOUR);
    expect(path.sunAt(9)).toEqual(sunAt(9));
    expect(path.words).not.toContain("north is");
    expect(sunPathOf(null).words).toContain("north is taken to be up");
    const timeless = sunPathOf(readPlace(place({ ...SYDNEY, assumed: ["north", "time"] }), "place.json").sun);
    expect(timeless.words).toBe("The sun of 2026-12-21 (assumed) at 33.9° S 151.2° E, UTC+10:00; north is taken to be up on the plan");
  });

  it.each([
    ["a number", 7],
    ["a place off the earth", { ...SYDNEY, latitude_deg: 100 }],
    ["a time without an offset", { ...SYDNEY, time: "2026-12-21T09:00:00" }],
    ["no time at all", { ...SYDNEY, time: "noon" }],
  ])("is refused if it is %s", (_, sun) => {
    expect(() => readPlace(place(sun), "place.json")).toThrow(/"sun"/);
  });

  it("has its own ground, which may lie lower than its origin", () => {
    const { parts, ...rest } = JSON.parse(place(null)) as { parts: Record<string, unknown>[] };
    const lowestOf = (all: object[]): number | null => lowestGround(readPlace(JSON.stringify({ ...rest, parts: all }), "place.json"));
    const ground = { ...parts[0], id: "ground", ground: true, bounds: { min: [0, 0, -2], max: [1, 1, 3] } };
    expect(lowestOf([{ ...parts[0] }])).toBeNull();
    expect(lowestOf([...parts, ground])).toBe(-2);
    const town = { ...ground, bounds: { min: [0, 0, -0.3], max: [1, 1, 3] } };
    expect(lowestOf([{ ...parts[0] }, town])).toBe(0);
    expect(lowestOf([...parts, town])).toBe(-0.3);
    expect(lowestOf([...parts, { ...ground, transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1] }])).toBe(0);
  });

  it("knows the picture around a place", () => {
    const { parts } = readPlace(place(null), "place.json");
    expect(parts.map(({ isBackdrop, layer }) => [isBackdrop, layer])).toEqual([[false, "model"], [true, "backdrop"]]);
    const day: SunDay | null | undefined = readPlace(place(null), "place.json").sun?.day;
    expect(day).toBeUndefined();
  });
});
