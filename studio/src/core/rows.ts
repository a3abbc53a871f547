/** Which rows of a long list are to be drawn: all of equal height, and only those that are seen. */

export interface Rows {
  readonly first: number;
  /** One past the last. */
  readonly end: number;
}

/** A few more on both sides, so that scrolling finds them there. */
const MARGIN = 4;

export function rowsSeen(count: number, row_px: number, top_px: number, height_px: number): Rows {
  const first = Math.max(0, Math.floor(top_px / row_px) - MARGIN);
  const end = Math.min(count, Math.ceil((top_px + height_px) / row_px) + MARGIN);
  return { first: Math.min(first, end), end };
}

/** The least scrolling that shows a row whole. */
export function scrolledTo(row: number, row_px: number, top_px: number, height_px: number): number {
  const upper = row * row_px;
  if (upper < top_px) return upper;
  return Math.max(top_px, upper + row_px - height_px);
}

/** Where a key leads in the list; null where it is none of its keys. */
export function rowAfter(key: string, row: number, count: number, page: number): number | null {
  const to: Readonly<Record<string, number>> = {
    ArrowDown: row + 1,
    ArrowUp: row - 1,
    PageDown: row + page,
    PageUp: row - page,
    Home: 0,
    End: count - 1,
  };
  const wanted = to[key];
  return wanted === undefined ? null : Math.min(count - 1, Math.max(0, wanted));
}
