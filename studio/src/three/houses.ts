/** The houses of a place: parts with rooms, and what their documents say of them. */
import { Fault, faultOf } from "../core/fault.ts";
import { readHouse } from "../core/house.ts";
import { fileAddress } from "../core/place.ts";
import { fetchText } from "./fetch.ts";
import type { LoadedHouse } from "./household.ts";
import type { LoadedPart } from "./load.ts";

/** Maps and lamps are for those whom one visits; a place of many more is a town. */
const MOST_HOUSES = 40;

/** A document that is broken or not there is told, and its house shown without map and lamps. */
export async function loadHouses(
  parts: readonly LoadedPart[],
  manifest: URL,
  onFault: (fault: Fault) => void,
): Promise<LoadedHouse[]> {
  const houses: LoadedHouse[] = [];
  for (const part of parts) {
    const file = part.part.document;
    if (file === null || !isInhabited(part) || houses.length >= MOST_HOUSES) continue;
    try {
      const text = await fetchText(fileAddress(file, manifest), file);
      const house = readHouse(text, file, part.part.worldFromPart);
      if (house !== null) houses.push({ house, part });
    } catch (error) {
      onFault(faultOf(error));
    }
  }
  return houses;
}

/** Buildings that were made of their outsides alone have no ceilings. */
function isInhabited({ movers, table }: LoadedPart): boolean {
  return movers.length > 0 || table.rows.some((feature) => feature.class === "ceiling");
}
