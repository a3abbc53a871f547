//! Two views of one scene: the fundamental matrix or the homography that explains their matches.
//!
//! Sections 2.4 and 2.5.2 of the thesis that `veduta photos` follows: the normalised eight points,
//! seven points, draws from buckets, least median of squares (LMedS), RANSAC, and an M-estimator
//! with Huber's weights at the end. Where its formulas slip we say so. Matches are pixels; F and H
//! lead from the first photo to the second: `m2^T F m1 = 0`, `m2 ~ H m1`.

pub mod buckets;
pub mod chance;
pub mod distance;
pub mod error;
pub mod fundamental;
pub mod gric;
pub mod homography;
pub mod matches;
pub mod refine;
pub mod robust;
pub mod two_views;

pub use error::MatchError;
pub use matches::Match;
