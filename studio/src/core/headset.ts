/** A headset on a walk: whether there is one, and what its controllers ask for. */

/** How far a stick must be pushed before one goes. */
const DEAD = 0.2;

/** What of a controller counts here. */
export interface Stick {
  readonly gamepad?: { readonly axes: readonly number[] } | null | undefined;
}

export async function headsetIsThere(xr: Pick<XRSystem, "isSessionSupported"> | undefined = navigator.xr): Promise<boolean> {
  try {
    return (await xr?.isSessionSupported("immersive-vr")) ?? false;
  } catch {
    return false; // the page may not ask: it is framed by another that does not let it
  }
}

/** Forward -1..1: the stick that is pushed furthest. A stick is axes 2 and 3, a touch pad 0 and 1. */
export function pushOf(sources: Iterable<Stick>): number {
  let push = 0;
  for (const { gamepad } of sources) {
    const ahead = -(gamepad?.axes[3] ?? gamepad?.axes[1] ?? 0);
    if (Math.abs(ahead) > Math.max(DEAD, Math.abs(push))) push = ahead;
  }
  return Math.max(-1, Math.min(1, push));
}
