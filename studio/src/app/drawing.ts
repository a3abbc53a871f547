/** All that draws, in one piece: three.js is most of the program, and arrives while the place does. */
export { CloudArrivals } from "../three/clouds.ts";
export { Frusta } from "../three/frusta.ts";
export { Grower } from "../three/grower.ts";
export { bringHouse } from "../three/houses.ts";
export { readPart } from "../three/load.ts";
export { MorphShow } from "../three/morph-show.ts";
export { PartSlot, stillOf } from "../three/part-slot.ts";
export { bitmapOf, PhotoTextures } from "../three/photo-textures.ts";
export { bringingBy, Recorded } from "../three/recorded.ts";
export { SharedImages } from "../three/shared-images.ts";
export { Town } from "../three/town.ts";
export { Viewer } from "../three/viewer.ts";
