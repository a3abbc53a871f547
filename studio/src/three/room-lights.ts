/** The lamps of a house: which of them shine, and what they light. */
import {
  AdditiveBlending,
  BufferAttribute,
  BufferGeometry,
  Points,
  ShaderMaterial,
  Vector2,
  type Vector4,
} from "three";
import { drawnFromWorld } from "../core/frames.ts";
import type { House, Lamp } from "../core/house.ts";
import { type Occasion, reflectedLux, RoomSwitches } from "../core/lights.ts";
import { roomsOf } from "../core/room-map.ts";
import type { Vec3 } from "../core/vector.ts";
import { lightByRooms, MOST_LAMPS, type RoomUniforms, roomUniforms } from "./room-material.ts";
import type { LoadedPart } from "./load.ts";

/** Illuminance (lx) that looks as one unit of the scene's light: by night the eye makes more of it. */
const NIGHT_LUX = 42;
const DAY_LUX = 160;
/** What the windows let in on a bright day, in the same unit. */
const DAY_FILL = 1.5;
/** Without lamps a room is not black by night: the eye gets used to it. */
const NIGHT_FILL = 0.3;
const CANDELA_PER_LUMEN = 1 / (4 * Math.PI);
const GLOW_M = 0.42;

interface PlacedLamp {
  readonly lamp: Lamp;
  /** Number of its room over all storeys. */
  readonly room: number;
}

export class RoomLights {
  readonly glow: Points<BufferGeometry, ShaderMaterial>;
  readonly #uniforms: RoomUniforms;
  readonly #switches: RoomSwitches;
  readonly #lamps: readonly PlacedLamp[];
  readonly #reflected: readonly number[];
  #day = 1;

  /** Takes over how the part's materials are lit. */
  constructor(house: House, part: LoadedPart) {
    this.#lamps = placedLamps(house);
    const hasLamps = roomsOf(house).map((_, room) => this.#lamps.some((lamp) => lamp.room === room));
    this.#switches = new RoomSwitches(hasLamps);
    this.#reflected = reflectedLux(house);
    this.#uniforms = roomUniforms(house);
    const materials = new Set([...part.meshes, ...part.instanced].flatMap(({ mesh }) => [mesh.material].flat()));
    for (const material of materials) lightByRooms(material, this.#uniforms, house.storeys.length);
    this.glow = glowOf(this.#lamps);
  }

  /** By the room's number over all storeys, from 0 (dark) to 1. */
  get levels(): Float32Array {
    return this.#switches.levels;
  }

  /** `day` from 0 (night) to 1. */
  set day(day: number) {
    this.#day = day;
    this.#uniforms.roomDay.value = NIGHT_FILL + (DAY_FILL - NIGHT_FILL) * day;
  }

  /** True while lamps go on or off. */
  advance(occasion: Occasion, eye: Vec3, seconds: number): boolean {
    const fades = this.#switches.advance(occasion, seconds);
    this.#shine(eye);
    return fades;
  }

  #shine(eye: Vec3): void {
    const perLux = this.#day / DAY_LUX + (1 - this.#day) / NIGHT_LUX;
    const { lampAt, lampRoom, roomLevels } = this.#uniforms;
    const data = roomLevels.value.image.data as Float32Array;
    for (const [room, level] of this.levels.entries()) data[4 * (room + 1)] = level * (this.#reflected[room] ?? 0) * perLux;
    roomLevels.value.needsUpdate = true;
    const nearest = this.#lamps
      .filter(({ room }) => (this.levels[room] ?? 0) > 0)
      .map((each) => ({ ...each, away: distance(each.lamp.at, eye) }))
      .toSorted((a, b) => a.away - b.away)
      .slice(0, MOST_LAMPS);
    for (const [i, at] of lampAt.value.entries()) {
      const shining = nearest[i];
      lampRoom.value[i] = shining?.room ?? -1;
      if (shining !== undefined) put(at, shining.lamp, (this.levels[shining.room] ?? 0) * perLux);
    }
    const glows = this.glow.geometry.getAttribute("level") as BufferAttribute;
    for (const [i, { room }] of this.#lamps.entries()) glows.setX(i, this.levels[room] ?? 0);
    glows.needsUpdate = true;
  }
}

function placedLamps(house: House): PlacedLamp[] {
  let first = 0;
  return house.storeys.flatMap(({ lamps, rooms }) => {
    const before = first;
    first += rooms.length;
    return lamps.flatMap((lamp) => (lamp.room === null ? [] : [{ lamp, room: before + lamp.room }]));
  });
}

function put(at: Vector4, { at: place, lumen }: Lamp, perLux: number): void {
  const [x, y, z] = drawnFromWorld(place);
  at.set(x, y, z, lumen * CANDELA_PER_LUMEN * perLux);
}

function distance(a: Vec3, b: Vec3): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/** A soft spot of light where each lamp is. */
function glowOf(lamps: readonly PlacedLamp[]): Points<BufferGeometry, ShaderMaterial> {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(lamps.flatMap(({ lamp }) => drawnFromWorld(lamp.at))), 3));
  geometry.setAttribute("level", new BufferAttribute(new Float32Array(lamps.length), 1));
  const height_px = { value: 1 };
  const material = new ShaderMaterial({
    blending: AdditiveBlending,
    transparent: true,
    depthWrite: false,
    uniforms: { height_px },
    vertexShader: `
      attribute float level;
      uniform float height_px;
      varying float vLevel;
      void main() {
        vec4 seen = modelViewMatrix * vec4(position, 1.0);
        vLevel = level;
        gl_Position = projectionMatrix * seen;
        gl_PointSize = level > 0.0 ? ${GLOW_M} * height_px * projectionMatrix[1][1] / (2.0 * max(0.2, -seen.z)) : 0.0;
      }`,
    fragmentShader: `
      varying float vLevel;
      void main() {
        float off = length(2.0 * gl_PointCoord - 1.0);
        if (off > 1.0 || vLevel <= 0.0) discard;
        float bright = 0.85 * smoothstep(0.3, 0.0, off) + 0.3 * (1.0 - off) * (1.0 - off);
        gl_FragColor = vec4(vec3(1.0, 0.86, 0.64) * bright * vLevel, 1.0);
      }`,
  });
  const glow = new Points(geometry, material);
  glow.frustumCulled = false;
  glow.visible = lamps.length > 0;
  glow.renderOrder = 3;
  const size = new Vector2();
  glow.onBeforeRender = (renderer) => {
    height_px.value = renderer.getDrawingBufferSize(size).y;
  };
  return glow;
}
