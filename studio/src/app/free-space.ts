/** Which part of the picture the panels leave free. */
import type { Insets } from "../core/framing.ts";

/** By where the panels are on the page now. */
export function insetsOf(page: ParentNode, canvas: HTMLCanvasElement): Insets {
  const { width, height } = canvas.getBoundingClientRect();
  const boxOf = (name: string): DOMRect | null => page.querySelector(name)?.getBoundingClientRect() ?? null;
  const [brand, layers, tools] = [boxOf(".brand"), boxOf(".left"), boxOf("veduta-toolbar")];
  const panel = boxOf("veduta-feature-panel");
  const below = panel !== null && panel.height > 0 && panel.width > 0.5 * width ? panel.top : null;
  const beside = (box: DOMRect | null): boolean => box !== null && box.width > 0 && box.width < 0.4 * width;
  return {
    left: beside(layers) ? (layers?.right ?? 0) / width : 0,
    right: beside(panel) ? 1 - (panel?.left ?? width) / width : 0,
    top: beside(layers) ? 0 : (brand?.bottom ?? 0) / height,
    bottom: 1 - (below ?? tools?.top ?? height) / height,
  };
}

/** Panels then lie below or over one another. */
export function isNarrow(): boolean {
  return matchMedia("(max-width: 720px)").matches;
}
