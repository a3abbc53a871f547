/** `veduta-web.json`: the files of an exported place and the digest of each. It comes from a server: nothing is taken on trust. */

export type WebRecord = ReadonlyMap<string, string>;

export const RECORD_NAME = "veduta-web.json";
const MOST_FILES = 200_000;

/** Null where the text is no such record. */
export function readRecord(text: string): WebRecord | null {
  let value: unknown;
  try {
    value = JSON.parse(text);
  } catch {
    return null;
  }
  if (typeof value !== "object" || value === null) return null;
  const { schema, files } = value as { schema?: unknown; files?: unknown };
  if (schema !== "veduta/web" || typeof files !== "object" || files === null) return null;
  const entries = Object.entries(files);
  if (entries.length > MOST_FILES) return null;
  const sound = entries.filter((entry): entry is [string, string] => typeof entry[1] === "string" && /^[0-9a-f]{64}$/.test(entry[1]));
  return new Map(sound);
}

/** The name in the record of what is asked for; null for what lies outside of the folder. */
export function nameOf(address: URL, folder: URL): string | null {
  if (address.origin !== folder.origin || !address.pathname.startsWith(folder.pathname)) return null;
  try {
    const name = decodeURIComponent(address.pathname.slice(folder.pathname.length));
    return name === "" || name.endsWith("/") ? `${name}index.html` : name;
  } catch {
    return null;
  }
}

export function hexOf(digest: ArrayBuffer): string {
  return [...new Uint8Array(digest)].map((byte) => byte.toString(16).padStart(2, "0")).join("");
}
