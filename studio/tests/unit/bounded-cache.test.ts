import { describe, expect, it } from "vitest";
import { BoundedCache } from "../../src/core/bounded-cache.ts";

interface Thing {
  readonly name: string;
  gone: boolean;
}

function cacheOf(most: number): { cache: BoundedCache<string, Thing>; loads: string[]; things: Thing[] } {
  const loads: string[] = [];
  const things: Thing[] = [];
  const cache = new BoundedCache<string, Thing>(most, {
    load: async (name) => {
      loads.push(name);
      await Promise.resolve();
      if (name === "missing") return null;
      const thing = { name, gone: false };
      things.push(thing);
      return thing;
    },
    cost: () => 1,
    dispose: (thing) => (thing.gone = true),
  });
  return { cache, loads, things };
}

describe("a bounded cache", () => {
  it("loads what is asked for twice at once only once", async () => {
    const { cache, loads } = cacheOf(2);
    const [a, b] = await Promise.all([cache.acquire("a"), cache.acquire("a")]);
    expect(a).toBe(b);
    expect(loads).toEqual(["a"]);
  });

  it("lets go of the one that was used longest ago, and of none that is in use", async () => {
    const { cache, things } = cacheOf(2);
    for (const name of ["a", "b"]) {
      await cache.acquire(name);
      cache.release(name);
    }
    await cache.acquire("a");
    await cache.acquire("c");
    expect(things.filter(({ gone }) => gone).map(({ name }) => name)).toEqual(["b"]);
    await cache.acquire("d");
    expect(cache.cost).toBe(3);
    cache.release("a");
    expect(things.find(({ name }) => name === "a")?.gone).toBe(true);
    expect(cache.cost).toBe(2);
  });

  it("keeps its bound over a long walk", async () => {
    const { cache, things } = cacheOf(5);
    for (let step = 0; step < 200; step += 1) {
      const name = String((step * 7) % 31);
      await cache.acquire(name);
      cache.release(name);
      expect(cache.cost).toBeLessThanOrEqual(5);
    }
    expect(things.filter(({ gone }) => !gone)).toHaveLength(5);
  });

  it("tries again what could not be had", async () => {
    const { cache, loads } = cacheOf(2);
    expect(await cache.acquire("missing")).toBeNull();
    expect(await cache.acquire("missing")).toBeNull();
    expect(loads).toHaveLength(2);
    expect(cache.size).toBe(0);
  });

  it("lets go of what arrives after it was given up", async () => {
    const { cache, things } = cacheOf(2);
    const late = cache.acquire("a");
    cache.dispose();
    await late;
    await Promise.resolve();
    expect(things.every(({ gone }) => gone)).toBe(true);
    expect(cache.size).toBe(0);
  });

  it("does not wait for what nobody wants any more", async () => {
    const give: ((value: string | null) => void)[] = [];
    const load = async (): Promise<string | null> => await new Promise((resolve) => give.push(resolve));
    const cancel = (): boolean => {
      give[0]?.(null);
      return true;
    };
    const cache = new BoundedCache<string, string>(10, { load, cancel, cost: () => 1, dispose: () => undefined });
    const first = cache.acquire("a");
    cache.release("a");
    const second = cache.acquire("a"); // of one that comes back it is loaded anew
    expect([await first, give.length]).toEqual([null, 2]);
    give[1]?.("a");
    expect([await second, cache.size]).toEqual(["a", 1]);
  });
});
