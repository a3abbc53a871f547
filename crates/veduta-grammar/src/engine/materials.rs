//! The properties of a material by their names.

use std::collections::HashMap;
use std::sync::Arc;

use crate::suggest::{closest, did_you_mean};

use super::colours::parsed;
use super::state::Look;
use super::value::Value;

/// What every name in rule files begins with.
pub const PREFIX: &str = "material.";
/// What names of built-in textures begin with.
const BUILT_IN: &str = "builtin/textures/";

/// Textures of known sizes (m).
pub type Tiles = HashMap<Arc<str>, [f64; 2]>;

/// Properties that shapes keep and rules can read, and that models do not show: their full names,
/// and what they are at first, a number or a text.
const KEPT: &[(&str, Result<f64, &str>)] = &[
    ("material.shader", Err("CityEngineShader")),
    ("material.shininess", Ok(1.0)),
    ("material.reflectivity", Ok(0.0)),
    ("material.bumpValue", Ok(1.0)),
    ("material.metallic", Ok(0.0)),
    ("material.roughness", Ok(1.0)),
    ("material.ambient.r", Ok(0.0)),
    ("material.ambient.g", Ok(0.0)),
    ("material.ambient.b", Ok(0.0)),
    ("material.specular.r", Ok(0.0)),
    ("material.specular.g", Ok(0.0)),
    ("material.specular.b", Ok(0.0)),
    ("material.emissive.r", Ok(0.0)),
    ("material.emissive.g", Ok(0.0)),
    ("material.emissive.b", Ok(0.0)),
    ("material.opacitymap.mode", Err("blend")),
    ("material.opacitymap.cutoff", Ok(0.5)),
    ("material.bumpmap", Err("")),
    ("material.dirtmap", Err("")),
    ("material.specularmap", Err("")),
    ("material.opacitymap", Err("")),
    ("material.normalmap", Err("")),
    ("material.emissivemap", Err("")),
    ("material.occlusionmap", Err("")),
    ("material.roughnessmap", Err("")),
    ("material.metallicmap", Err("")),
];

/// The settings of each texture layer, with what they are at first.
macro_rules! settings {
    ($($layer:literal),*) => {
        &[$(
            (concat!("material.", $layer, ".su"), Ok(1.0)),
            (concat!("material.", $layer, ".sv"), Ok(1.0)),
            (concat!("material.", $layer, ".tu"), Ok(0.0)),
            (concat!("material.", $layer, ".tv"), Ok(0.0)),
            (concat!("material.", $layer, ".rw"), Ok(0.0)),
        )*]
    };
}

/// How the layers of textures are scaled, moved and turned: kept as the others, and not shown.
const LAID: &[(&str, Result<f64, &str>)] = settings![
    "colormap",
    "bumpmap",
    "dirtmap",
    "specularmap",
    "opacitymap",
    "normalmap",
    "emissivemap",
    "occlusionmap",
    "roughnessmap",
    "metallicmap"
];

/// A property that is kept, by its full name.
fn kept(name: &str) -> Option<&'static (&'static str, Result<f64, &'static str>)> {
    KEPT.iter().chain(LAID).find(|entry| entry.0 == name)
}

/// Properties that models show.
const SHOWN: &[&str] = &[
    "material.name",
    "material.color.r",
    "material.color.g",
    "material.color.b",
    "material.opacity",
    "material.colormap",
];
const COLOUR: &str = "material.color.rgb";
/// An older name of the opacity.
const ALPHA: &str = "material.color.a";

/// The names of all properties.
pub fn names() -> impl Iterator<Item = &'static str> {
    single_names().chain([ALPHA, COLOUR])
}

/// The names of all properties but those that are others too.
fn single_names() -> impl Iterator<Item = &'static str> {
    let kept = KEPT.iter().chain(LAID).map(|entry| entry.0);
    SHOWN.iter().copied().chain(kept)
}

/// A property by its full name; None of an unknown one.
pub fn get(look: &Look, name: &str) -> Option<Value> {
    Some(match name {
        "material.name" => Value::Text(look.class.clone()),
        "material.color.r" => Value::Number(f64::from(look.colour[0])),
        "material.color.g" => Value::Number(f64::from(look.colour[1])),
        "material.color.b" => Value::Number(f64::from(look.colour[2])),
        COLOUR => {
            let [r, g, b] = look.colour.map(|c| (c * 255.0).round() as u8);
            Value::text(&format!("#{r:02x}{g:02x}{b:02x}"))
        }
        ALPHA | "material.opacity" => Value::Number(f64::from(look.opacity)),
        "material.colormap" => match &look.texture {
            Some(path) => Value::Text(path.clone()),
            None => Value::text(""),
        },
        _ => {
            let (name, first) = kept(name)?;
            match (look.kept.get(name), first) {
                (Some(value), _) => value.clone(),
                (None, Ok(number)) => Value::Number(*number),
                (None, Err(text)) => Value::text(text),
            }
        }
    })
}

/// The size of a texture, where it is known; Err where a built-in one is named that is not there.
pub fn tile_of(known: &Tiles, path: &str) -> Result<Option<[f64; 2]>, String> {
    let found = known.get(path).copied();
    if found.is_some() || known.is_empty() || !path.starts_with(BUILT_IN) {
        return Ok(found);
    }
    let near = closest(path, known.keys().map(AsRef::as_ref));
    let hint = did_you_mean(near).map_or_else(String::new, |hint| format!(": {hint}"));
    Err(format!("`{path}` is no texture that is built in{hint}"))
}

/// Changes a property; Err says why it cannot be.
pub fn set(look: &mut Look, name: &str, value: &Value, tiles: &Tiles) -> Result<(), String> {
    let share = || {
        let number = value.number().filter(|number| !number.is_nan());
        let clamped = number.map(|number| number.clamp(0.0, 1.0) as f32);
        clamped.ok_or_else(|| format!("`{name}` is a number from 0 to 1, not `{value}`"))
    };
    match name {
        "material.name" => look.class = value.to_string().into(),
        "material.color.r" => look.colour[0] = share()?,
        "material.color.g" => look.colour[1] = share()?,
        "material.color.b" => look.colour[2] = share()?,
        COLOUR => {
            let text = value.to_string();
            let (colour, _) =
                parsed(&text).ok_or_else(|| format!("`{text}` is no colour: #rrggbb"))?;
            look.colour = colour;
        }
        ALPHA | "material.opacity" => look.opacity = share()?,
        "material.colormap" => {
            let path = value.to_string();
            look.tile = tile_of(tiles, &path)?;
            look.texture = (!path.is_empty()).then(|| path.into());
        }
        _ => {
            let known = kept(name);
            let (name, first) = known.ok_or_else(|| {
                format!("`{name}` is neither an attribute nor a property of materials")
            })?;
            let value = match (first, value.number()) {
                (Ok(_), Some(number)) => Value::Number(number),
                (Ok(_), None) => return Err(format!("`{name}` is a number, not `{value}`")),
                (Err(_), _) => Value::text(&value.to_string()),
            };
            look.kept.insert(name, value);
        }
    }
    Ok(())
}

/// All properties but those that are as at first, or with these too, as pairs of texts: names
/// without the prefix, and values.
pub fn pairs(look: &Look, with_all: bool) -> Vec<[String; 2]> {
    let first = Look::default();
    single_names()
        .filter_map(|name| {
            let value = get(look, name)?;
            let is_changed = get(&first, name).as_ref() != Some(&value);
            let name = name.strip_prefix(PREFIX).unwrap_or(name);
            (with_all || is_changed).then(|| [name.to_string(), value.to_string()])
        })
        .collect()
}
