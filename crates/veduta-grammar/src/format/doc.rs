//! Text with places where lines may break, and the choice of those that do.
//!
//! The layout of P. Wadler, "A prettier printer" (2003), with two additions for comments: what
//! follows a comment to the end of the line begins a new line, and so does a comment that had a
//! line of its own.

/// Columns that a line should not pass.
pub(super) const WIDTH: usize = 100;
const INDENT: usize = 4;

#[derive(Debug, Clone)]
pub(super) enum Doc {
    Text(String),
    /// A space, or a new line where the group around it does not fit on one.
    Line,
    /// Nothing, or a new line where the group around it does not fit on one.
    Soft,
    /// A new line.
    Hard,
    /// Nothing, but the groups around it do not stand on one line.
    Tall,
    /// An empty line, unless the text begins here.
    Blank,
    /// A comment on the line of the word before it.
    Trailing {
        text: String,
        to_line_end: bool,
    },
    /// A comment on a line of its own.
    Own(String),
    Concat(Vec<Doc>),
    Indented(Vec<Doc>),
    /// Stands on one line if it fits and `breaks` does not forbid that.
    Group {
        parts: Vec<Doc>,
        breaks: Breaks,
    },
}

impl Doc {
    pub fn text(text: impl Into<String>) -> Doc {
        Doc::Text(text.into())
    }

    pub fn group(parts: Vec<Doc>) -> Doc {
        let breaks = breaks_of(&parts);
        Doc::Group { parts, breaks }
    }

    fn breaks(&self) -> Breaks {
        match self {
            Doc::Text(_) | Doc::Line | Doc::Soft => Breaks::Nowhere,
            Doc::Hard | Doc::Tall | Doc::Blank | Doc::Own(_) => Breaks::Inside,
            Doc::Trailing { text, .. } if text.contains('\n') => Breaks::Inside,
            Doc::Trailing { to_line_end, .. } if *to_line_end => Breaks::AfterIt,
            Doc::Trailing { .. } => Breaks::Nowhere,
            Doc::Concat(parts) | Doc::Indented(parts) => breaks_of(parts),
            Doc::Group { breaks, .. } => *breaks,
        }
    }
}

/// Where a line has to end, whatever fits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Breaks {
    Nowhere,
    /// Only at the end: a comment is the last word.
    AfterIt,
    Inside,
}

fn breaks_of(parts: &[Doc]) -> Breaks {
    let mut all = Breaks::Nowhere;
    for part in parts {
        if all == Breaks::AfterIt {
            return Breaks::Inside;
        }
        all = part.breaks();
        if all == Breaks::Inside {
            return all;
        }
    }
    all
}

/// What is left to be written: a part, its indentation, and whether it stands on one line.
type Rest<'a> = Vec<(&'a Doc, usize, bool)>;

#[derive(Default)]
struct Writer {
    text: String,
    column: usize,
    /// A line has to end before the next word.
    line_due: bool,
    /// The indentation of that line, if not that of its first word.
    indent: Option<usize>,
    /// The last word was a comment within its line.
    after_comment: bool,
}

/// Lays a text out. It ends with a line break, unless it is empty.
pub(super) fn write(doc: &Doc) -> String {
    let mut writer = Writer::default();
    let mut rest: Rest = vec![(doc, 0, false)];
    while let Some((part, indent, flat)) = rest.pop() {
        match part {
            Doc::Text(text) => writer.word(text, indent),
            Doc::Line if flat => writer.space(),
            Doc::Soft if flat => {}
            Doc::Tall => {}
            Doc::Line | Doc::Soft | Doc::Hard => writer.line(indent),
            Doc::Blank => writer.blank(),
            Doc::Trailing { text, to_line_end } => writer.trailing(text, *to_line_end, indent),
            Doc::Own(text) => writer.own(text, indent),
            Doc::Concat(parts) => rest.extend(parts.iter().rev().map(|one| (one, indent, flat))),
            Doc::Indented(parts) => {
                let indent = indent + INDENT;
                rest.extend(parts.iter().rev().map(|one| (one, indent, flat)));
            }
            Doc::Group { parts, breaks } => {
                let first = rest.len();
                rest.extend(parts.iter().rev().map(|one| (one, indent, true)));
                if !flat && (*breaks == Breaks::Inside || !fits(&rest, writer.start(indent))) {
                    rest[first..]
                        .iter_mut()
                        .for_each(|(_, _, flat)| *flat = false);
                }
            }
        }
    }
    if !writer.text.is_empty() {
        writer.text.push('\n');
    }
    writer.text
}

impl Writer {
    /// The column at which the next word would begin.
    fn start(&self, indent: usize) -> usize {
        if self.line_due {
            self.indent.unwrap_or(indent)
        } else {
            self.column
        }
    }

    fn end_line(&mut self) {
        let length = self.text.trim_end_matches(' ').len();
        self.text.truncate(length);
        self.text.push('\n');
        self.column = 0;
        self.line_due = false;
        self.after_comment = false;
    }

    fn line(&mut self, indent: usize) {
        if !self.text.is_empty() {
            self.line_due = true;
            self.indent = Some(indent);
        }
    }

    /// A comment on its own line; what follows has its indentation.
    fn own(&mut self, text: &str, indent: usize) {
        let indent = self.indent.unwrap_or(indent);
        self.line_due |= self.column > 0;
        self.word(text, indent);
        self.line(indent);
    }

    fn blank(&mut self) {
        if !self.text.is_empty() {
            self.end_line();
            self.text.push('\n');
        }
    }

    fn space(&mut self) {
        if !self.line_due && self.column > 0 && !self.text.ends_with(' ') {
            self.push(" ");
            self.after_comment = false;
        }
    }

    fn word(&mut self, text: &str, indent: usize) {
        if self.line_due {
            self.end_line();
        }
        if self.column == 0 {
            let indent = self.indent.take().unwrap_or(indent);
            self.push(&" ".repeat(indent));
        } else if self.after_comment && !text.starts_with(' ') {
            self.push(" ");
        }
        self.after_comment = false;
        self.push(text);
    }

    fn trailing(&mut self, text: &str, to_line_end: bool, indent: usize) {
        if self.column > 0 && !self.text.ends_with(' ') {
            self.push(" ");
        }
        self.after_comment = false;
        self.word(text, indent);
        self.after_comment = true;
        self.line_due |= to_line_end;
    }

    fn push(&mut self, text: &str) {
        self.text.push_str(text);
        self.column = match text.rsplit_once('\n') {
            Some((_, last)) => last.chars().count(),
            None => self.column + text.chars().count(),
        };
    }
}

/// Whether what is left fits on the line up to its first break.
fn fits(rest: &Rest, start: usize) -> bool {
    let mut room = WIDTH.saturating_sub(start);
    let mut open: Vec<(&Doc, bool)> = Vec::new();
    let mut outer = rest.iter().rev().map(|(part, _, flat)| (*part, *flat));
    loop {
        let Some((part, flat)) = open.pop().or_else(|| outer.next()) else {
            return true;
        };
        let width = match part {
            Doc::Text(text) => text.chars().count(),
            Doc::Line if flat => 1,
            Doc::Soft if flat => 0,
            Doc::Tall => 0,
            Doc::Line | Doc::Soft | Doc::Hard | Doc::Blank | Doc::Own(_) => return true,
            Doc::Trailing { text, to_line_end } => {
                if *to_line_end {
                    return true; // a comment may pass the width
                }
                text.chars().count() + 1
            }
            Doc::Concat(parts) | Doc::Indented(parts) | Doc::Group { parts, .. } => {
                open.extend(parts.iter().rev().map(|one| (one, flat)));
                0
            }
        };
        if width > room {
            return false;
        }
        room -= width;
    }
}
