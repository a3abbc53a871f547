//! All that CityEngine's reference lists: each derives, or the language's page says what is built
//! instead.

use std::collections::BTreeSet;

use veduta_grammar::builtins::{attributes, functions, operations};
use veduta_grammar::engine::{attribute_names, function_names, operation_names};

/// Operations, by the sections of the reference of 2025.1; `pop` and `push` are brackets.
const OPERATIONS: &str = "
    i extrude envelope taper roofGable roofHip roofPyramid roofRidge roofShed offset primitiveQuad
    primitiveDisk primitiveCube primitiveSphere primitiveCylinder primitiveCone insertAlongUV footprint
    split splitArea splitAndSetbackPerimeter comp innerRectangle setback setbackPerEdge setbackToArea
    shapeL shapeU shapeO scatter
    cleanupGeometry convexify deleteHoles reverseNormals setNormals softenNormals mirror rectify
    reduceGeometry resetGeometry trim modify
    tag deleteTags setTagsFromEdgeAttrs
    inline union subtract intersect
    texture setupProjection projectUV translateUV scaleUV normalizeUV tileUV rotateUV deleteUV copyUV
    t translate s r rotate center
    alignScopeToAxes alignScopeToGeometry alignScopeToGeometryBBox rotateScope setPivot mirrorScope
    NIL label set color resetMaterial setMaterial report print
    innerRect offsetUV";

/// Functions, those of the utility library among them.
const FUNCTIONS: &str = "
    abs acos asin atan atan2 ceil cos exp floor isinf isnan ln log10 pow rint sin sqrt tan
    p rand
    bool boolArray float floatArray isNull sel str stringArray
    count find len splitString substring
    geometry.angle geometry.area geometry.boundaryLength geometry.du geometry.dv geometry.groups
    geometry.hasTags geometry.hasUVs geometry.height geometry.isClosedSurface geometry.isConcave
    geometry.isInstanced geometry.isOriented geometry.isPlanar geometry.isRectangular
    geometry.materials geometry.nEdges geometry.nFaces geometry.nHoles geometry.nVertices geometry.tags
    geometry.uMin geometry.uMax geometry.vMin geometry.vMax geometry.volume isTagged
    getMaterial readMaterial
    fileExists fileSearch filesSearch readFloatTable readStringTable readTextFile
    assetInfo assetMetadata assetNamingInfo assetNamingInfos assetsSortRatio assetsSortSize imageInfo
    imagesSortRatio
    inside overlaps touches contextCompare contextCount minimumDistance
    comp findFirst nColumns nRows setElems size sortIndices sortRowIndices sum transpose
    edgeAttr.getBool edgeAttr.getFloat edgeAttr.getString
    convert getGeoCoord getTreeKey print
    findLast getPrefix getRange getSuffix replace
    listAdd listClean listCount listFirst listFromArray listIndex listItem listLast listRandom
    listRange listRemove listRemoveAll listRetainAll listSize listTerminate listToArray
    fileBasename fileDirectory fileExtension fileName fileRandom
    assetApproxRatio assetApproxSize assetBestRatio assetBestSize assetFitSize imageApproxRatio
    imageBestRatio
    clamp max min
    colorHexToB colorHexToG colorHexToH colorHexToO colorHexToR colorHexToS colorHexToV colorHSVToHex
    colorHSVOToHex colorRamp colorRGBToHex colorRGBOToHex";

const ATTRIBUTES: &str = "
    comp.index comp.sel comp.total split.index split.total
    initialShape.name initialShape.origin.ox initialShape.origin.px initialShape.startRule
    pivot.ox pivot.px scope.elevation scope.rx scope.sx scope.tx seedian trim.horizontal trim.vertical
    material.ambient.r material.bumpValue material.bumpmap material.color.r material.color.rgb
    material.colormap material.colormap.rw material.colormap.su material.colormap.tv material.dirtmap
    material.emissive.r material.emissivemap material.metallic material.metallicmap material.name
    material.normalmap material.occlusionmap material.opacity material.opacitymap
    material.opacitymap.cutoff material.opacitymap.mode material.reflectivity material.roughness
    material.roughnessmap material.shader material.shininess material.specular.r material.specularmap";

/// These derive otherwise than the reference has it: the page says how.
const OTHERWISE: &[&str] = &["setNormals", "softenNormals", "reduceGeometry"];

fn listed(text: &str) -> impl Iterator<Item = &str> {
    text.split_whitespace()
}

#[test]
fn what_the_reference_lists_derives_or_is_named() {
    let page = include_str!("../../../docs/grammar-language.md");
    let own = include_str!("../../../docs/operations/index.md");
    let known: BTreeSet<String> = attribute_names().map(String::from).collect();
    let (functions_now, operations_now): (BTreeSet<&str>, BTreeSet<&str>) =
        (function_names().collect(), operation_names().collect());
    let of_operations = listed(OPERATIONS).filter(|name| !operations_now.contains(name));
    let of_functions = listed(FUNCTIONS).filter(|name| !functions_now.contains(name));
    let of_attributes = listed(ATTRIBUTES).filter(|name| !known.contains(*name));
    let missing: Vec<&str> = of_operations
        .chain(of_functions)
        .chain(of_attributes)
        .collect();
    assert_eq!(missing, OTHERWISE);
    for name in missing {
        let named = format!("`{name}`");
        assert!(
            page.contains(&named) && own.contains(&named),
            "{name} is not named"
        );
    }
}

#[test]
fn what_the_reference_lists_is_checked() {
    let operations: BTreeSet<&str> = operations::OPERATIONS.iter().map(|one| one.name).collect();
    for name in listed(OPERATIONS) {
        assert!(operations.contains(name), "{name}");
    }
    for name in listed(FUNCTIONS).filter(|name| *name != "comp") {
        assert!(functions::find(name).is_some(), "{name}");
    }
    for name in listed(ATTRIBUTES) {
        assert!(attributes::is_attribute(name), "{name}");
    }
}
