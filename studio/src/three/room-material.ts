/**
 * Materials that know in which room each of their places is, so that a room's light stays in it.
 *
 * Lamps of three.js shine through walls unless each draws its own shadows, and only a few can. Here a
 * grid of room numbers tells for each place its room; that room's light by reflection is one number,
 * and of the lamps only those of the room are added up. So any number of rooms is lit, at the same cost.
 */
import {
  Color,
  DataTexture,
  FloatType,
  type IUniform,
  type Material,
  MeshStandardMaterial,
  NearestFilter,
  RGFormat,
  RGBAFormat,
  UnsignedByteType,
  Vector3,
  Vector4,
} from "three";
import type { House } from "../core/house.ts";
import { roomMapOf, roomsOf } from "../core/room-map.ts";

/** Lamps whose places are drawn as such at the same time; the light of others is that of their rooms. */
export const MOST_LAMPS = 8;
const LEVELS_WIDE = 256;
/** A lamp is seen as a globe, and nothing is nearer to it than its shade. */
const LEAST_SQUARED_M2 = 0.09;
/** 3000 K as an eye sees it that has been among such lamps for a while. */
const LAMP_COLOUR = new Color("#ffe0b8");
/** What the windows let in, once the walls have thrown it on. */
const DAY_COLOUR = new Color("#f6f5f2");

export interface RoomUniforms {
  readonly [name: string]: IUniform;
  readonly lampAt: IUniform<Vector4[]>;
  readonly lampRoom: IUniform<number[]>;
  readonly roomLevels: IUniform<DataTexture>;
  readonly roomDay: IUniform<number>;
}

export function roomUniforms(house: House): RoomUniforms {
  const { corner, cell_m, columns, rows, cells } = roomMapOf(house);
  // The number's lower byte in red, its higher one in green.
  const bytes = new Uint8Array(2 * cells.length);
  for (const [at, number] of cells.entries()) bytes.set([number & 255, number >> 8], 2 * at);
  const map = new DataTexture(bytes, columns, rows * house.storeys.length, RGFormat, UnsignedByteType);
  // A place for each room's number from 1 on, in rows: textures may not be as wide as there are rooms.
  const levelRows = Math.ceil((roomsOf(house).length + 1) / LEVELS_WIDE);
  const values = new Float32Array(4 * LEVELS_WIDE * levelRows);
  const levels = new DataTexture(values, LEVELS_WIDE, levelRows, RGBAFormat, FloatType);
  for (const texture of [map, levels]) {
    texture.minFilter = NearestFilter;
    texture.magFilter = NearestFilter;
    texture.unpackAlignment = 1;
    texture.needsUpdate = true;
  }
  return {
    roomMap: { value: map },
    roomLevels: { value: levels },
    roomGrid: { value: new Vector3(corner[0], corner[1], 1 / cell_m) },
    roomRows: { value: rows },
    storeyEnds: { value: house.storeys.map(({ floor_m, height_m }) => [floor_m, floor_m + height_m]).flat() },
    lampAt: { value: Array.from({ length: MOST_LAMPS }, () => new Vector4()) },
    lampRoom: { value: Array<number>(MOST_LAMPS).fill(-1) },
    lampColour: { value: LAMP_COLOUR },
    dayColour: { value: DAY_COLOUR },
    roomDay: { value: 0 },
  };
}

/** Lets the light of rooms fall on a material. Materials of other kinds stay as they are. */
export function lightByRooms(material: Material, uniforms: RoomUniforms, storeys: number): void {
  if (!(material instanceof MeshStandardMaterial)) return;
  const before = material.onBeforeCompile.bind(material);
  const key = material.customProgramCacheKey();
  material.onBeforeCompile = (shader, renderer) => {
    before(shader, renderer);
    Object.assign(shader.uniforms, uniforms);
    shader.vertexShader = shader.vertexShader
      .replace("#include <common>", "#include <common>\nvarying vec3 vPlace;")
      .replace("#include <project_vertex>", `#include <project_vertex>
        vec4 place = vec4(transformed, 1.0);
        #ifdef USE_INSTANCING
        place = instanceMatrix * place;
        #endif
        vPlace = (modelMatrix * place).xyz;`);
    shader.fragmentShader = shader.fragmentShader
      .replace("#include <common>", `#include <common>\n#define STOREYS ${storeys}\n${HEAD}`)
      .replace("#include <lights_fragment_end>", `#include <lights_fragment_end>\n${BODY}`);
  };
  material.customProgramCacheKey = () => `${key} rooms ${storeys}`;
  material.needsUpdate = true;
}

const HEAD = `
  varying vec3 vPlace;
  uniform sampler2D roomMap, roomLevels;
  uniform vec3 roomGrid, lampColour, dayColour;
  uniform float roomRows, roomDay;
  uniform float storeyEnds[2 * STOREYS];
  uniform vec4 lampAt[${MOST_LAMPS}];
  uniform float lampRoom[${MOST_LAMPS}];

  int roomAt(vec3 p) {
    vec2 cell = floor((vec2(p.x, -p.z) - roomGrid.xy) * roomGrid.z);
    ivec2 size = textureSize(roomMap, 0);
    if (cell.x < 0.0 || cell.y < 0.0 || cell.x >= float(size.x) || cell.y >= roomRows) return 0;
    for (int i = 0; i < STOREYS; i++) {
      if (p.y < storeyEnds[2 * i] || p.y >= storeyEnds[2 * i + 1]) continue;
      vec2 bytes = texelFetch(roomMap, ivec2(cell) + ivec2(0, i * int(roomRows)), 0).rg;
      return int(bytes.r * 255.0 + 0.5) + 256 * int(bytes.g * 255.0 + 0.5);
    }
    return 0;
  }

  // Irradiance in units of the scene, on a place with this normal that is seen from there.
  vec3 roomLight(vec3 p, vec3 n, vec3 toEye, out float within) {
    int room = roomAt(p + 0.1 * n);
    // Linings of doors and sills lie in walls: they belong to where they are seen from.
    if (room == 0) room = roomAt(p + 0.3 * toEye);
    within = room == 0 ? 0.0 : 1.0;
    if (room == 0) return vec3(0.0);
    float lamps = texelFetch(roomLevels, ivec2(room % ${LEVELS_WIDE}, room / ${LEVELS_WIDE}), 0).r;
    for (int i = 0; i < ${MOST_LAMPS}; i++) {
      if (int(lampRoom[i]) + 1 != room) continue;
      vec3 way = lampAt[i].xyz - p;
      float squared = dot(way, way);
      lamps += lampAt[i].w * max(0.0, dot(n, way) * inversesqrt(squared)) / max(squared, ${LEAST_SQUARED_M2});
    }
    return lamps * lampColour + roomDay * dayColour;
  }`;

/** A share of the sky's light gives way to the room's: the sky does not shine through ceilings. */
const BODY = `
  float withinRoom;
  vec3 toEye = inverseTransformDirection(normalize(vViewPosition), viewMatrix);
  vec3 ofRoom = roomLight(vPlace, inverseTransformDirection(normal, viewMatrix), toEye, withinRoom);
  reflectedLight.indirectDiffuse *= 1.0 - 0.55 * withinRoom;
  reflectedLight.indirectDiffuse += ofRoom * BRDF_Lambert(material.diffuseContribution);`;
