//! What can be wrong with a grid.

use thiserror::Error;

#[derive(Debug, Error, PartialEq, Eq)]
pub enum LabelError {
    #[error("{given} costs for {rows} x {columns} cells with {labels} labels")]
    Costs {
        given: usize,
        rows: usize,
        columns: usize,
        labels: usize,
    },
    #[error("{given} channels of colour where {wanted} are needed")]
    Colours { given: usize, wanted: usize },
    #[error("a cost is not a number")]
    NotANumber,
}
