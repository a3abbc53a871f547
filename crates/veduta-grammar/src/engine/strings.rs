//! Functions of strings and of the names of files.

use super::functions::{mapped, text, Function};
use super::regexes;
use super::value::{Kind, Value, MAX_ELEMENTS};

/// Names, functions, and the fewest and most arguments.
pub const TABLE: &[(&str, Function, usize, usize)] = {
    use Function::Of;
    &[
        ("fileBasename", Of(file_stem), 1, 1),
        ("fileDirectory", Of(file_directory), 1, 1),
        ("fileExtension", Of(file_extension), 1, 1),
        ("fileName", Of(file_name), 1, 1),
        ("findLast", Of(find_last), 2, 2),
        ("getPrefix", Of(prefix), 2, 2),
        ("getRange", Of(range), 3, 3),
        ("getSuffix", Of(suffix), 2, 2),
        ("isNull", Of(is_null), 1, 1),
        ("sel", Of(selector), 1, 1),
        ("splitString", Of(split), 2, 2),
    ]
};

/// `splitString(text, between)`: an array. What separates is a regular expression after `$`; where it
/// is nothing, each letter is one part, between two that are empty.
fn split(args: &[Value]) -> Result<Value, String> {
    let (all, between) = (text(args, 0)?, text(args, 1)?);
    let parts = match between.strip_prefix('$') {
        Some(expression) => regexes::split(all, expression)?,
        None => all.split(between).take(MAX_ELEMENTS + 1).collect(),
    };
    if parts.len() > MAX_ELEMENTS {
        return Err(format!("an array of more than {MAX_ELEMENTS} elements"));
    }
    Ok(Value::list(parts.into_iter().map(Value::text).collect()))
}

/// `findLast(text, part)`: the place of the last; -1 where there is none.
fn find_last(args: &[Value]) -> Result<Value, String> {
    let all = text(args, 0)?;
    let place = all.rfind(text(args, 1)?);
    let characters = |at: usize| all[..at].chars().count() as f64;
    Ok(Value::Number(place.map_or(-1.0, characters)))
}

/// `fileName(path)`: what follows the last slash.
fn file_name(args: &[Value]) -> Result<Value, String> {
    let path = text(args, 0)?;
    Ok(Value::text(path.rsplit(['/', '\\']).next().unwrap_or(path)))
}

/// `fileBasename(path)`: the name of the file without what follows its last dot.
fn file_stem(args: &[Value]) -> Result<Value, String> {
    let name = file_name(args)?.to_string();
    Ok(Value::text(
        name.rsplit_once('.').map_or(&name, |(stem, _)| stem),
    ))
}

/// `fileDirectory(path)`: up to the last slash, with it.
fn file_directory(args: &[Value]) -> Result<Value, String> {
    let path = text(args, 0)?;
    let end = path.rfind(['/', '\\']).map_or(0, |at| at + 1);
    Ok(Value::text(&path[..end]))
}

/// `fileExtension(path)`: what follows the last dot of the file's name.
fn file_extension(args: &[Value]) -> Result<Value, String> {
    let name = file_name(args)?.to_string();
    Ok(Value::text(
        name.rsplit_once('.').map_or("", |(_, extension)| extension),
    ))
}

/// `getPrefix(text, part)`: what stands before the first `part`; nothing where there is none.
fn prefix(args: &[Value]) -> Result<Value, String> {
    let found = text(args, 0)?.split_once(text(args, 1)?);
    Ok(Value::text(found.map_or("", |(before, _)| before)))
}

/// `getSuffix(text, part)`: what follows the last `part`; nothing where there is none.
fn suffix(args: &[Value]) -> Result<Value, String> {
    let found = text(args, 0)?.rsplit_once(text(args, 1)?);
    Ok(Value::text(found.map_or("", |(_, after)| after)))
}

/// `getRange(text, left, right)`: what stands between the first `left` and the last `right`;
/// nothing where one is missing or they overlap.
fn range(args: &[Value]) -> Result<Value, String> {
    let (all, left, right) = (text(args, 0)?, text(args, 1)?, text(args, 2)?);
    let from = all.find(left).map(|at| at + left.len());
    let between = from.zip(all.rfind(right));
    let found = between.and_then(|(from, to)| all.get(from..to));
    Ok(Value::text(found.unwrap_or("")))
}

/// The text that stands for a missing one.
const MISSING: &str = "\u{e000}";

/// `isNull(value)`: whether it is the number or the text that stands for a missing one; of an array
/// for each of its elements.
fn is_null(args: &[Value]) -> Result<Value, String> {
    mapped(&args[0], Kind::Truths, |value| {
        Ok(Value::Bool(match value {
            Value::Number(number) => number.is_nan(),
            Value::Text(text) => text.as_ref() == MISSING,
            _ => false,
        }))
    })
}

/// `sel(text)`: the text as a selector.
fn selector(args: &[Value]) -> Result<Value, String> {
    text(args, 0).map(Value::text)
}
