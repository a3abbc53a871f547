import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { Address } from "../../src/app/address.ts";
import type { Commands } from "../../src/app/commands.ts";
import type { Session } from "../../src/app/session.ts";
import type { Feature, FeatureTable } from "../../src/core/features.ts";
import { INITIAL_STATE } from "../../src/core/state.ts";
import { Store } from "../../src/core/store.ts";

const LINK = "#mode=orbit&pick=Mill/b1/Window-2";

/** A tile that holds one surface. */
function tile(id: string): FeatureTable & { readonly asked: () => number } {
  const ending = vi.fn((text: string) => (text.endsWith(id) ? { row: 0, id } : null));
  return { rows: [] as Feature[], ending, asked: () => ending.mock.calls.length };
}

/** A page before a streamed place whose tiles come when the test says so. */
function page(tables: FeatureTable[]) {
  const store = new Store(INITIAL_STATE);
  const chosen: unknown[] = [];
  const commands = {
    do: (name: string, told: unknown) => {
      if (name === "select") chosen.push(told);
    },
  } as unknown as Commands;
  const session = {
    place: { shots: [], tours: [], walks: [], animals: [], parts: [] },
    tables, town: {}, nameOf: () => "Mill",
  } as unknown as Session;
  return { address: new Address(session, store, commands), chosen, store };
}

describe("a link to a surface that has not come", () => {
  beforeEach(() => {
    vi.stubGlobal("addEventListener", () => undefined);
    vi.stubGlobal("window", { setTimeout: () => 0 });
  });
  afterEach(() => vi.unstubAllGlobals());

  it("looks at each tile once, and chooses the surface when it comes", () => {
    const first = tile("b1/Window-1");
    const tables: FeatureTable[] = [first];
    const { address, chosen } = page(tables);
    expect(address.show(LINK)).toBe(true);
    for (let k = 0; k < 5; k += 1) address.arrived();
    expect([first.asked(), chosen]).toEqual([1, []]);
    tables.push(tile("b1/Window-2"));
    address.arrived();
    expect([first.asked(), chosen]).toEqual([1, [{ part: 1, row: 0 }]]);
  });

  it("is forgotten by whoever clicks or closes something, or lets go of a surface", () => {
    const tables: FeatureTable[] = [];
    const { address, chosen, store } = page(tables);
    address.show(LINK);
    address.drop();
    tables.push(tile("b1/Window-2"));
    address.arrived();
    store.update({ selected: { part: 0, row: 0 } });
    tables.length = 0;
    address.show(LINK);
    store.update({ selected: null });
    tables.push(tile("b1/Window-2"));
    address.arrived();
    expect(chosen).toEqual([]);
  });
});
