/** What a page gives to the graphics card: runs in the page before its own scripts. */
export function countGl() {
  const made = WebGL2RenderingContext.prototype;
  const bound = new Map();
  const textures = new Map();
  const totals = { draws: 0, triangles: 0 };
  /** Bytes of a pixel by the sized format; four where it is not listed. */
  const BYTES = { 0x8814: 16, 0x881a: 8, 0x822d: 2, 0x8229: 1, 0x8058: 4, 0x8c43: 4, 0x81a6: 4, 0x8cac: 4 };
  const BIND = { 0x8513: 6 };
  let unit = 0;
  const before = (name, note) => {
    const own = made[name];
    made[name] = function (...given) {
      note(...given);
      return own.apply(this, given);
    };
  };
  const target = (kind) => (kind >= 0x8515 && kind <= 0x851a ? 0x8513 : kind);
  const holds = (kind, format, width, height, levels) => {
    const texture = bound.get(`${unit} ${target(kind)}`);
    if (!texture) return;
    const bytes = width * height * (BYTES[format] ?? 4) * (levels > 1 ? 4 / 3 : 1) * (BIND[kind] ?? 1);
    textures.set(texture, bytes);
  };
  const drawn = (mode, count, times = 1) => {
    totals.draws += 1;
    if (mode === 4) totals.triangles += (count / 3) * times;
  };
  before("activeTexture", (which) => (unit = which));
  before("bindTexture", (kind, texture) => bound.set(`${unit} ${kind}`, texture));
  before("texStorage2D", (kind, levels, format, width, height) => holds(kind, format, width, height, levels));
  before("texImage2D", (kind, level, format, width, height, ...rest) => {
    if (level === 0 && rest.length === 4) holds(kind, format, width, height, 1);
  });
  before("deleteTexture", (texture) => textures.delete(texture));
  before("drawElements", (mode, count) => drawn(mode, count));
  before("drawArrays", (mode, _first, count) => drawn(mode, count));
  before("drawElementsInstanced", (mode, count, _type, _at, times) => drawn(mode, count, times));
  before("drawArraysInstanced", (mode, _first, count, times) => drawn(mode, count, times));
  window.countedGl = () => ({
    ...totals,
    textures: textures.size,
    texture_bytes: [...textures.values()].reduce((sum, bytes) => sum + bytes, 0),
  });
}
