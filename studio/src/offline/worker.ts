/** The service worker of an exported folder: what was once seen is seen again without a network. */
import { nameOf } from "./record.ts";
import { Shelf } from "./shelf.ts";

/** More than this nobody wants kept on his machine without having been asked (bytes). */
const ROOM_BYTES = 200e6;

/** What this file uses of a service worker's scope, which the types of pages do not have. */
interface Extendable extends Event {
  waitUntil(work: Promise<unknown>): void;
}
interface Fetching extends Extendable {
  readonly request: Request;
  respondWith(answer: Promise<Response>): void;
}
interface Scope {
  readonly registration: { readonly scope: string };
  readonly clients: { claim(): Promise<void> };
  skipWaiting(): Promise<void>;
  addEventListener(type: "install" | "activate" | "message", listener: (event: Extendable) => void): void;
  addEventListener(type: "fetch", listener: (event: Fetching) => void): void;
}

const scope = globalThis as unknown as Scope;
const folder = new URL(scope.registration.scope);
const shelf = new Shelf(folder);

scope.addEventListener("install", (event) => event.waitUntil(shelf.renew().then(() => scope.skipWaiting())));
scope.addEventListener("activate", (event) => event.waitUntil(scope.clients.claim()));
// The page says that the place is there: now the rest may come.
scope.addEventListener("message", (event) => event.waitUntil(shelf.fill(ROOM_BYTES)));
scope.addEventListener("fetch", (event) => {
  const { request } = event;
  const name = request.method === "GET" && !request.headers.has("range") ? nameOf(new URL(request.url), folder) : null;
  if (name !== null) event.respondWith(answer(name, request));
});

async function answer(name: string, request: Request): Promise<Response> {
  if (request.mode === "navigate") await shelf.renew();
  return await shelf.answer(name, request);
}
