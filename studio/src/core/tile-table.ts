/**
 * What the surfaces of a tile are: the property tables of EXT_structural_metadata that
 * `formats/tile_glb.py` writes. Rows become features when somebody asks for one.
 */
import { isProvenance, isSemanticClass, type Provenance, type SemanticClass } from "./classes.ts";
import { Fault } from "./fault.ts";
import type { Feature, FeatureTable } from "./features.ts";

/** The bytes of a buffer view of the tile's file. */
export type Views = (view: number) => Uint8Array;

const NO_SIZE_MM = 65_535;
const REMEDY = "Write the tiles again with this version of Veduta.";

interface Column {
  readonly values: number;
  readonly stringOffsets?: number;
}

interface Table {
  readonly class: string;
  readonly count: number;
  readonly properties: Readonly<Record<string, Column | undefined>>;
}

interface Metadata {
  readonly schema: {
    readonly enums: Readonly<
      Record<string, { readonly values: readonly { name: string; value: number }[] } | undefined>
    >;
  };
  readonly propertyTables: readonly Table[];
}

export class TileTable implements FeatureTable {
  readonly count: number;
  readonly #classes: readonly (SemanticClass | undefined)[];
  readonly #rules: readonly string[];
  readonly #provenances: readonly (Provenance | undefined)[];
  readonly #provenance: Uint8Array | null;
  readonly #class: Uint8Array;
  readonly #building: Uint16Array | null;
  readonly #rule: Uint16Array | null;
  readonly #width: Uint16Array | null;
  readonly #height: Uint16Array | null;
  readonly #ids: readonly string[];
  readonly #names: readonly string[];
  #rows: WeakRef<readonly Feature[]> | null = null;
  #counts: ReadonlyMap<SemanticClass, number> | null = null;

  /** `metadata` is the extension of the document's root; it may come from anywhere. */
  constructor(metadata: unknown, views: Views, file: string) {
    const { schema, propertyTables } = checked(metadata, file);
    const [surfaces, buildings] = propertyTables;
    if (surfaces === undefined || buildings === undefined) {
      throw new Fault(file, "it does not say what its surfaces are", REMEDY);
    }
    const named = (name: string): string[] => {
      const found: string[] = [];
      for (const { name: text, value } of schema.enums[name]?.values ?? []) found[value] = text;
      return found;
    };
    this.count = surfaces.count;
    this.#classes = named("semantic").map((name) => (isSemanticClass(name) ? name : undefined));
    this.#rules = named("rule");
    this.#provenances = named("provenance").map((name) => (isProvenance(name) ? name : undefined));
    const column = (name: string): Uint8Array | null => {
      const view = surfaces.properties[name]?.values;
      return view === undefined ? null : views(view);
    };
    const sixteen = (name: string): Uint16Array | null => {
      const bytes = column(name);
      if (bytes === null) return null;
      if (bytes.byteLength < 2 * this.count) throw new Fault(file, "a table is cut short", REMEDY);
      return new Uint16Array(bytes.slice().buffer);
    };
    this.#class = column("class") ?? new Uint8Array();
    if (this.#class.length < this.count) throw new Fault(file, "a table is cut short", REMEDY);
    this.#provenance = column("provenance");
    this.#building = sixteen("building");
    this.#rule = sixteen("rule");
    this.#width = sixteen("width");
    this.#height = sixteen("height");
    this.#ids = texts(buildings, "id", views);
    this.#names = texts(buildings, "name", views);
  }

  /** All rows as features. They take ten times what the columns do, so nobody keeps them who does not use them. */
  get rows(): readonly Feature[] {
    const known = this.#rows?.deref();
    if (known !== undefined) return known;
    const made = Array.from({ length: this.count }, (_, row) => this.#feature(row));
    this.#rows = new WeakRef(made);
    return made;
  }

  /** Ids end with their row. */
  ending(text: string): { readonly row: number; readonly id: string } | null {
    const row = Number(/-(\d+)$/.exec(text)?.[1] ?? NaN);
    if (!(row < this.count)) return null;
    const { id } = this.#feature(row);
    return text.endsWith(id) ? { row, id } : null;
  }

  classOf(row: number): SemanticClass {
    return this.#classes[this.#class[row] ?? 255] ?? "other";
  }

  /** The name of the building that a surface belongs to. */
  buildingOf(row: number): string {
    return this.#names[this.#building?.[row] ?? 0] ?? "";
  }

  /** A table without the column has invented surfaces only. */
  provenanceOf(row: number): Provenance {
    return this.#provenances[this.#provenance?.[row] ?? 255] ?? "invented";
  }

  /** How many surfaces of each class there are. */
  counts(): ReadonlyMap<SemanticClass, number> {
    this.#counts ??= counted(this.count, (row) => this.classOf(row));
    return this.#counts;
  }

  /** How many surfaces there are of each provenance. */
  provenances(): ReadonlyMap<Provenance, number> {
    return this.#provenance === null
      ? new Map([["invented", this.count]])
      : counted(this.count, (row) => this.provenanceOf(row));
  }

  #feature(row: number): Feature {
    const building = this.#building?.[row] ?? 0;
    const rule = this.#rules[this.#rule?.[row] ?? NO_SIZE_MM] ?? "";
    return {
      id: `${this.#ids[building] ?? ""}/${rule === "" ? "building" : rule}-${row}`,
      class: this.classOf(row),
      parent: null,
      provenance: this.provenanceOf(row),
      name: rule,
      width_m: metres(this.#width?.[row]),
      height_m: metres(this.#height?.[row]),
      area_m2: null,
      photo_px: null,
      seen_height_m: null,
      score: null,
    };
  }
}

function counted<K>(rows: number, keyOf: (row: number) => K): Map<K, number> {
  const found = new Map<K, number>();
  for (let row = 0; row < rows; row += 1) {
    const key = keyOf(row);
    found.set(key, (found.get(key) ?? 0) + 1);
  }
  return found;
}

function metres(size_mm: number | undefined): number | null {
  return size_mm === undefined || size_mm === NO_SIZE_MM ? null : size_mm / 1000;
}

function checked(metadata: unknown, file: string): Metadata {
  const given = metadata as Partial<Metadata> | null | undefined;
  if (typeof given !== "object" || given?.schema?.enums === undefined || !Array.isArray(given.propertyTables)) {
    throw new Fault(file, "it does not say what its surfaces are", REMEDY);
  }
  return given as Metadata;
}

function texts(table: Table, name: string, views: Views): string[] {
  const column = table.properties[name];
  if (column?.stringOffsets === undefined) return [];
  const bytes = views(column.values);
  const offsets = new Uint32Array(views(column.stringOffsets).slice().buffer);
  const decoder = new TextDecoder();
  return Array.from({ length: table.count }, (_, row) =>
    decoder.decode(bytes.subarray(offsets[row] ?? 0, offsets[row + 1] ?? 0)),
  );
}
