//! Attributes and constants, each evaluated once for a start shape.

use super::evaluate::Scene;
use super::fault::Fault;
use super::random::Stream;
use super::run::Run;
use super::state::State;
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
                log_prior: &mut 0.0,
            };
            let found = self.with_locals(&global.locals, &global.value, &mut scene);
            self.globals[index] = Global::Unknown;
            found.map_err(|fault| fault.within(global.unit))?
        };
        self.globals[index] = Global::Known(value.clone());
        Ok(value)
    }
}
