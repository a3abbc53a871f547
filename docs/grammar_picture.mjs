// Pictures of a derived street: node docs/grammar_picture.mjs ADDRESS CHROMIUM FOLDER
// Writes orbit.png (the street from above) and walk.png (in the street at eye level).
import { shoot, withStudio } from "./studio_page.mjs";

await withStudio(async (open) => {
  const page = await open({ viewport: { width: 1100, height: 700 } });
  await page.keyboard.press("KeyL");
  await page.keyboard.press("KeyR"); // the whole street, now that the panel is gone
  await shoot(page, "orbit.png");
  await page.keyboard.press("Digit2");
  await shoot(page, "walk.png");
});
