//! The shaders against the loops for processors, on whatever adapter there is, a software one too.

#![allow(clippy::unwrap_used, clippy::panic)]

#[path = "../../veduta-carve/tests/ball/mod.rs"]
mod ball;
mod carving;
mod matching;
#[path = "../../veduta-stereo/tests/scene.rs"]
mod scene;
mod searching;
mod sweeping;
mod vanishing;

use veduta_gpu::{Card, GpuError};

/// None, with a word about it, where nothing here can run a shader.
fn card() -> Option<Card> {
    match Card::open(true) {
        Ok(card) => Some(card),
        Err(GpuError::None) => {
            eprintln!("SKIPPED: no adapter; Debian's mesa-vulkan-drivers brings a software one");
            None
        }
        Err(why) => panic!("{why}"),
    }
}
