//! The functions: how many arguments they take, and which words these may be.

use super::words::{AXIS_SETS, COMPONENTS, FACE_SELECTORS, KINDS, SPACES};
use super::{Words, ANY, NONE};

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Function {
    pub name: &'static str,
    pub least: u8,
    pub most: u8,
    /// For each argument the words that it may be.
    pub words: &'static [Words],
}

const fn takes(name: &'static str, least: u8, most: u8, words: &'static [Words]) -> Function {
    Function {
        name,
        least,
        most,
        words,
    }
}

/// A function of `count` values.
const fn of(name: &'static str, count: u8) -> Function {
    takes(name, count, count, &[])
}

const TARGETS: Words = &["intra", "inter", "all"];
const MATERIALS: &[Words] = &[&["used", "shape", "geometry"], &["changed", "all"]];
const OCCLUSION: &[Words] = &[TARGETS];
const RANKS: &[Words] = &[
    TARGETS,
    NONE,
    &[
        "world.northernmost",
        "world.southernmost",
        "world.easternmost",
        "world.westernmost",
        "world.highest",
        "world.lowest",
        "area.largest",
        "area.smallest",
    ],
];
const COORDINATE: &[Words] = &[
    &["x", "y", "z", "scope", "pivot", "object", "world"],
    SPACES,
    &["scope", "pivot", "object", "world", "pos", "orient"],
    &["pos", "orient"],
];
const SPACE_OF_UV: &[Words] = &[NONE, &["uvSpace", "unitSpace"]];
const GEOGRAPHIC: Words = &["x", "y", "X", "Y", "lon", "lat"];
const ASSET_SIZES: &[Words] = &[NONE, &["sx", "sy", "sz", "tx", "ty", "tz"]];
const PARTS: &[Words] = &[NONE, &["g", "m"]];
const AXES_OF_SCOPE: &[Words] = &[NONE, AXIS_SETS];
const RATIOS: &[Words] = &[NONE, ANY];
const SUBCOMPONENTS: &[Words] = &[NONE, &["e", "v"]];

#[rustfmt::skip]
pub const FUNCTIONS: &[Function] = &[
    // Mathematics
    of("abs", 1), of("acos", 1), of("asin", 1), of("atan", 1), of("atan2", 2), of("ceil", 1),
    of("cos", 1), of("exp", 1), of("floor", 1), of("isinf", 1), of("isnan", 1), of("ln", 1),
    of("log10", 1), of("pow", 2), of("rint", 1), of("sin", 1), of("sqrt", 1), of("tan", 1),
    of("clamp", 3), of("max", 2), of("min", 2),
    // Chance
    of("p", 1), takes("rand", 0, 2, &[]),
    // Conversion
    of("bool", 1), of("float", 1), of("str", 1), of("sel", 1), of("isNull", 1),
    takes("boolArray", 0, 1, &[]), takes("floatArray", 0, 1, &[]), takes("stringArray", 0, 1, &[]),
    // Strings
    of("count", 2), of("find", 3), of("len", 1), of("splitString", 2), of("substring", 3),
    of("findLast", 2), of("getPrefix", 2), of("getRange", 3), of("getSuffix", 2), of("replace", 3),
    // Lists in strings
    of("listAdd", 2), of("listClean", 1), of("listCount", 2), of("listFirst", 1),
    of("listFromArray", 1), of("listIndex", 2), of("listItem", 2), of("listLast", 1),
    of("listRandom", 1), of("listRange", 3), of("listRemove", 2), of("listRemoveAll", 2),
    of("listRetainAll", 2), of("listSize", 1), of("listTerminate", 1), of("listToArray", 1),
    // Geometry
    takes("geometry.angle", 1, 1, &[&["maxSlope", "azimuth", "zenith"]]),
    takes("geometry.area", 0, 1, &[FACE_SELECTORS]),
    of("geometry.boundaryLength", 0),
    takes("geometry.du", 2, 2, SPACE_OF_UV), takes("geometry.dv", 2, 2, SPACE_OF_UV),
    of("geometry.groups", 0), of("geometry.height", 0),
    takes("geometry.hasTags", 1, 2, &[NONE, KINDS]),
    takes("geometry.hasUVs", 0, 1, &[]),
    of("geometry.isClosedSurface", 0), of("geometry.isConcave", 0), of("geometry.isInstanced", 0),
    takes("geometry.isOriented", 1, 1, &[FACE_SELECTORS]),
    of("geometry.isPlanar", 1), of("geometry.isRectangular", 1),
    of("geometry.materials", 0), of("geometry.nEdges", 0), of("geometry.nFaces", 0),
    of("geometry.nHoles", 0), of("geometry.nVertices", 0),
    takes("geometry.tags", 0, 2, &[ANY, ANY]),
    takes("geometry.uMin", 0, 1, &[]), takes("geometry.uMax", 0, 1, &[]),
    takes("geometry.vMin", 0, 1, &[]), takes("geometry.vMax", 0, 1, &[]),
    of("geometry.volume", 0),
    takes("isTagged", 1, 2, SUBCOMPONENTS),
    // Material
    takes("getMaterial", 2, 2, MATERIALS), of("readMaterial", 1),
    // Files
    of("fileExists", 1), of("fileSearch", 1), of("filesSearch", 1), of("readTextFile", 1),
    of("readFloatTable", 1), of("readStringTable", 1),
    of("fileBasename", 1), of("fileDirectory", 1), of("fileExtension", 1), of("fileName", 1),
    of("fileRandom", 1),
    // Assets and images
    takes("assetInfo", 2, 2, ASSET_SIZES), takes("imageInfo", 2, 2, RATIOS),
    of("assetMetadata", 3),
    takes("assetNamingInfo", 2, 2, PARTS), takes("assetNamingInfos", 2, 2, PARTS),
    takes("assetsSortRatio", 2, 3, RATIOS), takes("assetsSortSize", 3, 3, AXES_OF_SCOPE),
    takes("imagesSortRatio", 2, 3, RATIOS),
    of("assetApproxRatio", 3), of("assetApproxSize", 3), of("assetBestRatio", 2),
    of("assetBestSize", 2), of("assetFitSize", 3), of("imageApproxRatio", 3),
    of("imageBestRatio", 2),
    // Occlusion and context
    takes("inside", 0, 2, OCCLUSION), takes("overlaps", 0, 2, OCCLUSION),
    takes("touches", 0, 2, OCCLUSION),
    takes("minimumDistance", 2, 2, OCCLUSION), takes("contextCompare", 3, 3, RANKS),
    takes("contextCount", 2, 2, OCCLUSION),
    // Arrays
    takes("comp", 1, 2, &[COMPONENTS, &["align", "noAlign"]]), takes("findFirst", 2, 3, &[]),
    of("nColumns", 1), of("nRows", 1), takes("setElems", 3, 4, &[]), of("size", 1),
    of("sortIndices", 1), takes("sortRowIndices", 1, 2, &[]), of("sum", 1),
    of("transpose", 1),
    // Attributes of edges
    of("edgeAttr.getFloat", 1), of("edgeAttr.getString", 1),
    of("edgeAttr.getBool", 1),
    // Colours
    of("colorHexToR", 1), of("colorHexToG", 1), of("colorHexToB", 1), of("colorHexToO", 1),
    of("colorHexToH", 1), of("colorHexToS", 1), of("colorHexToV", 1), of("colorHSVToHex", 3),
    of("colorHSVOToHex", 4), of("colorRGBToHex", 3), of("colorRGBOToHex", 4), of("colorRamp", 2),
    // Others
    takes("convert", 4, 7, COORDINATE), takes("getGeoCoord", 1, 1, &[GEOGRAPHIC]),
    of("getTreeKey", 0), of("print", 1),
];

/// The function with a name.
pub fn find(name: &str) -> Option<(usize, &'static Function)> {
    let found = FUNCTIONS.iter().enumerate();
    found
        .into_iter()
        .find(|(_, function)| function.name == name)
}
