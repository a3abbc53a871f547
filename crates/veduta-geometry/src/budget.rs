//! A bound on the work that an operation may do and the memory that it may take, which whoever calls it sets.
//!
//! Long loops take steps from the budget as they go on, and stop with [`Spent`] where there are none
//! left. A step is about the work of looking at one pair of faces, edges or corners: some
//! nanoseconds.

/// How many steps and bytes may still be taken. What is counted is up to the caller: steps, bytes,
/// time, or all of them.
pub trait Budget {
    /// Takes so many steps, before they are done.
    ///
    /// # Errors
    /// Where that is more than there are. From then on it is so each time.
    fn take(&self, steps: usize) -> Result<(), Spent>;

    /// Takes so many bytes for what is made and stays, before it is made.
    ///
    /// # Errors
    /// As [`Budget::take`].
    fn hold(&self, bytes: usize) -> Result<(), Spent>;
}

/// The work that was allowed is done, and there is no result yet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the work that is allowed is done before there is a result")]
pub struct Spent;

/// As many steps as are wanted.
#[derive(Debug, Clone, Copy, Default)]
pub struct Unlimited;

impl Budget for Unlimited {
    fn take(&self, _: usize) -> Result<(), Spent> {
        Ok(())
    }

    fn hold(&self, _: usize) -> Result<(), Spent> {
        Ok(())
    }
}
