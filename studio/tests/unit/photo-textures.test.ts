import { describe, expect, it, vi } from "vitest";
import { Wishes } from "../../src/core/wishes.ts";
import type { Shot } from "../../src/core/place.ts";
import { CHOSEN_PX, PASSING_PX, PhotoTextures } from "../../src/three/photo-textures.ts";
import { Fake } from "./surroundings.ts";

describe("photos that do not come", () => {
  it("are asked for no longer when nobody wants them", async () => {
    const fetched = vi.fn(async () => await Promise.resolve(new Response(null, { status: 503 })));
    vi.stubGlobal("fetch", fetched);
    const around = new Fake();
    const wishes = new Wishes(() => undefined, around);
    const shot = { picture: "photos/a.webp", width_px: 40, height_px: 30 } as unknown as Shot;
    const textures = new PhotoTextures([shot], new URL("http://place/place.json"), 4096, wishes);
    const [passing, chosen] = [textures.acquire(0, PASSING_PX), textures.acquire(0, CHOSEN_PX)];
    await vi.waitFor(() => expect(wishes.missing).toHaveLength(1));
    textures.release(0, PASSING_PX);
    expect(await passing).toBeNull();
    expect(wishes.missing).toHaveLength(1); // one is wanted still
    textures.release(0, CHOSEN_PX);
    expect([await chosen, wishes.missing]).toEqual([null, []]);
    const before = fetched.mock.calls.length;
    around.wait();
    expect(fetched.mock.calls.length).toBe(before);
    vi.unstubAllGlobals();
  });
});
