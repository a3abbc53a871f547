/** The colours and strengths of sun, sky and ground at an hour of the day. */
import { Color, MathUtils } from "three";
import type { Daylight } from "../core/daylight.ts";

export interface SkyLight {
  readonly sun: Color;
  readonly sunStrength: number;
  readonly above: Color;
  readonly below: Color;
  readonly strength: number;
  readonly zenith: Color;
  readonly horizon: Color;
  readonly glow: Color;
  readonly glowStrength: number;
  /** By what the colours of the unlit ground are multiplied. */
  readonly ground: Color;
  /** By what a picture of the surroundings is multiplied, which was taken by day. */
  readonly picture: Color;
  /** How dark the sun's or the moon's shadows are, as a share of those by day. */
  readonly shade: number;
}

type Strengths = "sunStrength" | "strength" | "shade";
type Colours = Exclude<keyof SkyLight, Strengths | "glowStrength">;
type Look = Readonly<Record<Colours, string> & Record<Strengths, number>>;

/** Calm daylight that leaves the photos' colours as they are. */
const DAY: Look = {
  sun: "#fff6ea", sunStrength: 3.1, above: "#e3edf7", below: "#d8d0c2", strength: 2.05,
  zenith: "#7ea6c9", horizon: "#e4eaee", glow: "#fff3dc", ground: "#ffffff", picture: "#ffffff", shade: 1,
};
/** The sun on the horizon: mixed in by how near it is. */
const DUSK: Look = {
  sun: "#ff9d5c", sunStrength: 1.5, above: "#b9b6c8", below: "#8f7f78", strength: 1.0,
  zenith: "#5f7ba6", horizon: "#e9b48f", glow: "#ffb26b", ground: "#c9a899", picture: "#c9a899", shade: 0.7,
};
/** A clear night with a moon: one still finds one's way. */
const NIGHT: Look = {
  sun: "#b4c6e8", sunStrength: 0.55, above: "#8b99b6", below: "#6a7484", strength: 1.35,
  zenith: "#101a2e", horizon: "#2c3a52", glow: "#3f547c", ground: "#566279", picture: "#384257", shade: 0.7,
};

export function skyLightAt({ day, dusk, light, glow }: Daylight): SkyLight {
  const colour = (name: Colours): Color =>
    new Color(NIGHT[name]).lerp(new Color(DAY[name]), day).lerp(new Color(DUSK[name]), DUSK_SHARE * dusk);
  const strength = (name: Strengths): number =>
    MathUtils.lerp(MathUtils.lerp(NIGHT[name], DAY[name], day), DUSK[name], DUSK_SHARE * dusk);
  return {
    // The moon has its own colour and strength, however red the sky still is.
    sun: light.isMoon ? new Color(NIGHT.sun) : colour("sun"),
    sunStrength: light.share * (light.isMoon ? NIGHT.sunStrength : strength("sunStrength")),
    above: colour("above"),
    below: colour("below"),
    strength: strength("strength"),
    zenith: colour("zenith"),
    horizon: colour("horizon"),
    glow: glow.isMoon ? new Color(NIGHT.glow) : colour("glow"),
    glowStrength: glow.share,
    ground: colour("ground"),
    picture: colour("picture"),
    shade: light.share * (light.isMoon ? NIGHT.shade : strength("shade")),
  };
}

const DUSK_SHARE = 0.75;
