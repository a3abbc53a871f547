//! Attributes and constants, each evaluated once for a start shape.

use super::draws::Draws;
use super::evaluate::Scene;
use super::fault::Fault;
use super::random::Stream;
use super::run::Run;
use super::state::State;
use super::tree::Known;
use super::value::Value;

#[derive(Clone)]
pub(super) enum Global {
    Unknown,
    /// Being evaluated: a second look at it is a circle.
    Open,
    Known(Value),
}

impl Run<'_> {
    /// The value of an attribute or a constant for a shape.
    pub(super) fn global(&mut self, index: usize, state: &State) -> Result<Value, Fault> {
        if let Some(value) = state.set.as_ref().and_then(|set| set.get(&index)) {
            return Ok(value.clone());
        }
        let code = self.code;
        let global = &code.globals[index];
        match &self.globals[index] {
            Global::Known(value) => return Ok(value.clone()),
            Global::Open => {
                let message = format!("{} depends on itself", global.name);
                return Err(Fault::at(global.value.span, message).within(global.unit));
            }
            Global::Unknown => {}
        }
        let mut draws = Draws::default();
        let given = self.options.attributes.get(global.name.as_ref());
        let value = if let Some(value) = given.filter(|_| global.is_attribute) {
            value.clone()
        } else {
            self.globals[index] = Global::Open;
            let start = self.tree.nodes[0].state.clone();
            let mut scene = Scene {
                slots: &mut Vec::new(),
                state: &start,
                stream: &mut Stream::new(self.options.seed).child(u32::MAX - index as u32),
                draws: &mut draws,
            };
            let found = self.with_locals(&global.locals, &global.value, &mut scene);
            self.globals[index] = Global::Unknown;
            found.map_err(|fault| fault.within(global.unit))?
        };
        self.globals[index] = Global::Known(value.clone());
        self.tree.globals.push(Known {
            global: index as u32,
            name: global.name.clone(),
            is_attribute: global.is_attribute,
            value: value.clone(),
            choices: draws.taken,
        });
        Ok(value)
    }

    /// Evaluates the attributes and constants that nothing has needed: the prior is that of all,
    /// and does not depend on which of them a tree uses. Those that fail were not needed.
    pub(super) fn know_all(&mut self) {
        let start = self.tree.nodes[0].state.clone();
        let messages = self.tree.messages.len();
        for index in 0..self.globals.len() {
            let _ = self.global(index, &start);
        }
        self.tree.messages.truncate(messages);
        self.tree.globals.sort_by_key(|known| known.global);
    }
}
