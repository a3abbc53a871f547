/**
 * The files of an exported place, kept by their digests: what has the digest that the folder's record
 * says is never asked for again, and what was cut on its way is never kept.
 */
import { hexOf, readRecord, RECORD_NAME, type WebRecord } from "./record.ts";

/** So long the record of a server that does not answer is waited for, where an older one is there (ms). */
const PATIENCE_MS = 3000;

export class Shelf {
  readonly #folder: URL;
  #record: WebRecord | null = null;

  constructor(folder: URL) {
    this.#folder = folder;
  }

  /** Asks the server what its files are now; the record that was kept where it does not say. */
  async renew(): Promise<WebRecord | null> {
    const cache = await this.#cache();
    const address = new URL(RECORD_NAME, this.#folder);
    try {
      const response = await fetch(address, { cache: "no-cache", signal: AbortSignal.timeout(PATIENCE_MS) });
      const record = response.ok ? readRecord(await response.clone().text()) : null;
      if (record !== null) await cache.put(address, response);
      this.#record = record ?? (await this.#kept());
    } catch {
      this.#record = await this.#kept();
    }
    return this.#record;
  }

  /** What was kept of a file, or the server's answer, which is kept if it is whole. */
  async answer(name: string, request: Request): Promise<Response> {
    const digest = (await this.#known())?.get(name);
    if (digest === undefined) return await fetch(request);
    const key = this.#keyOf(name, digest);
    const kept = await (await this.#cache()).match(key);
    if (kept !== undefined) return kept;
    const response = await fetch(new Request(request.url, { cache: "no-cache" }));
    if (response.ok) await this.#keep(key, digest, response.clone());
    return response;
  }

  /** Fetches what is not here yet, so long as there is room (bytes), and lets go of what is of an older place. */
  async fill(room_bytes: number): Promise<void> {
    const record = await this.#known();
    if (record === null) return;
    const cache = await this.#cache();
    const wanted = new Map([...record].map(([name, digest]) => [this.#keyOf(name, digest), { name, digest }]));
    for (const { url } of await cache.keys()) {
      if (wanted.has(url)) wanted.delete(url);
      else if (url !== new URL(RECORD_NAME, this.#folder).href) await cache.delete(url);
    }
    let room = room_bytes;
    for (const [key, { name, digest }] of wanted) {
      if (room <= 0) return;
      const response = await fetch(new URL(escaped(name), this.#folder), { cache: "no-cache" });
      if (response.ok) room -= await this.#keep(key, digest, response);
    }
  }

  async #known(): Promise<WebRecord | null> {
    this.#record ??= await this.#kept();
    return this.#record;
  }

  async #kept(): Promise<WebRecord | null> {
    const kept = await (await this.#cache()).match(new URL(RECORD_NAME, this.#folder));
    return kept === undefined ? null : readRecord(await kept.text());
  }

  /** Returns how large it was; nothing is kept of what is not what the record says. */
  async #keep(key: string, digest: string, response: Response): Promise<number> {
    const content = await response.arrayBuffer();
    if (hexOf(await crypto.subtle.digest("SHA-256", content)) !== digest) return 0;
    const headers = new Headers({ "content-type": response.headers.get("content-type") ?? "application/octet-stream" });
    headers.set("content-length", String(content.byteLength));
    await (await this.#cache()).put(key, new Response(content, { headers }));
    return content.byteLength;
  }

  #keyOf(name: string, digest: string): string {
    return new URL(`${escaped(name)}?sha256=${digest}`, this.#folder).href;
  }

  async #cache(): Promise<Cache> {
    return await caches.open(`veduta ${this.#folder.href}`);
  }
}

function escaped(name: string): string {
  return name.split("/").map(encodeURIComponent).join("/");
}
