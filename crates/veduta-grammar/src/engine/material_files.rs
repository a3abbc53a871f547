//! Materials from files: Wavefront MTL to the properties of materials.

use std::sync::Arc;

use super::value::{Array, Value};

/// The statements of one number or text, with the properties that they say.
const PLAIN: &[(&str, &str)] = &[
    ("Ns", "shininess"),
    ("d", "opacity"),
    ("Pr", "roughness"),
    ("Pm", "metallic"),
];
const COLOURS: &[(&str, &str)] = &[
    ("Kd", "color"),
    ("Ka", "ambient"),
    ("Ks", "specular"),
    ("Ke", "emissive"),
];
/// By their names in small letters: writers differ.
const MAPS: &[(&str, &str)] = &[
    ("map_kd", "colormap"),
    ("map_ks", "specularmap"),
    ("map_ke", "emissivemap"),
    ("map_d", "opacitymap"),
    ("map_bump", "bumpmap"),
    ("bump", "bumpmap"),
    ("norm", "normalmap"),
    ("map_pr", "roughnessmap"),
    ("map_pm", "metallicmap"),
];

/// The first material of an MTL file: rows of name and value, as `setMaterial` takes them; none
/// where nothing is known. `folder`: of the file, up to its last slash, where its pictures lie.
pub fn properties(text: &str, folder: &str) -> Value {
    let mut rows: Vec<[String; 2]> = Vec::new();
    let mut named = false;
    for line in text.lines() {
        let line = line.split('#').next().unwrap_or("").trim();
        let (word, rest) = line
            .split_once(char::is_whitespace)
            .map_or((line, ""), |(word, rest)| (word, rest.trim()));
        if word == "newmtl" {
            if named {
                break;
            }
            named = true;
            rows.push(["name".into(), rest.into()]);
            continue;
        }
        rows.extend(statement(word, rest, folder));
    }
    rows.sort();
    rows.dedup_by(|later, first| later[0] == first[0]);
    let values = rows.iter().flatten().map(|text| Value::text(text));
    Value::Array(Arc::new(Array::new(2, values.collect())))
}

fn statement(word: &str, rest: &str, folder: &str) -> Vec<[String; 2]> {
    let known = |table: &[(&str, &'static str)], word: &str| {
        let found = table.iter().find(|(own, _)| *own == word);
        found.map(|(_, name)| *name)
    };
    let numbers: Vec<f64> = rest
        .split_whitespace()
        .map_while(|one| one.parse().ok())
        .collect();
    if let (Some(name), Some(number)) = (known(PLAIN, word), numbers.first()) {
        return vec![[name.into(), number.to_string()]];
    }
    if let ("Tr", Some(number)) = (word, numbers.first()) {
        return vec![["opacity".into(), (1.0 - number).to_string()]];
    }
    if let (Some(name), Some(red)) = (known(COLOURS, word), numbers.first()) {
        let part = |at: usize| numbers.get(at).unwrap_or(red).clamp(0.0, 1.0).to_string();
        let rows = ["r", "g", "b"].into_iter().enumerate();
        return rows
            .map(|(at, letter)| [format!("{name}.{letter}"), part(at)])
            .collect();
    }
    // Options stand before the name of the picture, each with a minus.
    let Some(name) = known(MAPS, &word.to_ascii_lowercase()) else {
        return Vec::new();
    };
    let picture = match rest.starts_with('-') {
        true => rest.split_whitespace().last().unwrap_or(""),
        false => rest,
    };
    match picture {
        "" => Vec::new(),
        path => vec![[name.into(), format!("{folder}{}", path.replace('\\', "/"))]],
    }
}
