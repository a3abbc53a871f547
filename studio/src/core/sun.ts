/** Where the sun stands over a place at a time. World frame: x east, y north, z up. */
import type { Vec3 } from "./vector.ts";

const DEGREE = Math.PI / 180;
const DAY_MS = 86_400_000;
/** Noon of the first day of 2000, UTC. */
const J2000_MS = Date.UTC(2000, 0, 1, 12);

/**
 * Unit vector to the sun's middle, without the bending of light in the air. By the low-precision
 * formulas of the Astronomical Almanac (section C): within 0.02 degrees from 1950 to 2050.
 */
export function sunVector(latitude_deg: number, longitude_deg: number, time_ms: number): Vec3 {
  const days = (time_ms - J2000_MS) / DAY_MS;
  const mean = 280.46 + 0.9856474 * days;
  const anomaly = (357.528 + 0.9856003 * days) * DEGREE;
  const ecliptic = (mean + 1.915 * Math.sin(anomaly) + 0.02 * Math.sin(2 * anomaly)) * DEGREE;
  const tilt = (23.439 - 0.0000004 * days) * DEGREE;
  const ascension = Math.atan2(Math.cos(tilt) * Math.sin(ecliptic), Math.cos(ecliptic));
  const declination = Math.asin(Math.sin(tilt) * Math.sin(ecliptic));
  const sidereal_deg = 15 * (18.697374558 + 24.06570982441908 * days) + longitude_deg;
  const angle = sidereal_deg * DEGREE - ascension;
  const latitude = latitude_deg * DEGREE;
  const toEquator = Math.cos(declination) * Math.cos(angle);
  return [
    -Math.cos(declination) * Math.sin(angle),
    Math.cos(latitude) * Math.sin(declination) - Math.sin(latitude) * toEquator,
    Math.sin(latitude) * Math.sin(declination) + Math.cos(latitude) * toEquator,
  ];
}
