/** When the feet of a clip stand, as its model tells it. Nothing of that is taken on trust. */
import type { Vec3 } from "./vector.ts";

export interface Footing {
  readonly foot: string;
  /** Joints of its leg, from the body on. */
  readonly leg: readonly string[];
  /** Where the leg ends, in the frame of the last of them. */
  readonly end: Vec3;
  /** From when to when it stands (s), in order. */
  readonly down: readonly (readonly [number, number])[];
}

/** How far a foot is in its stand, or in its swing. */
export interface FootPhase {
  readonly stands: boolean;
  /** 0..1 of the stand or of the swing. */
  readonly done: number;
  /** How long the stand, or that which follows the swing, lasts as a whole (s). */
  readonly stand_s: number;
}

const MOST_FEET = 64;
const MOST_JOINTS = 16;

/** Feet of a clip whose legs are known; none where the extras say nothing that can be used. */
export function readFootings(extras: unknown): Footing[] {
  const contacts = field(field(extras, "veduta"), "contacts");
  if (!Array.isArray(contacts)) return [];
  return contacts.slice(0, MOST_FEET).flatMap((one): Footing[] => {
    const [foot, leg, end, down] = ["foot", "leg", "end", "down_s"].map((name) => field(one, name));
    if (typeof foot !== "string" || !isNames(leg) || !isNumbers(end, 3) || !Array.isArray(down)) return [];
    const spans = down.filter(isSpan);
    return spans.length === 0 ? [] : [{ foot, leg, end: end as unknown as Vec3, down: spans }];
  });
}

/** Where a foot is at a time of a clip that begins anew at its end. */
export function phaseOf({ down }: Footing, time_s: number, clip_s: number): FootPhase {
  const spans = joined(down, clip_s);
  const whole = (from: number, to: number): number => (to - from + 2 * clip_s) % clip_s;
  for (const [from, to] of spans) {
    const [since, lasts] = [whole(from, time_s), to - from];
    if (since <= lasts) return { stands: true, done: lasts > 0 ? since / lasts : 0, stand_s: lasts };
  }
  let best: FootPhase = { stands: false, done: 0, stand_s: 0 };
  let nearest = Infinity;
  for (const [from, to] of spans) {
    const ahead = whole(time_s, from);
    if (ahead >= nearest) continue;
    nearest = ahead;
    const since = Math.min(...spans.map(([, end]) => whole(end, time_s)));
    best = { stands: false, done: since / Math.max(since + ahead, 1e-9), stand_s: to - from };
  }
  return best;
}

/** A stand over the clip's end is one: it ends after that. */
function joined(down: Footing["down"], clip_s: number): (readonly [number, number])[] {
  const [first, last] = [down[0], down.at(-1)];
  if (first === undefined || last === undefined || down.length < 2) return [...down];
  if (first[0] > 1e-6 || last[1] < clip_s - 1e-6) return [...down];
  return [...down.slice(1, -1), [last[0], clip_s + first[1]]];
}

function field(value: unknown, name: string): unknown {
  return typeof value === "object" && value !== null ? (value as Record<string, unknown>)[name] : undefined;
}

function isNames(value: unknown): value is string[] {
  return Array.isArray(value) && value.length > 0 && value.length <= MOST_JOINTS && value.every((one) => typeof one === "string");
}

function isSpan(value: unknown): value is [number, number] {
  return isNumbers(value, 2) && (value[0] ?? 0) < (value[1] ?? 0);
}

function isNumbers(value: unknown, count: number): value is number[] {
  return Array.isArray(value) && value.length === count && value.every((one) => Number.isFinite(one));
}
