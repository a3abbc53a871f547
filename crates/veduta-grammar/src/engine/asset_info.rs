//! What rules ask of assets: their size and the names of their parts.

use crate::shape::Kind;
use crate::Span;

use super::fault::Fault;
use super::run::Run;
use super::value::Value;

impl Run<'_> {
    pub(super) fn asset_info(&self, args: &[Value], span: Span) -> Result<Value, Fault> {
        let (name, what) = (args[0].to_string(), args[1].to_string());
        let asset = self.options.assets.get(name.as_str());
        let asset = asset.ok_or_else(|| Fault::missing(span, name.as_str().into()))?;
        let (low, size) = asset.bounds();
        let (kind, axis) = what.split_at_checked(1).unwrap_or_default();
        let axis = "xyz".find(axis).unwrap_or(0);
        Ok(Value::Number(match kind {
            "s" => size[axis],
            _ => low[axis],
        }))
    }

    pub(super) fn asset_names(
        &self,
        args: &[Value],
        as_array: bool,
        span: Span,
    ) -> Result<Value, Fault> {
        let name = args[0].to_string();
        let asset = self.options.assets.get(name.as_str());
        let asset = asset.ok_or_else(|| Fault::missing(span, name.as_str().into()))?;
        let kind = match args.get(1).map(ToString::to_string).as_deref() {
            Some("g") | None => Kind::Groups,
            Some("m") => Kind::Materials,
            Some(other) => {
                let message = format!("`{other}` names no parts of an asset: g or m");
                return Err(Fault::at(span, message));
            }
        };
        let names = asset.part_names(kind);
        Ok(if as_array {
            Value::texts(names.into_iter().map(Value::Text).collect())
        } else {
            Value::text(
                &names
                    .iter()
                    .map(|name| format!("{name};"))
                    .collect::<String>(),
            )
        })
    }
}
