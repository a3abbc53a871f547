//! Where shapes lie on Earth.

use super::pack::to_place;
use super::run::Run;
use super::state::State;
use super::value::Value;

/// The attribute that says where the frame of places lies on Earth, as a list of eight numbers: x and
/// y of its origin in the CRS of the scene, its longitude and latitude (degrees), and how much each
/// grows with a metre to the east and to the north: longitude by both, latitude by both.
pub const ON_EARTH: &str = "/onEarth";

impl Run<'_> {
    /// `getGeoCoord(x | y | lon | lat)`: of the scope's origin; x and y from the frame's origin where
    /// nobody knows where that is, and 0 for longitude and latitude. Older files have X and Y.
    pub(super) fn geographic(&self, args: &[Value], state: &State) -> Value {
        let [east, north, _] = to_place(state.form.scope.origin);
        let known = match self.options.attributes.get(ON_EARTH) {
            Some(Value::Array(array)) => array.values.iter().filter_map(Value::number).collect(),
            _ => Vec::new(),
        };
        let [x, y, longitude, latitude, by @ ..] = known.as_slice() else {
            return Value::Number(match args[0].to_string().as_str() {
                "x" | "X" => east,
                "y" | "Y" => north,
                _ => 0.0,
            });
        };
        let grown = |at: usize| match by.get(at..at + 2) {
            Some([by_east, by_north]) => by_east * east + by_north * north,
            _ => 0.0,
        };
        Value::Number(match args[0].to_string().as_str() {
            "x" | "X" => x + east,
            "y" | "Y" => y + north,
            "lon" => longitude + grown(0),
            _ => latitude + grown(2),
        })
    }
}
