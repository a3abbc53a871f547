//! The annotations.

#[rustfmt::skip]
pub const ANNOTATIONS: &[&str] = &[
    "Angle", "Color", "Description", "Directory", "Distance", "Enum", "File", "Group", "Handle",
    "Hidden", "InEdge", "InMesh", "InPoint", "InPointCloud", "InPolygon", "MaterialFile", "Order",
    "Out", "Percent", "Range", "StartRule",
];
