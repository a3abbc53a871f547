//! Why there is no roof, with the values that say where.

use thiserror::Error;

use crate::Spent;

/// What is wrong with eaves, or with the roof that was asked for. Vertices are numbered through
/// all rings; edge `e` runs from vertex `e` to the next one of its ring.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SkeletonError {
    #[error("{vertices} vertices; {most} are the most")]
    TooMany { vertices: usize, most: usize },
    #[error("vertex {vertex} is not finite, or too far from the origin")]
    NotFinite { vertex: usize },
    #[error("ring {ring} has {vertices} vertices; 3 are the least")]
    RingTooShort { ring: usize, vertices: usize },
    #[error("there are {speeds} values for {edges} edges")]
    SpeedCount { speeds: usize, edges: usize },
    #[error("the speed of edge {edge} is {speed}; it must be from 0 to {most}")]
    BadSpeed { edge: usize, speed: f64, most: f64 },
    #[error("the height to stop at is {height_m} m; it must be above {least_m} m")]
    BadHeight { height_m: f64, least_m: f64 },
    #[error("edge {edge} is {length_m} m long; {least_m} m are the least")]
    EdgeTooShort {
        edge: usize,
        length_m: f64,
        least_m: f64,
    },
    #[error("ring {ring} runs the wrong way round, or encloses nothing ({area_m2} m2)")]
    WrongWinding { ring: usize, area_m2: f64 },
    #[error("the outline folds back on itself at vertex {vertex}")]
    Spike { vertex: usize },
    #[error("edges {first} and {second} cross or touch")]
    Crossing { first: usize, second: usize },
    #[error("hole {ring} is not inside of the outline, or inside of another hole")]
    HoleOutside { ring: usize },
    #[error(
        "the edges at vertex {vertex} are so nearly parallel that their corner would move by \
         {shift_m} m"
    )]
    NearlyParallel { vertex: usize, shift_m: f64 },
    #[error("the roof has no top: face {face} and others stand all around a part of the inside")]
    Unbounded { face: usize },
    #[error("the slope of face {face} rises on and meets no other")]
    Lost { face: usize },
    #[error("a corner is so pointed that it would reach too far outwards")]
    TooPointed,
    #[error("the slopes meet in more than {most} places: the outline is too intricate")]
    TooManyEvents { most: usize },
    #[error("two slopes are parallel where they meet, at {x_m}, {y_m}")]
    Degenerate { x_m: f64, y_m: f64 },
    #[error("nothing is left of the outline once double points and spikes are gone")]
    Vanished,
    #[error("mending would change the area by {change_m2} m2; {most_m2} m2 are allowed")]
    AreaChange { change_m2: f64, most_m2: f64 },
    #[error("there is no edge {edge}: the outline has {edges}")]
    NoSuchEdge { edge: usize, edges: usize },
    #[error("no place is in sight of all edges, for a point of the roof to stand over it")]
    NoApex,
    #[error("with all ridges at one height, a gable would fold over itself")]
    FoldedGable,
    #[error("the roof found is not sound: {0}")]
    Unsound(#[from] RoofFault),
    #[error(transparent)]
    Spent(#[from] Spent),
}

/// What is wrong with a roof.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum RoofFault {
    #[error("the side from node {from} to node {to} of a face has no other face, or too many")]
    Open { from: u32, to: u32 },
    #[error("face {face} has no outline, or one of fewer than 3 nodes")]
    NoOutline { face: usize },
    #[error("node {node} is {deviation_m} m off the plane of face {face}")]
    NotPlanar {
        face: usize,
        node: u32,
        deviation_m: f64,
    },
    #[error("face {face} has an area of {area_m2} m2")]
    Flipped { face: usize, area_m2: f64 },
    #[error("face {face} crosses itself")]
    SelfCrossing { face: usize },
    #[error("the faces cover {covered_m2} m2 of {area_m2} m2")]
    Area { covered_m2: f64, area_m2: f64 },
    #[error("node {node} is at {height_m} m, below the eaves")]
    Below { node: u32, height_m: f64 },
    #[error("edge {edge} has no face")]
    NoFace { edge: usize },
}
