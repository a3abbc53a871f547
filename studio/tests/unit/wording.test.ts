import { describe, expect, it } from "vitest";
import { seenText, sizeText } from "../../src/core/wording.ts";

describe("sizes in words", () => {
  it("gives both sides to the centimetre", () => {
    expect(sizeText(1.104, 1.899)).toBe("1.10 × 1.90 m");
    expect(sizeText(null, 1.9)).toBe("– × 1.90 m");
    expect(sizeText(null, null)).toBe("not flat");
  });

  it("says how much was seen only where not all was", () => {
    expect(seenText(1.3)).toBe("(height seen: 1.30 m)");
    expect(seenText(null)).toBe("");
  });
});
