/** Whom a key that is pressed belongs to. */

/** Keys pressed in a field or on a switch belong to it, except those that no control uses. */
export function isTyping(event: KeyboardEvent): boolean {
  const target = event.composedPath()[0];
  return target instanceof HTMLInputElement || target instanceof HTMLTextAreaElement;
}
