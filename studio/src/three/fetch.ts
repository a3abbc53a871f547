/** Fetching with progress, and with faults that say what to do. */
import { Absent, Fault } from "../core/fault.ts";

/** More than a browser tab can hold; refused before memory is taken. */
const MOST_BYTES = 1_500_000_000;

export type OnBytes = (loaded: number, total: number | null) => void;

export async function fetchText(url: URL, file: string): Promise<string> {
  const response = await get(url, file);
  return await response.text();
}

export async function fetchBytes(url: URL, file: string, onBytes: OnBytes): Promise<ArrayBuffer> {
  const response = await get(url, file);
  const announced = Number(response.headers.get("content-length") ?? Number.NaN);
  const encoded = response.headers.has("content-encoding");
  const total = Number.isFinite(announced) && announced > 0 && !encoded ? announced : null;
  if (total !== null && total > MOST_BYTES) throw tooLarge(file);
  if (response.body === null) return await response.arrayBuffer();
  const chunks: Uint8Array[] = [];
  let loaded = 0;
  const reader = response.body.getReader();
  for (;;) {
    const { done, value } = await reader.read().catch((error: unknown) => {
      throw interrupted(file, error);
    });
    if (done) break;
    chunks.push(value);
    loaded += value.byteLength;
    if (loaded > MOST_BYTES) throw tooLarge(file);
    onBytes(loaded, total);
  }
  return joined(chunks, loaded);
}

async function get(url: URL, file: string): Promise<Response> {
  const response = await fetch(url).catch((error: unknown) => {
    throw interrupted(file, error);
  });
  if (response.ok) return response;
  if (response.status === 404) {
    throw new Absent(
      file,
      "the file is not there",
      "Check that the folder is complete, or write the place again, for example with `veduta facade`.",
    );
  }
  if (response.status === 401 || response.status === 403) {
    throw new Fault(
      file,
      "the server does not let this page read it",
      "Open the whole address that `veduta view` printed, with its token.",
    );
  }
  throw new Absent(file, `the server answers ${response.status}`, "Look at the server's own messages.");
}

function interrupted(file: string, error: unknown): Fault {
  const words = error instanceof Error ? error.message : String(error);
  return new Absent(
    file,
    `it could not be fetched (${words})`,
    "Check that the server still runs (`veduta view`), then try again.",
  );
}

function tooLarge(file: string): Fault {
  return new Fault(file, "it is larger than a browser can hold", "Split the place into smaller parts.");
}

function joined(chunks: readonly Uint8Array[], size: number): ArrayBuffer {
  const whole = new Uint8Array(size);
  let at = 0;
  for (const chunk of chunks) {
    whole.set(chunk, at);
    at += chunk.byteLength;
  }
  return whole.buffer;
}
