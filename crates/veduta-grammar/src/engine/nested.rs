//! Rules and operations that are derived at once, for the shapes that they leave.

use crate::Span;

use super::code::Body;
use super::fault::Fault;
use super::frame::Frame;
use super::run::Run;
use super::state::State;

/// How deep operations may inline one another: each level takes room on the stack.
const MOST_NESTED: usize = 40;

impl Run<'_> {
    /// The leaves of a body on a shape, which do not become part of the tree.
    pub(super) fn inlined(
        &mut self,
        body: &Body,
        state: State,
        span: Span,
        frame: &mut Frame,
    ) -> Result<Vec<State>, Fault> {
        if self.nested >= MOST_NESTED {
            let message = format!("operations inline one another {MOST_NESTED} deep");
            return Err(Fault::at(span, message));
        }
        self.check_time(span)?;
        self.nested += 1;
        let outer = (
            std::mem::take(&mut self.waiting),
            self.trail.clone(),
            self.at,
        );
        let nodes = self.tree.nodes.len();
        self.run_cell(body, state, frame)?;
        self.waiting.reverse();
        self.work()?;
        let made = self.tree.nodes.drain(nodes..);
        let mut left = Vec::new();
        for node in made {
            frame.draws.inlined.add(node.log_sum());
            if node.rule.is_none() {
                left.push(node.state);
            }
        }
        (self.waiting, self.trail, self.at) = outer;
        self.nested -= 1;
        Ok(left)
    }
}
