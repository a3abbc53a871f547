/**
 * What is in tiles, read by three.js' decoder and the rules of glTF, and by none of our own code:
 * node read_tiles.mjs MODULES FILE... prints for each file the box around all that is drawn (z up,
 * metres; low and high corner) and the highest surface number of each primitive and node.
 */
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [modules, ...files] = process.argv.slice(2);
const decoder = `${modules}/three/examples/jsm/libs/meshopt_decoder.module.js`;
const { MeshoptDecoder } = await import(pathToFileURL(decoder).href);
const { Matrix4, Quaternion, Vector3, Box3 } = await import(pathToFileURL(`${modules}/three/build/three.module.js`).href);
await MeshoptDecoder.ready;
const KINDS = { 5120: Int8Array, 5121: Uint8Array, 5122: Int16Array, 5123: Uint16Array, 5125: Uint32Array, 5126: Float32Array };
const WIDTHS = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4 };

function opened(file) {
  const bytes = readFileSync(file);
  const size = bytes.readUInt32LE(12);
  return { json: JSON.parse(bytes.subarray(20, 20 + size)), bin: bytes.subarray(28 + size) };
}

function viewsOf({ json, bin }) {
  return json.bufferViews.map(({ byteOffset = 0, byteLength, extensions }) => {
    const packed = extensions?.EXT_meshopt_compression;
    if (packed === undefined) return new Uint8Array(bin.subarray(byteOffset, byteOffset + byteLength));
    const source = new Uint8Array(bin.subarray(packed.byteOffset, packed.byteOffset + packed.byteLength));
    const target = new Uint8Array(packed.count * packed.byteStride);
    MeshoptDecoder.decodeGltfBuffer(target, packed.count, packed.byteStride, source, packed.mode, packed.filter ?? "NONE");
    return target;
  });
}

function read(file) {
  const glb = opened(file);
  const { json } = glb;
  const views = viewsOf(glb);
  const rows = (number) => {
    const { bufferView, byteOffset = 0, componentType, count, type, normalized } = json.accessors[number];
    const kind = KINDS[componentType];
    const width = WIDTHS[type];
    const stride = json.bufferViews[bufferView].byteStride ?? kind.BYTES_PER_ELEMENT * width;
    return Array.from({ length: count }, (_, row) => {
      const start = byteOffset + row * stride;
      const some = views[bufferView].slice(start, start + width * kind.BYTES_PER_ELEMENT);
      const values = [...new kind(some.buffer)];
      return normalized ? values.map((v) => Math.max(v / 32767, -1)) : values;
    });
  };
  const box = new Box3();
  const features = [];
  for (const node of json.nodes) {
    const of = (move = [0, 0, 0], turn = [0, 0, 0, 1], scale = [1, 1, 1]) =>
      new Matrix4().compose(new Vector3(...move), new Quaternion(...turn).normalize(), new Vector3(...scale));
    const own = of(node.translation, node.rotation, node.scale);
    const shared = node.extensions?.EXT_mesh_gpu_instancing?.attributes;
    let places = [own];
    if (shared !== undefined) {
      const [moves, turns] = [rows(shared.TRANSLATION), rows(shared.ROTATION)];
      const scales = shared.SCALE === undefined ? [] : rows(shared.SCALE);
      places = moves.map((move, k) => own.clone().multiply(of(move, turns[k], scales[k])));
      features.push(Math.max(...rows(shared._FEATURE_ID_0).map(([id]) => id)));
    }
    for (const { attributes, indices } of json.meshes[node.mesh].primitives) {
      const points = rows(attributes.POSITION);
      const drawn = rows(indices).map(([index]) => index);
      if (drawn.length % 3 !== 0 || Math.max(...drawn) >= points.length) throw new Error(`${file}: indices`);
      if (attributes._FEATURE_ID_0 !== undefined) features.push(rows(attributes._FEATURE_ID_0).reduce((a, [id]) => Math.max(a, id), 0));
      for (const place of places) for (const p of points) box.expandByPoint(new Vector3(...p).applyMatrix4(place));
    }
  }
  const { min, max } = box;
  return { file, low: [min.x, -max.z, min.y], high: [max.x, -min.z, max.y], features };
}

console.log(JSON.stringify(files.map(read)));
