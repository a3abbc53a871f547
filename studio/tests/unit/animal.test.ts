import { describe, expect, it } from "vitest";
import { readAnimal, type Animal } from "../../src/core/animal.ts";
import { Course, courseTo } from "../../src/core/course.ts";
import { Curve } from "../../src/core/curve.ts";
import { Fault } from "../../src/core/fault.ts";
import { length, subtract, type Vec3 } from "../../src/core/vector.ts";

const RECORD = {
  id: "eel",
  name: "Eel",
  part: "eel",
  root: "root",
  length: 0.5,
  swims: true,
  clips: [{ name: "swim", seconds: 0.5, stride: 0.25, loops: true }],
  path: [[0, 0, 0], [4, 0, 0], [4, 4, 1]],
  closed: false,
};

function animal(change: Record<string, unknown> = {}): Animal {
  const broken = (fault: string): Fault => new Fault("place.json", fault, "");
  return readAnimal({ ...RECORD, ...change }, "animal 1", [{ id: "house" }, { id: "eel" }], broken);
}

describe("reading an animal", () => {
  it("finds its part and its clips", () => {
    expect(animal().part).toBe(1);
    expect(animal().clips[0]).toEqual({ name: "swim", seconds: 0.5, stride_m: 0.25, loops: true });
  });

  it.each([
    ["part", "nobody"],
    ["length", 0],
    ["clips", []],
    ["clips", [{ name: "swim", seconds: -1, stride: 1 }]],
    ["path", [[0, 0, 0]]],
    ["path", [[0, 0, 0], [1, Number.NaN, 0]]],
    ["turns", [0]],
    ["turns", [1, 1]],
    ["turns", [2]],
    ["turns", "all"],
  ])("refuses a wrong %s", (field, value) => {
    expect(() => animal({ [field]: value })).toThrow(`has no proper "${field}"`);
  });
});

describe("a curve", () => {
  const circle = Array.from({ length: 24 }, (_, i): Vec3 => {
    const angle = (2 * Math.PI * i) / 24;
    return [3 * Math.cos(angle), 3 * Math.sin(angle), 0];
  });

  it("goes through its points by arc length", () => {
    const line = new Curve([[0, 0, 0], [2, 0, 0], [6, 0, 0]], false);
    expect(line.length_m).toBeCloseTo(6, 9);
    expect(line.at(3).point[0]).toBeCloseTo(3, 9);
    expect(line.at(-1).point[0]).toBeCloseTo(-1, 9);
    expect(line.at(8).point[0]).toBeCloseTo(8, 9);
  });

  it("is round where its points lie on a circle", () => {
    const round = new Curve(circle, true);
    expect(round.length_m).toBeCloseTo(6 * Math.PI, 1);
    for (let arc = 0; arc < 30; arc += 0.7) {
      const { point, ahead } = round.at(arc);
      expect(length(point)).toBeCloseTo(3, 2);
      expect((point[0] * ahead[0] + point[1] * ahead[1]) / 3).toBeCloseTo(0, 1);
    }
    expect(length(subtract(round.at(0).point, round.at(round.length_m).point))).toBeLessThan(1e-6);
  });

  it("turns without a kink", () => {
    const corner = new Curve([[0, 0, 0], [1, 0, 0], [1, 1, 0]], false);
    let before = corner.at(0).ahead;
    for (let arc = 0.01; arc < corner.length_m; arc += 0.01) {
      const { ahead } = corner.at(arc);
      expect(length(subtract(ahead, before))).toBeLessThan(0.15);
      before = ahead;
    }
  });
});

describe("a course", () => {
  it("comes to its pace, and stands at the end of its path", () => {
    const course = new Course(animal(), () => null);
    for (let i = 0; i < 20; i += 1) course.advance(0.5, true, 0.05);
    expect(course.pace).toBe(1);
    expect(course.standing).toBe(false);
    for (let i = 0; i < 2000; i += 1) course.advance(0.5, true, 0.05);
    expect(course.pace).toBe(0);
    expect(course.standing).toBe(true);
    expect(length(subtract(course.at(0.25).point, [4, 4, 1]))).toBeLessThan(0.02);
  });

  it("stands when it is told to", () => {
    const course = new Course(animal(), () => null);
    for (let i = 0; i < 20; i += 1) course.advance(0.5, true, 0.05);
    for (let i = 0; i < 20; i += 1) course.advance(0.5, false, 0.05);
    expect(course.pace).toBe(0);
    expect(course.standing).toBe(false);
  });

  it("is led to a point from where it is, on the ground", () => {
    const course = new Course(animal(), (x) => 0.1 * x);
    for (let i = 0; i < 40; i += 1) course.advance(0.5, true, 0.05);
    const before = course.at(0);
    course.leadTo([1, -3, 0]);
    expect(length(subtract(course.at(0).point, before.point))).toBeLessThan(0.02);
    expect(length(subtract(course.at(0).ahead, before.ahead))).toBeLessThan(0.15);
    for (let i = 0; i < 2000; i += 1) course.advance(0.5, true, 0.05);
    const [x, y, z] = course.at(0).point;
    expect(Math.hypot(x - 1, y + 3)).toBeLessThan(0.05);
    expect(z).toBeCloseTo(0.1, 1);
  });

  it("comes to any target on circles that it can turn on", () => {
    const from = { point: [0, 0, 0] as Vec3, ahead: [1, 0, 0] as Vec3 };
    for (const target of [[0, 0.5, 0], [-2, 0, 0], [5, 1, 2], [-0.1, -0.1, 0]] as Vec3[]) {
      const made = courseTo(from, target, 0.05, 0.6);
      expect(made.at(-1)).toEqual(target);
      expect(made.length).toBeLessThan(400);
      for (let i = 2; i + 2 < made.length; i += 1) {
        const [a, b, c] = [made[i - 1] ?? target, made[i] ?? target, made[i + 1] ?? target];
        const turn = Math.atan2(c[1] - b[1], c[0] - b[0]) - Math.atan2(b[1] - a[1], b[0] - a[0]);
        expect(Math.abs(Math.sin(turn))).toBeLessThanOrEqual(0.05 / 0.6 + 1e-9);
      }
    }
  });
});
