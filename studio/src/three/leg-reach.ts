/** A leg that reaches for a place: damped least squares over joints that turn any way. */
import { Matrix3, Quaternion, Vector3 } from "three";

const ROUNDS = 8;
/** In squared lengths of the leg: where it is stretched its joints do not run wild. */
const DAMPING = 1e-4;
/** A joint turns by so much at most in a round (rad). */
const MOST_RAD = 0.35;

/**
 * Turns of a leg's joints, each after its own, with which its end comes to where it is wanted: as small as
 * they can be, so that the leg keeps bending as it bent. places: where the joints are, and its end.
 */
export function reach(places: readonly Vector3[], wanted: Vector3): Quaternion[] {
  const at = places.map((place) => place.clone());
  const end = at.at(-1);
  const turns = at.slice(1).map(() => new Quaternion());
  if (end === undefined) return turns;
  const long = at.slice(1).reduce((sum, place, i) => sum + place.distanceTo(at[i] ?? place), 0);
  for (let round = 0; round < ROUNDS; round += 1) {
    const away = wanted.clone().sub(end);
    if (away.length() < 1e-5 * long) break;
    const arms = at.slice(0, -1).map((place) => end.clone().sub(place));
    const push = away.applyMatrix3(stiffness(arms, DAMPING * long * long).invert());
    const whole = new Quaternion();
    let base = (at[0] ?? end).clone();
    let before = base.clone();
    for (const [i, arm] of arms.entries()) {
      const turn = arm.cross(push);
      const size = Math.min(turn.length(), MOST_RAD);
      whole.multiply(new Quaternion().setFromAxisAngle(turn.normalize(), size));
      const next = at[i + 1] ?? end;
      const along = next.clone().sub(before).applyQuaternion(whole);
      before = next.clone();
      base = base.clone().add(along);
      next.copy(base);
      turns[i]?.premultiply(whole);
    }
  }
  return turns;
}

/** How the end moves for turns of all joints at once: sum of |a|^2 I - a a^T, and the damping. */
function stiffness(arms: readonly Vector3[], damping: number): Matrix3 {
  const m = [damping, 0, 0, 0, damping, 0, 0, 0, damping];
  for (const { x, y, z } of arms) {
    const [xx, yy, zz] = [x * x, y * y, z * z];
    const own = [yy + zz, -x * y, -x * z, -x * y, xx + zz, -y * z, -x * z, -y * z, xx + yy];
    own.forEach((value, i) => {
      m[i] = (m[i] ?? 0) + value;
    });
  }
  const [a, b, c, d, e, f, g, h, i] = m as [number, number, number, number, number, number, number, number, number];
  return new Matrix3().set(a, b, c, d, e, f, g, h, i);
}
