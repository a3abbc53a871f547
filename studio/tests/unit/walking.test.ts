import { describe, expect, it } from "vitest";
import { headingOf } from "../../src/core/heading.ts";
import {
  DEFAULT_WALK,
  eyeOf,
  type Obstacles,
  standing,
  step,
  type Walker,
  type WalkOptions,
  type WalkWish,
} from "../../src/core/walking.ts";
import { add, dot, scale, type Vec3 } from "../../src/core/vector.ts";

const FREE: Obstacles = { pushOut: () => null };
const NORTH = headingOf([0, 1, 0]);
const AHEAD: WalkWish = { forward: 1, right: 0, run: false };
const STILL: WalkWish = { forward: 0, right: 0, run: false };
const { walk_m_s: SPEED, response_s: TAU, gravity_m_s2: G } = DEFAULT_WALK;
const RADIUS = DEFAULT_WALK.body.radius_m;

/** A wall: everything with n . p > offset is solid. Horizontal normals only. */
function wall(normal: Vec3, offset: number): Obstacles {
  return {
    pushOut: (feet, body) => {
      const depth = dot(normal, feet) + body.radius_m - offset;
      return depth > 0 ? scale(normal, -depth) : null;
    },
  };
}

function both(a: Obstacles, b: Obstacles): Obstacles {
  return {
    pushOut: (feet, body) => {
      const first = a.pushOut(feet, body);
      const second = b.pushOut(first === null ? feet : add(feet, first), body);
      return first === null ? second : second === null ? first : add(first, second);
    },
  };
}

function onGround(options: WalkOptions = DEFAULT_WALK): Walker {
  return step(standing([0, 0, 1.7], NORTH, options), STILL, 0.05, FREE, options);
}

function walked(walker: Walker, wish: WalkWish, seconds: number, dt: number, world: Obstacles): Walker {
  let now = walker;
  for (let i = 0; i < Math.round(seconds / dt); i += 1) now = step(now, wish, dt, world, DEFAULT_WALK);
  return now;
}

describe("the ground of a place", () => {
  /** It rises by a third to the north, from y = 1 on. */
  const hill: Obstacles = { pushOut: () => null, groundAt: (_, y) => (y < 1 ? null : (y - 1) / 3) };

  it.each([1 / 60, 1 / 10])("carries a walker up and down at steps of %f s", (dt) => {
    const up = walked(onGround(), { ...AHEAD, run: true }, 6, dt, hill);
    expect(up.feet[1]).toBeGreaterThan(20);
    expect(up.feet[2]).toBeCloseTo((up.feet[1] - 1) / 3, 9);
    expect(up.grounded).toBe(true);
    const down = walked(up, { forward: -1, right: 0, run: true }, 8, dt, hill);
    expect(down.feet[1]).toBeLessThan(1);
    expect(down.feet[2]).toBe(0);
  });

  it("lifts whoever stands below it when it comes late, and lets nobody fall through it", () => {
    const late = step({ ...onGround(), feet: [0, 31, 0] }, STILL, 1 / 60, hill, DEFAULT_WALK);
    expect(late.feet[2]).toBeCloseTo(10, 9);
    const dropped: Walker = { ...onGround(), feet: [0, 31, 60], velocity: [0, 0, -90], grounded: false };
    expect(walked(dropped, STILL, 3, 1 / 10, hill).feet[2]).toBeCloseTo(10, 9);
  });
});

describe("free walking", () => {
  it.each([1 / 144, 1 / 60, 1 / 15, 1 / 10])("follows the closed form at steps of %f s", (dt) => {
    const seconds = Math.round(3 / dt) * dt;
    const end = walked(onGround(), AHEAD, seconds, dt, FREE);
    // x(t) = v (t - tau (1 - exp(-t / tau))) from rest
    expect(end.feet[1]).toBeCloseTo(SPEED * (seconds - TAU * (1 - Math.exp(-seconds / TAU))), 9);
    expect(end.feet[0]).toBeCloseTo(0, 12);
    expect(end.feet[2]).toBe(0);
    expect(end.grounded).toBe(true);
    expect(end.blocked).toBe(false);
  });

  it("is not faster on a diagonal", () => {
    const end = walked(onGround(), { forward: 1, right: 1, run: false }, 4, 1 / 60, FREE);
    expect(Math.hypot(end.velocity[0], end.velocity[1])).toBeCloseTo(SPEED, 6);
    expect(end.velocity[0]).toBeCloseTo(end.velocity[1], 6);
  });

  it("runs at the running speed and comes to rest", () => {
    const running = walked(onGround(), { ...AHEAD, run: true }, 2, 1 / 60, FREE);
    expect(running.velocity[1]).toBeCloseTo(DEFAULT_WALK.run_m_s, 6);
    const resting = walked(running, STILL, 2, 1 / 60, FREE);
    expect(resting.feet[1] - running.feet[1]).toBeCloseTo(DEFAULT_WALK.run_m_s * TAU, 6);
    expect(Math.abs(resting.velocity[1])).toBeLessThan(1e-6);
  });

  it("has its eye 1.7 m above the ground", () => {
    expect(eyeOf(onGround(), DEFAULT_WALK.body)).toEqual([0, 0, 1.7]);
  });

  it("ends at the edge of the ground", () => {
    const options = { ...DEFAULT_WALK, reach_m: 1, reachCentre: [0, 0] as const };
    let now = onGround(options);
    for (let i = 0; i < 120; i += 1) now = step(now, AHEAD, 1 / 60, FREE, options);
    expect(now.feet[1]).toBeCloseTo(1, 9);
    expect(now.blocked).toBe(true);
  });
});

describe("falling", () => {
  it.each([0.5, 2, 5])("from %f m takes sqrt(2 h / g)", (height) => {
    const dt = 1 / 240;
    let now = standing([0, 0, height + 1.7], NORTH, DEFAULT_WALK);
    let seconds = 0;
    while (!now.grounded) {
      now = step(now, STILL, dt, FREE, DEFAULT_WALK);
      seconds += dt;
    }
    expect(seconds).toBeGreaterThanOrEqual(Math.sqrt((2 * height) / G) - 1e-9);
    expect(seconds).toBeLessThan(Math.sqrt((2 * height) / G) + dt + 1e-9);
    expect(now.feet[2]).toBe(0);
    expect(now.velocity[2]).toBe(0);
  });
});

describe("walls", () => {
  it("stop the body one radius before them", () => {
    const end = walked(onGround(), AHEAD, 4, 1 / 60, wall([0, 1, 0], 3));
    expect(end.feet[1]).toBeCloseTo(3 - RADIUS, 9);
    expect(end.blocked).toBe(true);
    expect(end.velocity[1]).toBeLessThan(1e-9);
  });

  it("are not jumped over in one long step at a run", () => {
    // A wall 5 cm thick: deeper than that would push out at the far side.
    const thin: Obstacles = {
      pushOut: (feet, body) => {
        const away = feet[1] - 0.5;
        const depth = body.radius_m + 0.025 - Math.abs(away);
        return depth > 0 ? [0, Math.sign(away) * depth, 0] : null;
      },
    };
    const end = walked(onGround(), { ...AHEAD, run: true }, 3, 0.1, thin);
    expect(end.feet[1]).toBeCloseTo(0.5 - 0.025 - RADIUS, 9);
  });

  it("are slid along with the speed's share along them", () => {
    // The wall's face makes 30 degrees with the way: v cos 30 remains.
    const angle = Math.PI / 6;
    const along: Vec3 = [Math.sin(angle), Math.cos(angle), 0];
    const normal: Vec3 = [-Math.cos(angle), Math.sin(angle), 0];
    const settled = walked(onGround(), AHEAD, 3, 1 / 60, wall(normal, RADIUS));
    const later = walked(settled, AHEAD, 1, 1 / 60, wall(normal, RADIUS));
    const way: Vec3 = [later.feet[0] - settled.feet[0], later.feet[1] - settled.feet[1], 0];
    expect(dot(way, along)).toBeCloseTo(SPEED * Math.cos(angle), 1);
    expect(Math.abs(dot(way, normal))).toBeLessThan(1e-9);
  });

  it("hold in a corner", () => {
    const corner = both(wall([0, 1, 0], 1), wall([1, 0, 0], 1));
    const end = walked(onGround(), { forward: 1, right: 1, run: true }, 3, 1 / 60, corner);
    expect(end.feet[0]).toBeCloseTo(1 - RADIUS, 9);
    expect(end.feet[1]).toBeCloseTo(1 - RADIUS, 9);
  });
});

/** Ground that rises to the north by `rise` in a metre, above z = 0. */
function slope(rise: number): Obstacles {
  const normal = scale([0, -rise, 1], 1 / Math.hypot(rise, 1));
  return {
    pushOut: (feet, body) => {
      // The sphere at the body's lower end against the plane z = rise y.
      const depth = body.radius_m - dot(normal, add(feet, [0, 0, body.radius_m]));
      return depth > 0 ? scale(normal, depth) : null;
    },
  };
}

describe("slopes", () => {
  it.each([0.1, 0.4, 0.9])("of %f carry whoever stands on them, without sliding", (rise) => {
    const start = standing([0, 10, 10 * rise + 2.5], NORTH, DEFAULT_WALK);
    const landed = walked(start, STILL, 3, 1 / 60, slope(rise));
    expect(landed.grounded).toBe(true);
    const later = walked(landed, STILL, 20, 1 / 60, slope(rise));
    expect(later.feet[1]).toBeCloseTo(10, 6);
    expect(later.feet[2]).toBeCloseTo(landed.feet[2], 3);
    expect(Math.hypot(...later.velocity)).toBeLessThan(1e-6);
  });

  it("are climbed at the speed on the map", () => {
    const start = walked(standing([0, 10, 4.5], NORTH, DEFAULT_WALK), STILL, 3, 1 / 60, slope(0.2));
    const up = walked(start, AHEAD, 5, 1 / 60, slope(0.2));
    expect(up.feet[1] - 10).toBeCloseTo(SPEED * (5 - TAU), 2);
    expect(up.feet[2] - start.feet[2]).toBeCloseTo(0.2 * (up.feet[1] - 10), 2);
  });
});
