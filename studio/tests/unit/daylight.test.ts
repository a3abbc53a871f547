import { describe, expect, it } from "vitest";
import { DAY_HOUR, type Daylight, daylightAt, hourText, NIGHT_HOUR, sunAt, USUAL_PATH } from "../../src/core/daylight.ts";
import { skyLightAt } from "../../src/three/sky-light.ts";

/** By a sun whose height has this sine. */
function daylightBy(sine: number): Daylight {
  return daylightAt(0, { ...USUAL_PATH, sunAt: () => [Math.sqrt(1 - sine * sine), 0, sine] });
}

/** Height of the sun by the textbook: sin h = sin phi sin d + cos phi cos d cos H. */
function sineOfHeight(hour: number, latitude: number, declination: number): number {
  const angle = ((hour - 12) / 24) * 2 * Math.PI;
  return Math.sin(latitude) * Math.sin(declination) + Math.cos(latitude) * Math.cos(declination) * Math.cos(angle);
}

describe("the sun", () => {
  it("goes the way that the usual afternoon light is on", () => {
    const size = Math.hypot(0.72, 0.62, 0.66);
    for (const [k, v] of [-0.72, -0.62, 0.66].entries()) expect(sunAt(DAY_HOUR)[k]).toBeCloseTo(v / size, 9);
    const declination = Math.asin((-0.62 / size + 0.66 / size) * Math.SQRT1_2);
    for (const hour of [0, 5, 6.5, 9, 12, 14.5, 18, 22]) {
      const [x, y, z] = sunAt(hour);
      expect(Math.hypot(x, y, z)).toBeCloseTo(1, 9);
      expect(z).toBeCloseTo(sineOfHeight(hour, Math.PI / 4, declination), 9);
    }
  });

  it("rises in the east, is in the south at noon and sets in the west", () => {
    expect(sunAt(8)[0]).toBeGreaterThan(0.5);
    expect(sunAt(12)[0]).toBeCloseTo(0, 9);
    expect(sunAt(12)[1]).toBeLessThan(0);
    expect(sunAt(16)[0]).toBeLessThan(-0.5);
  });

  it("makes day and night, and light that never comes from below", () => {
    expect(daylightAt(DAY_HOUR)).toMatchObject({ day: 1, dusk: 0 });
    expect(daylightAt(NIGHT_HOUR)).toMatchObject({ day: 0, dusk: 0 });
    for (let hour = 0; hour < 24; hour += 0.25) expect(daylightAt(hour).light.to[2]).toBeGreaterThan(-1e-9);
    expect(daylightAt(18.1).dusk).toBeGreaterThan(0.8);
  });

  it("fades to the horizon, and the moon comes in by its own colour", () => {
    const direct = (sine: number): number[] => {
      const { sun, sunStrength } = skyLightAt(daylightBy(sine));
      return sun.toArray().map((value) => value * sunStrength);
    };
    let before = direct(-0.3);
    for (let sine = -0.3; sine <= 0.3; sine += 0.001) {
      const now = direct(sine);
      for (const [k, value] of now.entries()) expect(Math.abs(value - (before[k] ?? 0)), `${sine}`).toBeLessThan(0.08);
      before = now;
    }
    expect(Math.max(...direct(0))).toBeCloseTo(0, 12);
    const [red = 0, , blue = 0] = direct(-0.03);
    expect(blue).toBeGreaterThan(1.5 * red);
    expect(direct(-0.02)[2]).toBeLessThan(direct(-0.2)[2] ?? 0);
    expect(skyLightAt(daylightBy(0)).shade).toBeCloseTo(0, 12);
  });

  it("glows in the sky as long as it is dusk, and then the moon does", () => {
    for (const [sine, isMoon, share] of [[0.5, false, 1], [0, false, 1], [-0.03, false, 0.5], [-0.09, true, 0.5], [-0.4, true, 1]] as const) {
      const { glow } = daylightBy(sine);
      expect(glow.isMoon).toBe(isMoon);
      expect(glow.share).toBeCloseTo(share, 9);
    }
  });

  it("is told as a clock does", () => {
    expect([DAY_HOUR, 22, 0, 23.999].map(hourText)).toEqual(["14:34", "22:00", "00:00", "00:00"]);
  });
});
