/** The outline of the selected feature. */
import { BufferAttribute, BufferGeometry, EdgesGeometry, Group, Vector2 } from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import type { FeatureMesh } from "./feature-mesh.ts";
import { facesOfInstances } from "./instanced-mesh.ts";
import type { LoadedPart } from "./load.ts";

export const ACCENT = "#ff9e2c";
/** Edges between faces that turn less than this are inside one surface. */
const CREASE_DEG = 12;

export class Outline {
  readonly group = new Group();
  readonly #near = new LineMaterial({ color: ACCENT, linewidth: 3, depthTest: true });
  /** The hidden edges shine through faintly, so that the whole feature is seen. */
  readonly #behind = new LineMaterial({
    color: ACCENT,
    linewidth: 1.5,
    depthTest: false,
    transparent: true,
    opacity: 0.35,
  });

  constructor() {
    this.#near.polygonOffset = true;
    this.#near.polygonOffsetFactor = -4;
    this.#near.polygonOffsetUnits = -4;
    this.group.renderOrder = 2;
  }

  resize(width: number, height: number): void {
    const size = new Vector2(width, height);
    this.#near.resolution.copy(size);
    this.#behind.resolution.copy(size);
  }

  show(part: Pick<LoadedPart, "meshes" | "instanced">, row: number): void {
    this.clear();
    const own = part.meshes.map((target) => facesOfRow(target, row));
    const repeated = part.instanced.flatMap((target) => facesOfInstances(target, row));
    for (const soup of [...own, ...repeated]) {
      if (soup === null) continue;
      this.#add(soup);
    }
  }

  #add(soup: BufferGeometry): void {
    const edges = new EdgesGeometry(soup, CREASE_DEG);
    const segments = new LineSegmentsGeometry().fromEdgesGeometry(edges);
    for (const material of [this.#behind, this.#near]) {
      const lines = new LineSegments2(segments, material);
      lines.renderOrder = 2;
      lines.frustumCulled = false;
      this.group.add(lines);
    }
    soup.dispose();
    edges.dispose();
  }

  /** The outline of loose faces: nine coordinates each, drawn frame. */
  showFaces(positions: Float32Array): void {
    this.clear();
    const soup = new BufferGeometry();
    soup.setAttribute("position", new BufferAttribute(positions, 3));
    this.#add(soup);
  }

  clear(): void {
    for (const child of [...this.group.children]) {
      if (child instanceof LineSegments2) child.geometry.dispose();
      this.group.remove(child);
    }
  }
}

function facesOfRow(target: FeatureMesh, row: number): BufferGeometry | null {
  const index: number[] = [];
  for (const [face, faceRow] of target.rowOfFace.entries()) {
    if (faceRow !== row) continue;
    for (let k = 0; k < 3; k += 1) index.push(target.faces[3 * face + k] ?? 0);
  }
  if (index.length === 0) return null;
  const position = target.mesh.geometry.getAttribute("position");
  const points = new Float32Array(3 * index.length);
  for (const [i, vertex] of index.entries()) {
    points[3 * i] = position.getX(vertex);
    points[3 * i + 1] = position.getY(vertex);
    points[3 * i + 2] = position.getZ(vertex);
  }
  const soup = new BufferGeometry();
  soup.setAttribute("position", new BufferAttribute(points, 3));
  soup.applyMatrix4(target.mesh.matrixWorld);
  return soup;
}
