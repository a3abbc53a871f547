/** The feature table of a part: what each surface of its mesh is. */
import {
  isDrawnOnly,
  isProvenance,
  isSemanticClass,
  type Provenance,
  type SemanticClass,
} from "./classes.ts";
import { Fault } from "./fault.ts";

/** x, y, width, height in the rectified photo; pixels, y down. */
export type PhotoRectangle = readonly [number, number, number, number];

export interface Feature {
  readonly id: string;
  readonly class: SemanticClass;
  /** Row of the parent in the same table. */
  readonly parent: number | null;
  readonly provenance: Provenance;
  readonly name: string;
  /** Along and up the surface; null where the surface has no such size. */
  readonly width_m: number | null;
  readonly height_m: number | null;
  readonly area_m2: number | null;
  readonly photo_px: PhotoRectangle | null;
  /** How much of the height was seen, from the top, where a rule makes it reach further down. */
  readonly seen_height_m: number | null;
  /** How sure it was, 0 to 1, where what read the record says it. */
  readonly score: number | null;
}

/** The mesh's `_FEATURE_ID_0` is the row of the face's feature, as in EXT_mesh_features. */
export interface FeatureTable {
  readonly rows: readonly Feature[];
  /** The row with whose id a text ends; only where a table can tell it without making its rows. */
  ending?(text: string): { readonly row: number; readonly id: string } | null;
}

const COLUMNS = [
  "id",
  "class",
  "parent",
  "provenance",
  "name",
  "width_m",
  "height_m",
  "area_m2",
  "photo_px",
] as const;
/** Columns that models of an older Veduta, or most models, do not have: all cells are then null. */
const LATER_COLUMNS = ["seen_height_m", "score"] as const;
type Column = (typeof COLUMNS)[number] | (typeof LATER_COLUMNS)[number];
const REMEDY = "Write the model again with this version of Veduta.";

/** Reads the columns that a GLB carries in `scenes[0].extras.veduta.features`. */
export function readFeatureTable(columns: unknown, file: string): FeatureTable {
  const table = readColumns(columns, file);
  const rows = table.id.map((_, row) => readRow(table, row, file));
  if (new Set(rows.map((feature) => feature.id)).size !== rows.length) {
    throw new Fault(file, "two features of its table have the same id", REMEDY);
  }
  return { rows };
}

function readColumns(columns: unknown, file: string): Record<Column, unknown[]> {
  if (typeof columns !== "object" || columns === null) {
    throw new Fault(file, "the model has no feature table", REMEDY);
  }
  const given = columns as Partial<Record<Column, unknown>>;
  const rows = Array.isArray(given.id) ? given.id.length : 0;
  const entries = [
    ...COLUMNS.map((name) => [name, given[name]] as const),
    ...LATER_COLUMNS.map((name) => [name, given[name] ?? Array<null>(rows).fill(null)] as const),
  ];
  for (const [name, column] of entries) {
    if (!Array.isArray(column) || column.length !== rows) {
      throw new Fault(file, `column "${name}" of its feature table is missing or cut short`, REMEDY);
    }
  }
  return Object.fromEntries(entries) as Record<Column, unknown[]>;
}

function readRow(table: Record<Column, unknown[]>, row: number, file: string): Feature {
  const bad = (column: Column): Fault =>
    new Fault(file, `row ${row} of its feature table has no proper "${column}"`, REMEDY);
  const size = (column: Column): number | null => {
    const value = table[column][row];
    if (value === null) return null;
    if (typeof value !== "number" || !Number.isFinite(value)) throw bad(column);
    return value;
  };
  const { id, class: kind, provenance, name, parent } = cells(table, row);
  if (typeof id !== "string") throw bad("id");
  if (!isSemanticClass(kind)) throw bad("class");
  if (!isProvenance(provenance)) throw bad("provenance");
  if (typeof name !== "string") throw bad("name");
  if (!isParent(parent, row, table.id.length)) throw bad("parent");
  return {
    id,
    class: kind,
    parent: parent < 0 ? null : parent,
    provenance,
    name,
    width_m: size("width_m"),
    height_m: size("height_m"),
    area_m2: size("area_m2"),
    photo_px: readRectangle(table.photo_px[row], () => bad("photo_px")),
    seen_height_m: size("seen_height_m"),
    score: size("score"),
  };
}

function cells(table: Record<Column, unknown[]>, row: number): Record<Column, unknown> {
  const entries = [...COLUMNS, ...LATER_COLUMNS].map(
    (column) => [column, table[column][row]] as const,
  );
  return Object.fromEntries(entries) as Record<Column, unknown>;
}

function isParent(value: unknown, row: number, rows: number): value is number {
  return Number.isInteger(value) && (value as number) < rows && value !== row;
}

function readRectangle(value: unknown, bad: () => Fault): PhotoRectangle | null {
  if (value === null || value === undefined) return null;
  if (!Array.isArray(value) || value.length !== 4) throw bad();
  const [x, y, w, h] = value.map((v: unknown) => (Number.isFinite(v) ? (v as number) : Number.NaN));
  if ([x, y, w, h].some((v) => v === undefined || Number.isNaN(v))) throw bad();
  return [x, y, w, h] as PhotoRectangle;
}

/** The row that a link names: by its id alone, or by whose it is and its id. */
export function rowNamed(table: FeatureTable, named: string, ownerOf: (row: number) => string): number | null {
  const isNamed = (id: string, row: number): boolean => named === id || (named.endsWith(`/${id}`) && named === `${ownerOf(row)}/${id}`);
  if (table.ending !== undefined) {
    const found = table.ending(named);
    return found !== null && isNamed(found.id, found.row) ? found.row : null;
  }
  const row = table.rows.findIndex(({ id }, at) => isNamed(id, at));
  return row < 0 ? null : row;
}

export function childrenOf(table: FeatureTable, row: number): readonly Feature[] {
  return table.rows.filter((feature) => feature.parent === row);
}

/** Whether faces of these features are there to be looked at alone, all of them. */
export function areDrawnOnly(rows: Iterable<number>, table: { readonly rows: readonly Feature[] }): boolean {
  for (const row of new Set(rows)) {
    const kind = table.rows[row]?.class;
    if (kind === undefined || !isDrawnOnly(kind)) return false;
  }
  return true;
}

/**
 * How many things of each class there are, classes without any left out. A feature within one of
 * its own class is a piece of that thing (a balcony's floor, a window's reveal in its wall).
 */
export function countClasses(tables: readonly FeatureTable[]): Map<SemanticClass, number> {
  const whole = tables.map((table) => ({
    rows: table.rows.filter(
      ({ parent, class: own }) => parent === null || table.rows[parent]?.class !== own,
    ),
  }));
  return countBy(whole, (feature) => feature.class);
}

/** How many things a feature carries, by class; pieces of itself (of its own class) left out. */
export function countCarried(table: FeatureTable, row: number): Map<SemanticClass, number> {
  const own = table.rows[row]?.class;
  const carried = childrenOf(table, row).filter((feature) => feature.class !== own);
  return countBy([{ rows: carried }], (feature) => feature.class);
}

export function countProvenances(tables: readonly FeatureTable[]): Map<Provenance, number> {
  return countBy(tables, (feature) => feature.provenance);
}

function countBy<K>(tables: readonly FeatureTable[], keyOf: (feature: Feature) => K): Map<K, number> {
  const counts = new Map<K, number>();
  for (const table of tables) {
    for (const feature of table.rows) {
      const key = keyOf(feature);
      counts.set(key, (counts.get(key) ?? 0) + 1);
    }
  }
  return counts;
}
