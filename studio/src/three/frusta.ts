/** Where the photos were taken: a pyramid each, whose base is the photo that is looked through. */
import {
  BufferAttribute,
  BufferGeometry,
  type Camera,
  DoubleSide,
  Group,
  LineBasicMaterial,
  LineSegments,
  type Material,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  type PerspectiveCamera,
  PlaneGeometry,
  Quaternion,
  Raycaster,
  type Vector2,
  Vector3,
} from "three";
import { drawnFromWorld, worldPoint } from "../core/frames.ts";
import { approached } from "../core/photo-choice.ts";
import type { Place, Shot } from "../core/place.ts";
import { boundsOfShots, cornersOfShot, depthOfFrusta, fovOfShot } from "../core/shots.ts";
import { length, subtract, type Vec3 } from "../core/vector.ts";
import type { Pose } from "./flight.ts";
import { CHOSEN_PX, type PhotoTextures } from "./photo-textures.ts";

const LINE = "#c2402f";
const BASE_OPACITY = 0.16;
/** Pyramids vanish for an eye that is nearer than this; in shares of their depth. */
const NEAR = 1.6;
/** How long a photo takes to appear where one looks through it. */
const APPEARING_S = 0.35;

export class Frusta {
  readonly group = new Group();
  readonly #shots: readonly Shot[];
  readonly #textures: PhotoTextures;
  readonly #bases: readonly Mesh[];
  readonly #lines: LineSegments;
  readonly #picture: Mesh<BufferGeometry, MeshBasicMaterial>;
  readonly #depth: number;
  readonly #onChange: () => void;
  #wanted: number | null = null;

  constructor(place: Pick<Place, "shots" | "clouds">, textures: PhotoTextures, onChange: () => void) {
    const { shots, clouds } = place;
    this.#shots = shots;
    this.#textures = textures;
    this.#onChange = onChange;
    const { min, max } = boundsOfShots(clouds, shots);
    this.#depth = depthOfFrusta(shots, length(subtract(max, min)));
    const pale = new MeshBasicMaterial({
      color: LINE,
      transparent: true,
      opacity: BASE_OPACITY,
      side: DoubleSide,
      depthWrite: false,
      toneMapped: false,
    });
    this.#bases = shots.map((shot) => new Mesh(this.#baseOf(shot), pale));
    const sharp = new LineBasicMaterial({ color: LINE, toneMapped: false, transparent: true });
    for (const material of [pale, sharp]) this.#vanishNearby(material);
    this.#lines = new LineSegments(this.#edges(), sharp);
    this.#picture = new Mesh(
      new BufferGeometry(),
      new MeshBasicMaterial({ side: DoubleSide, toneMapped: false, transparent: true, opacity: 0, depthWrite: false }),
    );
    this.#picture.visible = false;
    this.group.add(this.#lines, ...this.#bases, this.#picture);
  }

  /** The photo whose pyramid's base lies under a point of the screen (-1..1). */
  hit(onScreen: Vector2, camera: Camera): number | null {
    const caster = new Raycaster();
    caster.setFromCamera(onScreen, camera);
    caster.near = NEAR * this.#depth;
    const hit = caster.intersectObjects([...this.#bases], false)[0];
    const index = this.#bases.findIndex((base) => base === hit?.object);
    return index < 0 ? null : index;
  }

  /** Shows one photo, whole, in its place; the others' pyramids make room for it. */
  async show(index: number | null): Promise<void> {
    const before = this.#wanted;
    this.#wanted = index;
    const shot = index === null ? undefined : this.#shots[index];
    this.#lines.visible = shot === undefined;
    for (const base of this.#bases) base.visible = shot === undefined;
    this.#picture.visible = false;
    if (before !== null) this.#textures.release(before, CHOSEN_PX);
    this.#onChange();
    if (shot === undefined || index === null) return;
    const texture = await this.#textures.acquire(index, CHOSEN_PX);
    if (texture === null || this.#wanted !== index) return;
    this.#picture.geometry.dispose();
    this.#picture.geometry = this.#baseOf(shot);
    this.#picture.material.map = texture;
    this.#picture.material.opacity = 0;
    this.#picture.material.needsUpdate = true;
    this.#picture.visible = true;
    this.#onChange();
  }

  /** Lets the photo appear; it stays away while it lies on the surfaces. True while it changes. */
  advance(seconds: number, isProjected: boolean): boolean {
    if (!this.#picture.visible) return false;
    const { material } = this.#picture;
    const { opacity } = material;
    material.opacity = approached(opacity, isProjected ? 0 : 1, seconds, APPEARING_S);
    return material.opacity !== opacity;
  }

  /** The pose of a photo, with the whole of it in the picture. */
  poseOf(index: number, camera: PerspectiveCamera): Pose | null {
    const shot = this.#shots[index];
    if (shot === undefined) return null;
    const eye = this.#drawn(shot, [0, 0, 0]);
    const right = this.#drawn(shot, [1, 0, 0]).sub(eye).normalize();
    const down = this.#drawn(shot, [0, 1, 0]).sub(eye).normalize();
    const ahead = new Vector3().crossVectors(right, down);
    const basis = new Matrix4().makeBasis(right, down.negate(), ahead.negate());
    const { fov_deg, shift } = fovOfShot(shot, camera.aspect);
    return { position: eye, quaternion: new Quaternion().setFromRotationMatrix(basis), fov: fov_deg, shift };
  }

  dispose(): void {
    for (const base of this.#bases) base.geometry.dispose();
    this.#lines.geometry.dispose();
    this.#picture.geometry.dispose();
  }

  #drawn(shot: Shot, p: Vec3): Vector3 {
    return new Vector3(...drawnFromWorld(worldPoint(shot.worldFromCamera, p)));
  }

  /** The photo's rectangle at the depth of the pyramids. */
  #baseOf(shot: Shot): BufferGeometry {
    const plane = new PlaneGeometry(1, 1);
    const corners = cornersOfShot(shot, this.#depth);
    const position = new Float32Array(12);
    for (const [k, corner] of corners.entries()) this.#drawn(shot, corner).toArray(position, 3 * k);
    plane.setAttribute("position", new BufferAttribute(position, 3));
    plane.computeBoundingSphere();
    return plane;
  }

  /** Whoever walks through a pyramid would else see it over everything. */
  #vanishNearby(material: Material): void {
    const [from, to] = [NEAR * this.#depth, 2 * NEAR * this.#depth].map((way) => way.toFixed(6));
    material.onBeforeCompile = (shader) => {
      shader.vertexShader = shader.vertexShader
        .replace("#include <common>", "#include <common>\nvarying float vAway;")
        .replace("#include <project_vertex>", "#include <project_vertex>\nvAway = length(mvPosition.xyz);");
      shader.fragmentShader = shader.fragmentShader
        .replace("#include <common>", "#include <common>\nvarying float vAway;")
        .replace("#include <color_fragment>", `#include <color_fragment>
          diffuseColor.a *= smoothstep(${from ?? "0.0"}, ${to ?? "1.0"}, vAway);`);
    };
    material.customProgramCacheKey = () => `veduta-frusta-${from ?? ""}`;
  }

  #edges(): BufferGeometry {
    const ends: number[] = [];
    for (const shot of this.#shots) {
      const eye = this.#drawn(shot, [0, 0, 0]);
      const [a, b, c, d] = cornersOfShot(shot, this.#depth).map((corner) => this.#drawn(shot, corner));
      if (a === undefined || b === undefined || c === undefined || d === undefined) continue;
      for (const [from, to] of [[eye, a], [eye, b], [eye, c], [eye, d], [a, b], [b, d], [d, c], [c, a]] as const) {
        ends.push(...from.toArray(), ...to.toArray());
      }
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(ends), 3));
    return geometry;
  }
}
