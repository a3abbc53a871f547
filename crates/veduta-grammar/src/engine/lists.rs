//! Functions of lists that are strings: elements with `;` after each.

use super::functions::{array, number, text, Function};
use super::value::{Value, MAX_ELEMENTS};

/// Names, functions, and the fewest and most arguments.
pub const TABLE: &[(&str, Function, usize, usize)] = {
    use Function::Of;
    &[
        ("listAdd", Of(add), 2, 2),
        ("listClean", Of(clean), 1, 1),
        ("listCount", Of(count), 2, 2),
        ("listFirst", Of(first), 1, 1),
        ("listFromArray", Of(from_array), 1, 1),
        ("listIndex", Of(index), 2, 2),
        ("listItem", Of(item), 2, 2),
        ("listLast", Of(last), 1, 1),
        ("listRange", Of(range), 3, 3),
        ("listRemove", Of(remove), 2, 2),
        ("listRemoveAll", Of(remove_all), 2, 2),
        ("listRetainAll", Of(retain_all), 2, 2),
        ("listSize", Of(size), 1, 1),
        ("listTerminate", Of(terminate), 1, 1),
        ("listToArray", Of(to_array), 1, 1),
    ]
};

fn elements(args: &[Value], index: usize) -> Result<Vec<&str>, String> {
    Ok(split(text(args, index)?))
}

fn split(list: &str) -> Vec<&str> {
    let list = list.strip_suffix(';').unwrap_or(list);
    if list.is_empty() {
        Vec::new()
    } else {
        list.split(';').collect()
    }
}

fn list<'a>(elements: impl IntoIterator<Item = &'a str>) -> Value {
    let mut all = String::new();
    for element in elements {
        all.push_str(element);
        all.push(';');
    }
    Value::text(&all)
}

/// Whether an element is what is looked for, of which a `*` at an end stands for anything.
fn is_like(element: &str, wanted: &str) -> bool {
    match (wanted.strip_prefix('*'), wanted.strip_suffix('*')) {
        (Some(inner), Some(_)) => element.contains(inner.strip_suffix('*').unwrap_or("")),
        (Some(end), None) => element.ends_with(end),
        (None, Some(start)) => element.starts_with(start),
        (None, None) => element == wanted,
    }
}

/// What is looked for: one text, or a list of them.
fn wanted(args: &[Value]) -> Result<Vec<String>, String> {
    let text = args[1].written()?;
    Ok(split(&text).into_iter().map(str::to_string).collect())
}

/// `listAdd(list, element)`
fn add(args: &[Value]) -> Result<Value, String> {
    let mut all = elements(args, 0)?;
    let new = args[1].written()?;
    all.push(new.strip_suffix(';').unwrap_or(&new));
    Ok(list(all))
}

/// `listClean(list)`: without empty elements.
fn clean(args: &[Value]) -> Result<Value, String> {
    let all = elements(args, 0)?;
    Ok(list(all.into_iter().filter(|one| !one.is_empty())))
}

/// `listCount(list, element)`; here and below, `*` at an end of the element stands for anything.
fn count(args: &[Value]) -> Result<Value, String> {
    let wanted = args[1].written()?;
    let all = elements(args, 0)?;
    Ok(Value::Number(
        all.iter().filter(|one| is_like(one, &wanted)).count() as f64,
    ))
}

/// `listFirst(list)`; the empty string of an empty list.
fn first(args: &[Value]) -> Result<Value, String> {
    let all = elements(args, 0)?;
    Ok(Value::text(all.first().unwrap_or(&"")))
}

/// `listLast(list)`; the empty string of an empty list.
fn last(args: &[Value]) -> Result<Value, String> {
    let all = elements(args, 0)?;
    Ok(Value::text(all.last().unwrap_or(&"")))
}

/// `listFromArray(array)`
fn from_array(args: &[Value]) -> Result<Value, String> {
    let mut all = String::new();
    for value in &array(args)?.values {
        all.push_str(&value.written()?);
        all.push(';');
        if all.len() > MAX_ELEMENTS {
            return Err(format!("a string of more than {MAX_ELEMENTS} bytes"));
        }
    }
    Ok(Value::text(&all))
}

/// `listToArray(list)`
fn to_array(args: &[Value]) -> Result<Value, String> {
    let all = elements(args, 0)?;
    Ok(Value::texts(all.into_iter().map(Value::text).collect()))
}

/// `listIndex(list, element)`: of the first; -1 where there is none.
fn index(args: &[Value]) -> Result<Value, String> {
    let wanted = args[1].written()?;
    let all = elements(args, 0)?;
    let place = all.iter().position(|one| is_like(one, &wanted));
    Ok(Value::Number(place.map_or(-1.0, |place| place as f64)))
}

/// `listItem(list, index)`; the empty string beyond the ends.
fn item(args: &[Value]) -> Result<Value, String> {
    let at = number(args, 1)?;
    let all = elements(args, 0)?;
    let found = (at >= 0.0).then(|| all.get(at as usize)).flatten();
    Ok(Value::text(found.unwrap_or(&"")))
}

/// `listRange(list, from, to)`: without the element at `to`.
fn range(args: &[Value]) -> Result<Value, String> {
    let (from, to) = (number(args, 1)?.max(0.0), number(args, 2)?.max(0.0));
    let all = elements(args, 0)?;
    let taken = (to - from).max(0.0) as usize;
    Ok(list(all.into_iter().skip(from as usize).take(taken)))
}

/// `listRemove(list, element)`: the first of them.
fn remove(args: &[Value]) -> Result<Value, String> {
    let wanted = args[1].written()?;
    let mut all = elements(args, 0)?;
    if let Some(place) = all.iter().position(|one| is_like(one, &wanted)) {
        all.remove(place);
    }
    Ok(list(all))
}

/// `listRemoveAll(list, others)`
fn remove_all(args: &[Value]) -> Result<Value, String> {
    let (all, others) = (elements(args, 0)?, wanted(args)?);
    let is_meant = |one: &&str| others.iter().any(|other| is_like(one, other));
    Ok(list(all.into_iter().filter(|one| !is_meant(one))))
}

/// `listRetainAll(list, others)`
fn retain_all(args: &[Value]) -> Result<Value, String> {
    let (all, others) = (elements(args, 0)?, wanted(args)?);
    let is_meant = |one: &&str| others.iter().any(|other| is_like(one, other));
    Ok(list(all.into_iter().filter(|one| is_meant(one))))
}

/// `listSize(list)`
fn size(args: &[Value]) -> Result<Value, String> {
    Ok(Value::Number(elements(args, 0)?.len() as f64))
}

/// `listTerminate(list)`: with `;` at the end.
fn terminate(args: &[Value]) -> Result<Value, String> {
    Ok(list(elements(args, 0)?))
}

/// `listRandom(list)`; `chance` is from 0 to 1.
pub fn random(args: &[Value], chance: f64) -> Result<Value, String> {
    let all = elements(args, 0)?;
    let at = (chance * all.len() as f64) as usize;
    Ok(Value::text(all.get(at).unwrap_or(&"")))
}
