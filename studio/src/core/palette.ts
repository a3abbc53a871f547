/** The commands that a person may look for by their names, as far as a place has something for them. */
import { COMMAND_BINDINGS, type Command } from "./input.ts";

/** Commands that are told nothing and have no key. */
export type Keyless = "headset" | "ask-now";

export interface Entry {
  readonly name: Command | Keyless;
  readonly text: string;
  /** The key, as it is shown; empty where there is none. */
  readonly key: string;
}

/** What a place has that some commands want. */
export interface Has {
  readonly houses: boolean;
  readonly photos: boolean;
  readonly tours: boolean;
  readonly walks: boolean;
  readonly missing: boolean;
}

const WANTS: Partial<Record<Entry["name"], (has: Has) => boolean>> = {
  "next-photo": ({ photos }) => photos,
  "previous-photo": ({ photos }) => photos,
  project: ({ photos }) => photos,
  fading: ({ photos }) => photos,
  daylight: ({ houses }) => houses,
  lights: ({ houses }) => houses,
  doors: ({ houses }) => houses,
  map: ({ houses }) => houses,
  tour: ({ tours, walks }) => tours || walks,
  stroll: ({ walks }) => walks,
  "morph-look": ({ walks }) => walks,
  headset: ({ walks }) => walks,
  "ask-now": ({ missing }) => missing,
  // They are about the list itself.
  palette: () => false,
};

const KEYLESS: readonly Entry[] = [
  { name: "headset", text: "Walk in a headset", key: "" },
  { name: "ask-now", text: "Ask at once for the files that have not come", key: "" },
];

export function entriesOf(has: Has): Entry[] {
  const bound = COMMAND_BINDINGS.map(({ action, shown, text }): Entry => ({ name: action, text, key: shown }));
  return [...bound, ...KEYLESS].filter(({ name }) => WANTS[name]?.(has) ?? true);
}

/** Those in whose words each of the typed ones begins, or whose key it is. */
export function matching(entries: readonly Entry[], typed: string): Entry[] {
  const asked = wordsOf(typed);
  return entries.filter(({ name, text, key }) => {
    const own = [...wordsOf(text), ...wordsOf(name)];
    return asked.every((word) => own.some((one) => one.startsWith(word)) || (asked.length === 1 && key.toLowerCase() === word));
  });
}

function wordsOf(text: string): string[] {
  return text.toLowerCase().split(/[^\p{L}\p{N}?]+/u).filter((word) => word !== "");
}
