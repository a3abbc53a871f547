/** Where somebody begins to walk: not with the nose at a wall, if there is room a step away on the same floor. */
import { add, length, type Vec3 } from "./vector.ts";
import type { Body, Obstacles } from "./walking.ts";

/** So far from walls one begins (m), if one can. */
const ROOM_M = 1.5;
/** No farther from the given place than this. */
const FARTHEST_M = 4;
const PUSHES = 8;
/** Over the floor, which may lie a little higher than is said. */
const OFF_FLOOR_M = 0.08;
/** Nothing may stand between the two places, and no edge may lie there, looked at so often. */
const STEPS = 8;
/** A floor that lies lower than this is another one. */
const STEP_DOWN_M = 0.3;

/** The feet of somebody who was to begin at `feet`, moved off what is beside; as they were where that does not help. */
export function withElbowRoom(feet: Vec3, obstacles: Obstacles, body: Body): Vec3 {
  const wide: Body = { ...body, radius_m: ROOM_M, height_m: Math.max(body.height_m, 2 * ROOM_M) };
  const [x, y, z] = feet;
  const lifted: Vec3 = [x, y, z + OFF_FLOOR_M];
  let moved: Vec3 = [0, 0, 0];
  for (let n = 0; n < PUSHES; n++) {
    const push = obstacles.pushOut(add(lifted, moved), wide);
    if (push === null) break;
    moved = [moved[0] + push[0], moved[1] + push[1], 0];
  }
  if (length(moved) > FARTHEST_M) return feet;
  const onFloor = hasFloor(feet, obstacles, body);
  for (let n = 1; n <= STEPS; n++) {
    const share = n / STEPS;
    const between = add(lifted, [share * moved[0], share * moved[1], 0]);
    if (obstacles.pushOut(between, body) !== null) return feet;
    if (onFloor && !hasFloor(between, obstacles, body)) return feet;
  }
  return add(feet, moved);
}

/** Whether one who stands there is held by the ground or by a floor: a body that is sunk into it is pushed up. */
function hasFloor([x, y, z]: Vec3, obstacles: Obstacles, body: Body): boolean {
  const ground = Math.max(0, obstacles.groundAt?.(x, y) ?? 0);
  if (z - STEP_DOWN_M <= ground) return true;
  const push = obstacles.pushOut([x, y, z - STEP_DOWN_M], body);
  return push !== null && push[2] > 0;
}
