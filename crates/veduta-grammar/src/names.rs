//! Names as small numbers, so that comparing and looking up a name costs one comparison.

use std::collections::HashMap;
use std::sync::Arc;

/// A name in a [`Names`]. Dotted names (`scope.sx`, `lib.Roof`) are one symbol.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Symbol(u32);

impl Symbol {
    /// Counts from 0 in the order in which names were first seen: an index for side tables.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// All names of a rule file and of the files that it imports. Files that are to be evaluated
/// together share one.
#[derive(Debug, Clone, Default)]
pub struct Names {
    texts: Vec<Arc<str>>,
    symbols: HashMap<Arc<str>, Symbol>,
}

impl Names {
    pub fn new() -> Self {
        Self::default()
    }

    pub fn intern(&mut self, text: &str) -> Symbol {
        if let Some(symbol) = self.symbols.get(text) {
            return *symbol;
        }
        let symbol = Symbol(u32::try_from(self.texts.len()).unwrap_or(u32::MAX));
        let shared: Arc<str> = text.into();
        self.texts.push(shared.clone());
        self.symbols.insert(shared, symbol);
        symbol
    }

    /// The symbol of a name that has been seen.
    pub fn find(&self, text: &str) -> Option<Symbol> {
        self.symbols.get(text).copied()
    }

    pub fn text(&self, symbol: Symbol) -> &str {
        self.texts.get(symbol.index()).map_or("", |text| text)
    }

    /// The name with this number.
    pub fn shared(&self, index: usize) -> Arc<str> {
        self.texts[index].clone()
    }

    pub fn len(&self) -> usize {
        self.texts.len()
    }

    pub fn is_empty(&self) -> bool {
        self.texts.is_empty()
    }
}
