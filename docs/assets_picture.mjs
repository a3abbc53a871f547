// A picture of a place from the front: node docs/assets_picture.mjs ADDRESS CHROMIUM FOLDER
// Writes sheet.png, without panels.
import { shoot, withStudio } from "./studio_page.mjs";

await withStudio(async (open) => {
  const page = await open({ viewport: { width: 2600, height: 1700 } });
  await page.keyboard.press("KeyL");
  await page.keyboard.press("Digit2");
  await shoot(page, "sheet.png");
});
