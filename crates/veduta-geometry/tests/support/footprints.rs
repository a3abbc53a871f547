//! The outlines of real buildings that other roof software fails on.

use std::path::{Path, PathBuf};

/// Name, and rings without the closing point (m).
pub type Footprint = (String, Vec<Vec<[f64; 2]>>);

/// Reads `footprints/hard-footprints.geojson` from `$VEDUTA_DATA`, else from `../shared/data`
/// beside the checkout. Nothing, and a line that says so, where there is none.
pub fn hard_footprints() -> Option<Vec<Footprint>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let data = std::env::var_os("VEDUTA_DATA").map_or(root.join("../shared/data"), PathBuf::from);
    let path = data.join("footprints/hard-footprints.geojson");
    let Ok(text) = std::fs::read_to_string(&path) else {
        eprintln!("skipped: there is no {}", path.display());
        return None;
    };
    let document: serde_json::Value = serde_json::from_str(&text).expect("GeoJSON");
    let features = document["features"].as_array().expect("features");
    Some(features.iter().map(footprint).collect())
}

fn footprint(feature: &serde_json::Value) -> Footprint {
    let name = feature["properties"]["name"].as_str().expect("a name");
    let rings = feature["geometry"]["coordinates"]
        .as_array()
        .expect("rings");
    let number = |value: &serde_json::Value| value.as_f64().expect("a number");
    let point = |pair: &serde_json::Value| [number(&pair[0]), number(&pair[1])];
    let open = |ring: &serde_json::Value| {
        let points = ring.as_array().expect("points");
        points[1..].iter().map(point).collect()
    };
    (name.to_owned(), rings.iter().map(open).collect())
}
