/** A worker's own program, called in this thread with copies, as between threads. The test imports the program. */
import type { Help } from "../../src/three/hired.ts";

interface Scope {
  onmessage: (event: { data: unknown }) => void;
  postMessage: (answer: unknown) => void;
}
const scope = globalThis as unknown as Scope;

/** It answers at once, or what it was asked last when the test says so. */
export function helpHere(when: "at once" | "when told" = "at once"): Help & { readonly asked: readonly number[]; readonly answer: () => void } {
  const asked: number[] = [];
  let waiting: unknown = null;
  const help = {
    asked,
    onmessage: null as Help["onmessage"],
    onerror: null as Help["onerror"],
    onmessageerror: null as Help["onmessageerror"],
    terminate: () => undefined,
    postMessage: (message: { readonly id: number }) => {
      asked.push(message.id);
      waiting = structuredClone(message);
      if (when === "at once") help.answer();
    },
    answer: () => {
      scope.postMessage = (answer) => {
        help.onmessage?.call(undefined as never, { data: structuredClone(answer) } as MessageEvent);
      };
      if (waiting !== null) scope.onmessage({ data: waiting });
    },
  };
  return help;
}
