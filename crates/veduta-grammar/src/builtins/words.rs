//! Words that select something: sets that several operations and functions share.

use super::Words;

pub const AXES: Words = &["x", "y", "z"];
pub const AXIS_SETS: Words = &["x", "y", "z", "xy", "xz", "yz", "xyz"];
pub const ADJUST: Words = &["adjust", "noAdjust"];
pub const COMPONENTS: Words = &["f", "e", "fe", "v", "fv", "g", "m", "h"];
pub const KINDS: Words = &["all", "faces", "edges", "vertices", "auto"];
pub const SPACES: Words = &["scope", "pivot", "object", "world"];
pub const ROOF_VALUES: Words = &["byAngle", "byHeight"];

/// What a cell of `comp`, `modify` and the setbacks may select.
pub const COMPONENT_SELECTORS: Words = &[
    "front",
    "back",
    "left",
    "right",
    "top",
    "bottom",
    "side",
    "object.front",
    "object.back",
    "object.left",
    "object.right",
    "object.top",
    "object.bottom",
    "object.side",
    "world.south",
    "world.north",
    "world.west",
    "world.east",
    "world.up",
    "world.down",
    "world.side",
    "street.front",
    "street.back",
    "street.left",
    "street.right",
    "street.side",
    "streetSide",
    "noStreetSide",
    "uv.left",
    "uv.right",
    "uv.bottom",
    "uv.top",
    "uv.side",
    "uv.uMin",
    "uv.uMax",
    "uv.vMin",
    "uv.vMax",
    "vertical",
    "horizontal",
    "aslant",
    "nutant",
    "border",
    "inside",
    "eave",
    "hip",
    "valley",
    "ridge",
    "all",
];

/// What is left of a face by a setback.
pub const REMAINDER: &str = "remainder";

/// What a cell of `shapeL`, `innerRectangle` and their like may select.
pub const SHAPE_SELECTORS: Words = &["shape", REMAINDER];
pub const REST_SELECTORS: Words = &[REMAINDER];

/// Faces of which functions measure the area or the direction.
pub const FACE_SELECTORS: Words = &[
    "all",
    "surface",
    "front",
    "back",
    "left",
    "right",
    "top",
    "bottom",
    "side",
    "object.front",
    "object.back",
    "object.left",
    "object.right",
    "object.top",
    "object.bottom",
    "object.side",
    "world.south",
    "world.north",
    "world.west",
    "world.east",
    "world.up",
    "world.down",
    "world.side",
    "street.front",
    "street.back",
    "street.left",
    "street.right",
    "street.side",
];
