/** What the page says of the place to search engines, to cards of links and to the tab. */
import type { Session } from "./session.ts";
import { titleOf } from "./words.ts";

const GENERAL = "A measured, walkable place made with Veduta";

export function fillHead(session: Session): void {
  const { description, author, licence } = session.place.about;
  const title = titleOf(session);
  document.title = `${title} · Veduta`;
  say("name", "description", description === "" ? GENERAL : description);
  say("name", "author", author);
  say("name", "license", licence);
  say("property", "og:title", title);
  say("property", "og:description", description === "" ? GENERAL : description);
  say("property", "og:type", "website");
}

/** A field of the head; none where there is nothing to say. */
function say(kind: "name" | "property", field: string, words: string): void {
  if (words === "") return;
  let meta = document.head.querySelector(`meta[${kind}="${field}"]`);
  if (meta === null) {
    meta = document.createElement("meta");
    meta.setAttribute(kind, field);
    document.head.append(meta);
  }
  meta.setAttribute("content", words);
}
