import { describe, expect, it, vi } from "vitest";
import { type Help, Helper } from "../../src/three/hired.ts";

interface Numbered {
  readonly id: number;
}

/** A worker that never answers. */
function silent(postMessage: (message: unknown) => void = () => undefined): Help {
  return { postMessage, terminate: vi.fn(), onmessage: null, onerror: null, onmessageerror: null };
}

describe("a worker of the page", () => {
  it("is let go when it breaks, and nobody waits for it any longer", async () => {
    const help = silent();
    const helper = new Helper<Numbered, Numbered>(() => help);
    const asked = helper.ask({});
    help.onerror?.call(undefined as never, new Event("error") as ErrorEvent);
    expect(await asked).toBeNull();
    expect(help.terminate).toHaveBeenCalledTimes(1);
    expect([helper.isThere, await helper.ask({})]).toEqual([false, null]);
  });

  it("is done without where its work cannot be copied", async () => {
    let posted = 0;
    const help = silent(() => {
      posted += 1;
      if (posted === 1) throw new RangeError("memory is short");
    });
    const helper = new Helper<Numbered, Numbered>(() => help);
    expect(await helper.ask({})).toBeNull();
    const second = helper.ask({});
    help.onmessage?.call(undefined as never, { data: { id: 2 } } as MessageEvent);
    expect(await second).toEqual({ id: 2 });
  });

  it("is started once, by the first who asks", () => {
    const hire = vi.fn(() => null);
    const helper = new Helper<Numbered, Numbered>(hire);
    expect(hire).not.toHaveBeenCalled();
    expect([helper.isThere, helper.isThere, hire.mock.calls.length]).toEqual([false, false, 1]);
  });
});
