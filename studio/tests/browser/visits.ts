/** Tests that visit one place: a browser and a site for all of a file, a fresh page for each. */
import { expect, test } from "vitest";
import { launch } from "./chromium.ts";
import { open } from "./page.ts";
import { makeSite } from "./site.ts";

/**
 * A test that takes `{ page }`, in which the place is open; it fails where the page complains.
 * `furnish` changes the folder of the site before it is served.
 */
export function visits(furnish: (folder: string) => void = () => undefined) {
  return test
    .extend("furnish", { scope: "file" }, () => furnish)
    .extend("opened", { scope: "file" }, async ({ furnish: change }, { onCleanup }) => {
      const [site, browser] = [await makeSite(), await launch()];
      onCleanup(async () => {
        await browser.close();
        await site.close();
      });
      change(site.folder);
      return { browser, origin: site.origin };
    })
    .extend("page", async ({ opened }, { onCleanup }) => {
      const { page, complaints } = await open(opened.browser, `${opened.origin}/`);
      onCleanup(async () => {
        await page.context().close();
        expect(complaints).toEqual([]);
      });
      return page;
    });
}
