//! Functions of colours as strings: `#rrggbb`, or `#rrggbboo` with the opacity.

use super::functions::{number, text, Function};
use super::value::Value;

/// Names, functions, and the fewest and most arguments. Channels are 0 to 1, hues degrees.
pub const TABLE: &[(&str, Function, usize, usize)] = {
    use Function::Of;
    &[
        ("colorHSVOToHex", Of(|args| from_hsv(args, true)), 4, 4),
        ("colorHSVToHex", Of(|args| from_hsv(args, false)), 3, 3),
        ("colorHexToB", Of(|args| channel(args, 2)), 1, 1),
        ("colorHexToG", Of(|args| channel(args, 1)), 1, 1),
        ("colorHexToH", Of(|args| hsv(args, 0)), 1, 1),
        ("colorHexToO", Of(|args| channel(args, 3)), 1, 1),
        ("colorHexToR", Of(|args| channel(args, 0)), 1, 1),
        ("colorHexToS", Of(|args| hsv(args, 1)), 1, 1),
        ("colorHexToV", Of(|args| hsv(args, 2)), 1, 1),
        ("colorRGBOToHex", Of(from_channels), 4, 4),
        ("colorRGBToHex", Of(from_channels), 3, 3),
        ("colorRamp", Of(ramp), 2, 2),
    ]
};

/// The colours of the ramps (red, green, blue), evenly from 0 to 1. CityEngine shows its ramps in
/// pictures alone; these have the colours that their names say.
const RAMPS: &[(&str, &[[f64; 3]])] = &[
    ("whiteToBlack", &[[1.0, 1.0, 1.0], [0.0, 0.0, 0.0]]),
    (
        "greenToRed",
        &[[0.0, 1.0, 0.0], [1.0, 1.0, 0.0], [1.0, 0.0, 0.0]],
    ),
    ("yellowToRed", &[[1.0, 1.0, 0.0], [1.0, 0.0, 0.0]]),
    ("redToBlue", &[[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]),
    ("orangeToBlue", &[[1.0, 0.5, 0.0], [0.0, 0.0, 1.0]]),
    ("brownToBlue", &[[0.6, 0.3, 0.0], [0.0, 0.0, 1.0]]),
    (
        "spectrum",
        &[
            [1.0, 0.0, 0.0],
            [1.0, 1.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, 1.0, 1.0],
            [0.0, 0.0, 1.0],
        ],
    ),
];

/// `colorRamp(name, value)`: the colour at a value from 0 to 1.
fn ramp(args: &[Value]) -> Result<Value, String> {
    let name = text(args, 0)?;
    let Some((_, colours)) = RAMPS.iter().find(|(known, _)| *known == name) else {
        let known: Vec<&str> = RAMPS.iter().map(|(known, _)| *known).collect();
        return Err(format!(
            "`{name}` is no ramp of colours: {}",
            known.join(", ")
        ));
    };
    let place = number(args, 1)?.clamp(0.0, 1.0) * (colours.len() - 1) as f64;
    let first = (place as usize).min(colours.len() - 2);
    let share = place - first as f64;
    let [r, g, b] = [0, 1, 2].map(|channel| {
        let (from, to) = (colours[first][channel], colours[first + 1][channel]);
        ((from + (to - from) * share) * 255.0).round() as u8
    });
    Ok(Value::text(&format!("#{r:02x}{g:02x}{b:02x}")))
}

/// The channels of `#rrggbb`, and the opacity where it is given. Of `#rgb` each digit counts twice.
pub fn parsed(text: &str) -> Option<([f32; 3], Option<f32>)> {
    let digits = text.strip_prefix('#')?;
    let width = match digits.len() {
        3 | 4 => 1,
        6 | 8 => 2,
        _ => return None,
    };
    if !digits.is_ascii() {
        return None;
    }
    let mut channels = Vec::with_capacity(4);
    for at in (0..digits.len()).step_by(width) {
        let value = u8::from_str_radix(&digits[at..at + width], 16).ok()?;
        let value = if width == 1 { value * 17 } else { value };
        channels.push(f32::from(value) / 255.0);
    }
    Some((
        [channels[0], channels[1], channels[2]],
        channels.get(3).copied(),
    ))
}

/// A channel without what single precision took from it.
fn exact(channel: f32) -> f64 {
    (f64::from(channel) * 255.0).round() / 255.0
}

fn given(args: &[Value]) -> Result<[f64; 4], String> {
    let text = text(args, 0)?;
    let (colour, opacity) =
        parsed(text).ok_or_else(|| format!("`{text}` is no colour: #rrggbb or #rrggbbaa"))?;
    let [r, g, b] = colour.map(exact);
    Ok([r, g, b, opacity.map_or(1.0, exact)])
}

fn channel(args: &[Value], index: usize) -> Result<Value, String> {
    Ok(Value::Number(given(args)?[index]))
}

fn hsv(args: &[Value], index: usize) -> Result<Value, String> {
    let [r, g, b, _] = given(args)?;
    let (most, least) = (r.max(g).max(b), r.min(g).min(b));
    let span = most - least;
    let sixth = if span == 0.0 {
        0.0
    } else if most == r {
        ((g - b) / span).rem_euclid(6.0)
    } else if most == g {
        (b - r) / span + 2.0
    } else {
        (r - g) / span + 4.0
    };
    let saturation = if most == 0.0 { 0.0 } else { span / most };
    Ok(Value::Number([60.0 * sixth, saturation, most][index]))
}

fn from_channels(args: &[Value]) -> Result<Value, String> {
    let mut channels = Vec::with_capacity(args.len());
    for index in 0..args.len() {
        channels.push(number(args, index)?);
    }
    Ok(hex(&channels))
}

fn from_hsv(args: &[Value], opacity: bool) -> Result<Value, String> {
    let (hue, saturation, value) = (number(args, 0)?, number(args, 1)?, number(args, 2)?);
    let part = |offset: f64| {
        let k = (offset + hue / 60.0).rem_euclid(6.0);
        value - value * saturation * k.min(4.0 - k).clamp(0.0, 1.0)
    };
    let mut channels = vec![part(5.0), part(3.0), part(1.0)];
    if opacity {
        channels.push(number(args, 3)?);
    }
    Ok(hex(&channels))
}

fn hex(channels: &[f64]) -> Value {
    let mut text = String::from("#");
    for channel in channels {
        let byte = (channel.clamp(0.0, 1.0) * 255.0).round() as u8;
        text.push_str(&format!("{byte:02x}"));
    }
    Value::text(&text)
}
