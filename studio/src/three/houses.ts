/** The houses of a place: parts with rooms, and what their documents say of them. */
import { Fault, faultOf } from "../core/fault.ts";
import { readHouse } from "../core/house.ts";
import { fileAddress } from "../core/place.ts";
import { fetchText } from "./fetch.ts";
import type { LoadedHouse } from "./household.ts";
import type { LoadedPart } from "./load.ts";

/** Maps and lamps are for those whom one visits; a place of many more is a town. */
const MOST_HOUSES = 40;

/**
 * The house of a part that has come, where it is one and there are not too many already. A document that
 * is broken or not there is told, and its house shown without map and lamps.
 */
export async function loadHouse(
  part: LoadedPart,
  manifest: URL,
  already: number,
  onFault: (fault: Fault) => void,
): Promise<LoadedHouse | null> {
  const file = part.part.document;
  if (file === null || !isInhabited(part) || already >= MOST_HOUSES) return null;
  try {
    const text = await fetchText(fileAddress(file, manifest), file);
    const house = readHouse(text, file, part.part.worldFromPart);
    return house === null ? null : { house, part };
  } catch (error) {
    onFault(faultOf(error));
    return null;
  }
}

/** Buildings that were made of their outsides alone have no ceilings. */
function isInhabited({ movers, table }: LoadedPart): boolean {
  return movers.length > 0 || table.rows.some((feature) => feature.class === "ceiling");
}
