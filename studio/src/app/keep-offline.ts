/** An exported folder works without a network once it was seen; `veduta view` and other addresses need none. */

/** Begins when the place is there, so that it takes nothing from the first picture. */
export async function keepOffline(page: URL): Promise<void> {
  const isExport = !page.searchParams.has("place");
  if (!import.meta.env.PROD || !isExport || !("serviceWorker" in navigator)) return;
  try {
    await navigator.serviceWorker.register("./offline.js");
    const { active } = await navigator.serviceWorker.ready;
    active?.postMessage("keep");
  } catch (error) {
    // Private windows and some servers have none: the place is there all the same.
    console.info(error);
  }
}
