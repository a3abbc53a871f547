import { describe, expect, it, vi } from "vitest";
import { Absent, Fault } from "../../src/core/fault.ts";
import { Wishes } from "../../src/core/wishes.ts";
import { Fake } from "./surroundings.ts";

const absent = new Absent("a.webp", "the file is not there", "Copy it.");

/** What loads in this order; the last for all that is asked later. */
function loading(answers: readonly (string | Fault)[]): { load: () => Promise<string>; count: () => number } {
  let asked = 0;
  const load = async (): Promise<string> => {
    const answer = answers[Math.min(asked, answers.length - 1)] ?? "";
    asked += 1;
    return typeof answer === "string" ? await Promise.resolve(answer) : await Promise.reject(answer);
  };
  return { load, count: () => asked };
}

function wishes(): { all: Wishes; around: Fake; changes: ReturnType<typeof vi.fn> } {
  const [around, changes] = [new Fake(), vi.fn()];
  return { all: new Wishes(changes, around), around, changes };
}

describe("a file that is wished for", () => {
  it("is taken when it comes, and never named", async () => {
    const { all, changes } = wishes();
    const taken: string[] = [];
    const wish = all.bring("a.webp", loading(["here"]).load, (brought) => taken.push(brought));
    expect(all.waiting).toBe(1);
    await wish.tried;
    expect(taken).toEqual(["here"]);
    expect([all.waiting, all.missing.length, changes.mock.calls.length]).toEqual([0, 0, 1]);
  });

  it("is named while it does not come, asked for again after a pause, and taken then", async () => {
    const { all, around, changes } = wishes();
    const taken: string[] = [];
    await all.bring("a.webp", loading([absent, absent, "here"]).load, (brought) => taken.push(brought)).tried;
    expect(all.missing).toEqual([{ file: "a.webp", fault: absent }]);
    around.wait();
    await vi.waitFor(() => expect(changes).toHaveBeenCalledTimes(2));
    expect([taken, all.missing.length, around.pauses]).toEqual([[], 1, [2000, 4000]]);
    all.askNow();
    await vi.waitFor(() => expect(changes).toHaveBeenCalledTimes(3));
    expect([taken, all.missing]).toEqual([["here"], []]);
  });

  it("is named but not asked for again where it is broken", async () => {
    const { all, around } = wishes();
    const { load, count } = loading([new Fault("a.webp", "it is cut short", "Copy it.")]);
    await all.bring("a.webp", load, () => undefined).tried;
    around.wait();
    all.askNow();
    around.network();
    expect([count(), all.missing.map(({ file }) => file)]).toEqual([1, ["a.webp"]]);
  });

  it("is forgotten when nobody wants it any more", async () => {
    const { all, around } = wishes();
    const { load, count } = loading([absent]);
    const wish = all.bring("a.webp", load, () => undefined);
    await wish.tried;
    wish.drop();
    expect(all.missing).toEqual([]);
    around.wait();
    expect(count()).toBe(1);
  });

  it("is not asked for twice at once, though another fails meanwhile, and is taken once", async () => {
    const { all, around } = wishes();
    const taken: string[] = [];
    const slow: ((answer: string) => void)[] = [];
    const load = vi.fn<() => Promise<string>>().mockRejectedValueOnce(absent);
    load.mockImplementation(async () => await new Promise((resolve) => slow.push(resolve)));
    await all.bring("a.webp", load, (brought) => taken.push(brought)).tried;
    around.wait();
    await vi.waitFor(() => expect(load).toHaveBeenCalledTimes(2));
    const other = loading([absent]);
    await all.bring("b.webp", other.load, () => undefined).tried;
    around.wait();
    await vi.waitFor(() => expect(other.count()).toBe(2));
    for (const come of slow) come("here");
    await vi.waitFor(() => expect(all.missing.map(({ file }) => file)).toEqual(["b.webp"]));
    expect([load.mock.calls.length, taken]).toEqual([2, ["here"]]);
  });

  it("waits for its turn where many are wished for, and is not asked for where it is dropped before", async () => {
    const { all } = wishes();
    const slow: ((answer: string) => void)[] = [];
    const load = vi.fn(async () => await new Promise<string>((resolve) => slow.push(resolve)));
    const many = Array.from({ length: 8 }, (_, k) => all.bring(`${k}.webp`, load, () => undefined));
    expect([load.mock.calls.length, all.waiting, many[7]?.isUnderway]).toEqual([6, 8, true]);
    many[6]?.drop();
    slow[0]?.("here");
    await vi.waitFor(() => expect(load).toHaveBeenCalledTimes(7));
    for (const come of slow.slice(1)) come("here");
    await Promise.all(many.map(async ({ tried }) => await tried));
    expect([load.mock.calls.length, all.waiting, many[7]?.isUnderway]).toEqual([7, 0, false]);
  });

  it("is named where it comes but cannot be taken", async () => {
    const { all } = wishes();
    const take = (): void => {
      throw new Fault("a.webp", "it does not fit", "Copy it.");
    };
    await all.bring("a.webp", loading(["here"]).load, take).tried;
    expect(all.missing.map(({ fault }) => fault.fault)).toEqual(["it does not fit"]);
  });

  it("is named once where two wish for it", async () => {
    const { all } = wishes();
    await Promise.all([1, 2].map(async () => await all.bring("a.webp", loading([absent]).load, () => undefined).tried));
    expect(all.missing).toHaveLength(1);
  });
});
