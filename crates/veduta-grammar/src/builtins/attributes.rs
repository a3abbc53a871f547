//! The attributes of the current shape, such as `scope.sx`.

/// Attributes without parts. The texture layers come in addition.
#[rustfmt::skip]
const PLAIN: &[&str] = &[
    "comp.sel", "comp.index", "comp.total",
    "split.index", "split.total",
    "scope.sx", "scope.sy", "scope.sz", "scope.tx", "scope.ty", "scope.tz",
    "scope.rx", "scope.ry", "scope.rz", "scope.elevation",
    "pivot.px", "pivot.py", "pivot.pz", "pivot.ox", "pivot.oy", "pivot.oz",
    "initialShape.name", "initialShape.startRule",
    "initialShape.origin.px", "initialShape.origin.py", "initialShape.origin.pz",
    "initialShape.origin.ox", "initialShape.origin.oy", "initialShape.origin.oz",
    "seedian", "uid", "trim.horizontal", "trim.vertical",
    "material.name", "material.shader", "material.opacity", "material.shininess",
    "material.reflectivity", "material.bumpValue", "material.metallic", "material.roughness",
    "material.color.r", "material.color.g", "material.color.b",
    "material.color.a", "material.color.rgb",
    "material.ambient.r", "material.ambient.g", "material.ambient.b",
    "material.specular.r", "material.specular.g", "material.specular.b",
    "material.emissive.r", "material.emissive.g", "material.emissive.b",
    "material.opacitymap.mode", "material.opacitymap.cutoff",
];

/// Texture layers, in the order of their uv sets. Each is an attribute, with [`LAYER_PARTS`].
#[rustfmt::skip]
pub const LAYERS: &[&str] = &[
    "material.colormap", "material.bumpmap", "material.dirtmap", "material.specularmap",
    "material.opacitymap", "material.normalmap", "material.emissivemap", "material.occlusionmap",
    "material.roughnessmap", "material.metallicmap",
];
pub const LAYER_PARTS: &[&str] = &["su", "sv", "tu", "tv", "rw"];

/// Whether a name is an attribute of the current shape.
pub fn is_attribute(name: &str) -> bool {
    if PLAIN.contains(&name) {
        return true;
    }
    LAYERS.iter().any(|layer| match name.strip_prefix(layer) {
        Some("") => true,
        Some(part) => part
            .strip_prefix('.')
            .is_some_and(|part| LAYER_PARTS.contains(&part)),
        None => false,
    })
}

/// What dotted names begin with that tell of the current shape. Some files name one that no reference
/// has: of an older CityEngine, or never heard of.
const SPACES: &[&str] = &[
    "comp",
    "edgeAttr",
    "geometry",
    "initialShape",
    "material",
    "pivot",
    "scope",
    "split",
    "trim",
];

/// Whether a name would tell of the current shape, known or not.
pub fn tells_of_shape(name: &str) -> bool {
    let space = name.split_once('.').map(|(space, _)| space);
    space.is_some_and(|space| SPACES.contains(&space))
}

/// Whether `set` may change an attribute of the current shape.
pub fn is_settable(name: &str) -> bool {
    let read_only = [
        "comp.",
        "split.",
        "initialShape.",
        "scope.elevation",
        "pivot.",
        "uid",
    ];
    !read_only.iter().any(|start| name.starts_with(start))
}

/// All names of attributes.
pub fn names() -> impl Iterator<Item = String> {
    let parts = LAYERS.iter().flat_map(|layer| {
        let parts = LAYER_PARTS.iter();
        parts.map(move |part| format!("{layer}.{part}"))
    });
    let layers = PLAIN.iter().chain(LAYERS).map(ToString::to_string);
    layers.chain(parts)
}
