import { Bone, Matrix4, Vector3 } from "three";
import { describe, expect, it } from "vitest";
import { phaseOf, readFootings, type Footing } from "../../src/core/footing.ts";
import { Footwork } from "../../src/three/footwork.ts";
import { reach } from "../../src/three/leg-reach.ts";

const FOOTING: Footing = { foot: "left", leg: ["upper", "lower"], end: [0, -0.5, 0], down: [[0, 0.3], [0.8, 1]] };

describe("reading when feet stand", () => {
  const told = { foot: "left", joint: "lower", leg: ["upper", "lower"], end: [0, -0.5, 0], down_s: [[0, 0.3], [0.8, 1]] };

  it("finds legs, their ends and their stands", () => {
    expect(readFootings({ veduta: { contacts: [told] } })).toEqual([FOOTING]);
  });

  it.each([undefined, {}, { veduta: { contacts: "no" } }, { veduta: { contacts: [null, { ...told, end: [0, Number.NaN, 0] }] } }])(
    "finds none where there are none: %j",
    (extras) => {
      expect(readFootings(extras)).toEqual([]);
    },
  );

  it("leaves out stands that are none", () => {
    const [found] = readFootings({ veduta: { contacts: [{ ...told, down_s: [[0.3, 0.1], [0.5, 0.7], [1]] }] } });
    expect(found?.down).toEqual([[0.5, 0.7]]);
  });

  it("joins a stand over the clip's end", () => {
    expect(phaseOf(FOOTING, 0.9, 1)).toMatchObject({ stands: true });
    expect(phaseOf(FOOTING, 0.9, 1).done).toBeCloseTo(0.2, 9);
    expect(phaseOf(FOOTING, 0.15, 1).done).toBeCloseTo(0.7, 9);
    expect(phaseOf(FOOTING, 0.15, 1).stand_s).toBeCloseTo(0.5, 9);
    const swing = phaseOf(FOOTING, 0.55, 1);
    expect(swing.stands).toBe(false);
    expect(swing.done).toBeCloseTo(0.5, 9);
  });
});

describe("a leg that reaches", () => {
  const leg = [new Vector3(0, 1, 0), new Vector3(0.1, 0.5, 0), new Vector3(0, 0.1, 0)];

  it("comes to what is in its reach, its segments as long as they were", () => {
    const wanted = new Vector3(0.2, 0.2, 0.15);
    const [upper, lower] = reach(leg, wanted);
    const [hip, knee, toe] = leg;
    if (hip === undefined || knee === undefined || toe === undefined || upper === undefined || lower === undefined) throw new Error("no leg");
    const bent = hip.clone().add(knee.clone().sub(hip).applyQuaternion(upper));
    const end = bent.clone().add(toe.clone().sub(knee).applyQuaternion(lower));
    expect(end.distanceTo(wanted)).toBeLessThan(2e-3);
  });

  it("does not run wild where it cannot reach", () => {
    for (const turn of reach(leg, new Vector3(0, -3, 0))) {
      expect(turn.angleTo(turn.clone().identity())).toBeLessThan(1.5);
    }
  });
});

/** A leg of two bones on a body that goes along x; at times of a clip in which the leg swings forth and back. */
function walkingLeg() {
  const [upper, lower] = [new Bone(), new Bone()];
  [upper.name, lower.name] = ["upper", "lower"];
  const at = (bone: Bone, x: number): Matrix4 => new Matrix4().makeTranslation(bone === upper ? 0 : x, bone === upper ? 1 : 0.5, 0);
  const rest = new Map([upper, lower].map((bone) => [bone, at(bone, 0)]));
  const work = new Footwork([[FOOTING]], [upper, lower], rest, () => 0);
  const end = (): Vector3 => new Vector3(0, -0.5, 0).applyMatrix4(lower.matrixWorld);
  return { upper, lower, at, work, end };
}

describe("footwork", () => {
  it("keeps a standing foot on its spot while the body goes on", () => {
    const { upper, lower, at, work, end } = walkingLeg();
    let spot: Vector3 | null = null;
    for (let frame = 0; frame < 10; frame += 1) {
      const [time, x] = [0.8 + frame * 0.01, frame * 0.01];
      const frameAt = new Matrix4().makeTranslation(x, 0, 0);
      for (const bone of [upper, lower]) bone.matrixWorld.multiplyMatrices(frameAt, at(bone, 0.15));
      work.plant(0, time, 1, { frame: frameAt, spin: 0, turning: false, pace: 1 }, 0.01, (bone) => at(bone, 0.15));
      spot ??= end();
      expect(end().distanceTo(spot)).toBeLessThan(0.005);
    }
  });

  it("steps round while the body turns", () => {
    const { upper, lower, at, work, end } = walkingLeg();
    const stood: Vector3[] = [];
    for (let frame = 0; frame < 300; frame += 1) {
      const yaw = frame * 0.01;
      const frameAt = new Matrix4().makeRotationY(yaw).multiply(new Matrix4().makeTranslation(0.4, 0, 0));
      const body = new Matrix4().makeRotationY(yaw);
      for (const bone of [upper, lower]) bone.matrixWorld.multiplyMatrices(frameAt, at(bone, 0));
      work.plant(0, (frame * 0.01) % 1, 1, { frame: body, spin: 1, turning: true, pace: 1 }, 0.01, (bone) => at(bone, 0));
      expect(end().y).toBeGreaterThan(-0.01);
      if (phaseOf(FOOTING, (frame * 0.01) % 1, 1).stands) stood.push(end());
    }
    // It stands in stretches without moving, and steps between them.
    const steps = stood.slice(1).map((place, i) => place.distanceTo(stood[i] ?? place));
    expect(steps.filter((step) => step > 0.02).length).toBeGreaterThanOrEqual(2);
    expect(steps.filter((step) => step > 0.004).length).toBeLessThan(8);
  });
});
