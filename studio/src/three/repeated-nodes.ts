/** Nodes that say where one mesh stands many times, drawn in one go. */
import { BufferGeometry, type Group, InstancedBufferAttribute, InstancedMesh, Mesh, type Object3D } from "three";

interface Told {
  readonly veduta?: { readonly instances?: boolean; readonly instance?: number };
}

/**
 * Puts an `InstancedMesh` for each look in place of the nodes under each group that the file marks, with
 * the features' rows where the loader leaves those of EXT_mesh_gpu_instancing (`instanced-mesh`).
 */
export function gatherRepeated(scene: Group): void {
  const groups: Object3D[] = [];
  scene.traverse((node) => {
    if ((node.userData as Told).veduta?.instances === true) groups.push(node);
  });
  for (const group of groups) {
    const places = [...group.children];
    const first = places[0];
    if (first === undefined) continue;
    const looks = meshesOf(first).map((mesh) => repeated(mesh, places));
    if (looks.length === 0) continue;
    group.clear();
    for (const look of looks) group.add(look);
  }
}

/** The loader makes a mesh with several materials a group of meshes. */
function meshesOf(node: Object3D): Mesh[] {
  return [node, ...node.children].filter((one): one is Mesh => one instanceof Mesh);
}

function repeated(mesh: Mesh, places: readonly Object3D[]): InstancedMesh {
  // Meshes in other looks share the loader's geometry: what is told of each instance is of this one.
  const geometry = new BufferGeometry();
  geometry.setIndex(mesh.geometry.getIndex());
  for (const [name, attribute] of Object.entries(mesh.geometry.attributes)) geometry.setAttribute(name, attribute);
  const rows = places.map((place) => (place.userData as Told).veduta?.instance ?? -1);
  geometry.setAttribute("_FEATURE_ID_0", new InstancedBufferAttribute(new Float32Array(rows), 1));
  const drawn = new InstancedMesh(geometry, mesh.material, places.length);
  drawn.name = mesh.name;
  for (const [index, place] of places.entries()) {
    place.updateMatrix();
    drawn.setMatrixAt(index, place.matrix);
  }
  return drawn;
}
