/** Whom a key that is pressed belongs to. */

/** What moves a slider; other keys do nothing on it. */
const SLIDES = /^(Arrow|Home|End|Page)/;

/** Keys pressed in a field or on a switch belong to it, except those that no control uses. */
export function isTyping(event: KeyboardEvent): boolean {
  const target = event.composedPath()[0];
  if (target instanceof HTMLInputElement && target.type === "range") return SLIDES.test(event.code);
  return target instanceof HTMLInputElement || target instanceof HTMLTextAreaElement;
}
