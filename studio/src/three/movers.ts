/** The pieces of a model that move: a node each, with an animation from closed to open. */
import {
  type AnimationAction,
  AnimationMixer,
  LoopOnce,
  type Matrix4,
  type Mesh,
  type Object3D,
  PropertyBinding,
} from "three";
import type { GLTF } from "three/examples/jsm/loaders/GLTFLoader.js";
import type { FeatureMesh } from "./feature-mesh.ts";

export class Mover {
  /** The feature that it is a piece of: its row in the part's table. */
  readonly row: number;
  readonly meshes: readonly FeatureMesh[];
  readonly #node: Object3D;
  readonly #mixer: AnimationMixer;
  readonly #action: AnimationAction;

  constructor(node: Object3D, meshes: readonly FeatureMesh[], mixer: AnimationMixer, action: AnimationAction) {
    this.row = meshes[0]?.rowOfFace[0] ?? 0;
    this.meshes = meshes;
    this.#node = node;
    this.#mixer = mixer;
    this.#action = action;
  }

  /** From the drawn frame to the node's own. */
  get place(): Matrix4 {
    return this.#node.matrixWorld;
  }

  /** Puts it where it is when it is so far open, from 0 (closed) to 1. */
  pose(share: number): void {
    this.#action.time = share * this.#action.getClip().duration;
    this.#mixer.update(0);
    this.#node.updateWorldMatrix(false, true);
  }
}

/** What moves in a model; a node that no animation moves stays where it is. */
export function moversOf(gltf: GLTF, meshes: readonly FeatureMesh[]): Mover[] {
  const clips = new Map(
    gltf.animations.flatMap((clip) =>
      clip.tracks.slice(0, 1).map(({ name }) => [PropertyBinding.parseTrackName(name).nodeName, clip] as const),
    ),
  );
  const mixer = new AnimationMixer(gltf.scene);
  const movers: Mover[] = [];
  gltf.scene.traverse((node) => {
    const told = (node.userData as { veduta?: { mover?: unknown } }).veduta;
    const clip = clips.get(node.name);
    if (told?.mover === undefined || clip === undefined) return;
    const own = meshes.filter(({ mesh }) => isBelow(mesh, node));
    if (own.length === 0) return;
    const action = mixer.clipAction(clip);
    // It goes nowhere by itself: `pose` says where it is.
    action.setLoop(LoopOnce, 1).play().paused = true;
    movers.push(new Mover(node, own, mixer, action));
  });
  return movers;
}

function isBelow(mesh: Mesh, node: Object3D): boolean {
  return mesh === node || mesh.parent === node;
}
