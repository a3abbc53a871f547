//! The operations: how many arguments they take, which words these may be, and their block.

use super::words::{
    ADJUST, AXES, AXIS_SETS, COMPONENTS, COMPONENT_SELECTORS, KINDS, REST_SELECTORS, ROOF_VALUES,
    SHAPE_SELECTORS,
};
use super::{Words, NONE};

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Operation {
    pub name: &'static str,
    /// The numbers of arguments with which it can be called.
    pub counts: &'static [u8],
    /// For each argument the words that it may be.
    pub words: &'static [Words],
    pub block: BlockKind,
}

/// What follows the arguments.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum BlockKind {
    None,
    /// `{ size : operations | … }`
    Sizes,
    /// `{ selector : operations | … }`; `rest` are words that do not compete with the others.
    Selectors {
        words: Words,
        rest: Words,
    },
    /// `{ length : depth : operations | … } { remainder : operations }`
    Depths,
    /// `{ operations }`
    Operations,
    /// `{ operations }`, or one rule or operation.
    Operand,
}

const COMPONENT_CELLS: BlockKind = BlockKind::Selectors {
    words: COMPONENT_SELECTORS,
    rest: NONE,
};
const SETBACK_CELLS: BlockKind = BlockKind::Selectors {
    words: COMPONENT_SELECTORS,
    rest: REST_SELECTORS,
};
const SHAPE_CELLS: BlockKind = BlockKind::Selectors {
    words: SHAPE_SELECTORS,
    rest: NONE,
};

const UP: Words = &["yUp", "zUp"];
const SPLIT_AXES: Words = &["x", "y", "z", "u", "v"];
const SPLIT_MODES: Words = &["adjust", "noAdjust", "uvSpace", "unitSpace"];
const ALIGN: Words = &["align", "noAlign"];
const MODES: Words = &["abs", "rel"];
const SYSTEMS: Words = &["scope", "pivot", "object", "world"];
const SWAP: Words = &["swap", "noSwap"];
const MERGE: Words = &["append", "unify", "recompose"];
const CENTERS: Words = &["scopeOrigin", "scopeCenter"];
const EXTRUSIONS: Words = &[
    "world.up",
    "world.up.flatTop",
    "face.normal",
    "vertex.normal",
    "x",
    "y",
    "z",
    "world.x",
    "world.y",
    "world.z",
];
const FACES_OF_SCOPE: Words = &["center", "front", "back", "left", "right", "top", "bottom"];
const INSERT: Words = &[
    "alignSizeAndPosition",
    "keepSizeAndPosition",
    "keepSizeAlignPosition",
];
const PROJECTIONS: Words = &[
    "scope.xy", "scope.xz", "scope.yx", "scope.yz", "scope.zx", "scope.zy", "world.xy", "world.xz",
    "world.yx", "world.yz", "world.zx", "world.zy",
];
const ALIGN_AXES: Words = &[
    "x",
    "y",
    "z",
    "xyz",
    "world.x",
    "world.y",
    "world.z",
    "world.xyz",
    "object.x",
    "object.y",
    "object.z",
    "object.xyz",
];

const fn op(
    name: &'static str,
    counts: &'static [u8],
    words: &'static [Words],
    block: BlockKind,
) -> Operation {
    Operation {
        name,
        counts,
        words,
        block,
    }
}

/// An operation that takes values and words, and no block.
const fn plain(name: &'static str, counts: &'static [u8], words: &'static [Words]) -> Operation {
    op(name, counts, words, BlockKind::None)
}

#[rustfmt::skip]
pub const OPERATIONS: &[Operation] = &[
    // Geometry creation
    plain("i", &[1, 2, 3, 4], &[NONE, UP, INSERT, &["numericalCleanup", "noCleanup"]]),
    plain("extrude", &[1, 2], &[EXTRUSIONS]),
    plain("envelope", &[4, 6, 8, 10], &[&["normal", "world.up"]]),
    plain("taper", &[1], &[]),
    plain("roofGable", &[1, 2, 3, 4, 5, 6], &[ROOF_VALUES]),
    plain("roofHip", &[1, 2, 3, 4], &[ROOF_VALUES]),
    plain("roofPyramid", &[1, 2, 3], &[ROOF_VALUES]),
    plain("roofRidge", &[2, 3], &[ROOF_VALUES]),
    plain("roofShed", &[1, 2, 3, 4], &[ROOF_VALUES]),
    // Roofs of Veduta's own
    plain("roofButterfly", &[1, 2, 3, 4], &[ROOF_VALUES]),
    plain("roofCrossGable", &[1, 2, 3, 4], &[ROOF_VALUES]),
    plain("roofDome", &[1, 2, 3], &[]),
    plain("roofDutch", &[2, 3, 4], &[ROOF_VALUES]),
    plain("roofFlat", &[2, 3, 4], &[]),
    plain("roofGambrel", &[3, 4, 5], &[]),
    plain("roofHalfHip", &[2, 3, 4, 5], &[ROOF_VALUES]),
    plain("roofMansard", &[3, 4], &[]),
    plain("roofOnion", &[1, 2, 3], &[]),
    plain("roofPerEdge", &[1, 2, 3], &[]),
    plain("roofSaltbox", &[2, 3, 4, 5], &[]),
    plain("roofSawtooth", &[2, 3, 4, 5], &[ROOF_VALUES]),
    plain("roofSkillion", &[1, 2, 3, 4], &[ROOF_VALUES]),
    plain("roofVault", &[1, 2, 3, 4], &[]),
    op("innerRectangle", &[1], &[&["scope", "edge"]], SHAPE_CELLS),
    plain("innerRect", &[0], &[]), // the older form of innerRectangle
    plain("primitiveQuad", &[0, 2], &[]),
    plain("primitiveDisk", &[0, 1, 2], &[]),
    plain("primitiveCube", &[0, 3], &[]),
    plain("primitiveSphere", &[0, 2, 3], &[]),
    plain("primitiveCylinder", &[0, 1, 3], &[]),
    plain("primitiveCone", &[0, 1, 3], &[]),
    plain("insertAlongUV", &[3, 5], &[NONE, NONE, NONE, &["scope.y", "vertex.normal"], &["alignPosition", "keepPosition"]]),
    plain("footprint", &[0], &[]),
    // Geometry subdivision
    op("split", &[1, 2, 3], &[SPLIT_AXES, SPLIT_MODES], BlockKind::Sizes),
    op("splitArea", &[1, 2], &[AXES, ADJUST], BlockKind::Sizes),
    op("splitAndSetbackPerimeter", &[1, 3], &[], BlockKind::Depths),
    op("comp", &[1, 2], &[COMPONENTS, ALIGN], COMPONENT_CELLS),
    op("modify", &[1, 2], &[COMPONENTS, ALIGN], COMPONENT_CELLS),
    plain("offset", &[1, 2], &[NONE, &["all", "inside", "border"]]),
    op("setback", &[1, 2], &[], SETBACK_CELLS),
    op("setbackPerEdge", &[1, 2], &[], SETBACK_CELLS),
    op("setbackToArea", &[1, 2, 3, 4], &[], SETBACK_CELLS),
    op("shapeL", &[2], &[], SHAPE_CELLS),
    op("shapeU", &[3], &[], SHAPE_CELLS),
    op("shapeO", &[4], &[], SHAPE_CELLS),
    op("scatter", &[3, 4, 5], &[&["surface", "volume", "scope"], NONE, &["uniform", "gaussian"], FACES_OF_SCOPE], BlockKind::Operations),
    // Geometry manipulation
    plain("cleanupGeometry", &[2], &[KINDS]),
    plain("convexify", &[0, 1], &[]),
    plain("deleteHoles", &[0], &[]),
    plain("reverseNormals", &[0], &[]),
    plain("setNormals", &[1], &[&["hard", "conform", "soft", "auto"]]),
    plain("softenNormals", &[1], &[]),
    plain("mirror", &[3], &[]),
    plain("rectify", &[1], &[]),
    plain("reduceGeometry", &[1], &[]),
    plain("resetGeometry", &[0], &[]),
    plain("trim", &[0], &[]),
    // Tags
    plain("tag", &[1, 2], &[NONE, KINDS]),
    plain("deleteTags", &[0, 1, 2], &[NONE, KINDS]),
    plain("setTagsFromEdgeAttrs", &[0], &[]),
    // Inlining and Boolean operations
    op("inline", &[0, 1], &[MERGE], BlockKind::Operand),
    op("union", &[0, 1], &[SWAP], BlockKind::Operand),
    op("subtract", &[0, 1], &[SWAP], BlockKind::Operand),
    op("intersect", &[0, 1], &[SWAP], BlockKind::Operand),
    // Texturing
    plain("texture", &[1], &[]),
    plain("setupProjection", &[4, 5, 6, 7], &[NONE, PROJECTIONS]),
    plain("projectUV", &[1], &[]),
    plain("translateUV", &[3], &[]),
    plain("offsetUV", &[3], &[]), // the older name of translateUV
    plain("scaleUV", &[3], &[]),
    plain("normalizeUV", &[3], &[NONE, &["uv", "uvUniform", "u", "v"], &["separatePerFace", "collectiveAllFaces"]]),
    plain("tileUV", &[3], &[]),
    plain("rotateUV", &[2], &[]),
    plain("deleteUV", &[1], &[]),
    plain("copyUV", &[2], &[]),
    plain("bakeUV", &[1], &[]),
    // Transformations
    plain("t", &[3], &[]),
    plain("translate", &[5], &[MODES, SYSTEMS]),
    plain("s", &[3], &[]),
    plain("r", &[3, 4], &[CENTERS]),
    plain("rotate", &[5], &[MODES, SYSTEMS]),
    plain("center", &[1], &[AXIS_SETS]),
    // Scope
    plain("alignScopeToAxes", &[0, 1], &[ALIGN_AXES]),
    plain("alignScopeToGeometry", &[2, 3], &[UP, &["world.lowest", "largest", "any", "auto"], &["world.lowest", "longest", "auto"]]),
    plain("alignScopeToGeometryBBox", &[1], &[&["xy", "yx", "xz", "zx", "yz", "zy"]]),
    plain("rotateScope", &[3], &[]),
    plain("setPivot", &[2], &[&["xyz", "yzx", "zxy"]]),
    plain("mirrorScope", &[3], &[]),
    // Flow, context, attributes
    plain("NIL", &[0], &[]),
    plain("label", &[1], &[]),
    plain("snap", &[2, 3], &[AXIS_SETS]),
    plain("set", &[2], &[]),
    plain("color", &[1, 3, 4], &[]),
    plain("setMaterial", &[1], &[]),
    plain("resetMaterial", &[0, 1], &[&["shape", "geometry", "all"]]),
    plain("report", &[2], &[]),
    plain("print", &[1], &[]),
];

/// The operation with a name.
pub fn find(name: &str) -> Option<(usize, &'static Operation)> {
    let found = OPERATIONS.iter().enumerate();
    found
        .into_iter()
        .find(|(_, operation)| operation.name == name)
}
