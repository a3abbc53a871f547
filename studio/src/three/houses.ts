/** The houses of a place: parts with rooms, and what their documents say of them. */
import { type House, readHouse } from "../core/house.ts";
import { fileAddress } from "../core/place.ts";
import type { Wishes } from "../core/wishes.ts";
import { fetchText } from "./fetch.ts";
import type { LoadedPart } from "./load.ts";

/** Maps and lamps are for those whom one visits; a place of many more is a town. */
const MOST_HOUSES = 40;

/**
 * Asks for the house of a part that has come, where it is one and there are not too many already. While its
 * document does not come, or where it is broken, the house is shown without map and lamps. `take` gets it
 * after `ready`; the result comes when it was asked for once.
 */
export async function bringHouse(
  part: LoadedPart,
  manifest: URL,
  already: number,
  wishes: Wishes,
  ready: Promise<unknown>,
  take: (house: House) => void,
): Promise<void> {
  const file = part.part.document;
  if (file === null || !isInhabited(part) || already >= MOST_HOUSES) return;
  const read = async (): Promise<House | null> => {
    const text = await fetchText(fileAddress(file, manifest), file);
    await ready;
    return readHouse(text, file, part.part.worldFromPart);
  };
  await wishes.bring(file, read, (house) => {
    if (house !== null) take(house);
  }).tried;
}

/** Buildings that were made of their outsides alone have no ceilings. */
function isInhabited({ movers, table }: LoadedPart): boolean {
  return movers.length > 0 || table.rows.some((feature) => feature.class === "ceiling");
}
