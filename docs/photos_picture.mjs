// Pictures of photos in a city model: node docs/photos_picture.mjs ADDRESS CHROMIUM FOLDER
// Writes above.png (model, points, places of the photos) and walk.png (in the street; photos fade in).
import { shoot, withStudio } from "./studio_page.mjs";

await withStudio(async (open) => {
  const page = await open({ viewport: { width: 1100, height: 700 } });
  await page.keyboard.press("KeyL");
  await page.waitForTimeout(3000);
  await shoot(page, "above.png");
  await page.keyboard.press("Digit2");
  await page.waitForTimeout(5000);
  await shoot(page, "walk.png");
});
