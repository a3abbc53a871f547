import { PerspectiveCamera, Sphere, Frustum, Matrix4, Vector3 } from "three";
import { describe, expect, it } from "vitest";
import { awayFrom, sees, sightOf } from "../../src/core/sight.ts";

describe("what is seen", () => {
  it("has all in it that is in the frustum of the camera", () => {
    const camera = new PerspectiveCamera(50, 1.6, 0.1, 1000);
    camera.position.set(3, 2, 5);
    camera.lookAt(8, 1, -4);
    camera.updateMatrixWorld();
    const frustum = new Frustum().setFromProjectionMatrix(
      new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse),
    );
    const ahead = camera.getWorldDirection(new Vector3());
    const sight = sightOf([3, 2, 5], [ahead.x, ahead.y, ahead.z], (50 * Math.PI) / 180, 1.6);
    let [both, seldom] = [0, 0];
    for (let k = 0; k < 400; k += 1) {
      const middle = [20 * Math.sin(1.7 * k), 9 * Math.sin(2.3 * k), 20 * Math.cos(1.1 * k)] as const;
      const radius = 0.2 + (k % 5);
      const inFrustum = frustum.intersectsSphere(new Sphere(new Vector3(...middle), radius));
      const seen = sees(sight, { middle, radius });
      if (inFrustum) expect(seen).toBe(true);
      if (inFrustum) both += 1;
      else if (!seen) seldom += 1;
    }
    expect(both).toBeGreaterThan(20);
    expect(seldom).toBeGreaterThan(100);
  });

  it("is all where nothing is known of the direction, and around oneself", () => {
    const ball = { middle: [0, -10, 0], radius: 2 } as const;
    const north = sightOf([0, 0, 0], [0, 1, 0], 1, 1);
    expect(sees(north, ball)).toBe(false);
    expect(sees({ ...north, direction: null }, ball)).toBe(true);
    expect(sees(north, { ...ball, radius: 11 })).toBe(true);
    expect([awayFrom(north, ball), awayFrom(north, { ...ball, radius: 11 })]).toEqual([8, 0]);
  });
});
