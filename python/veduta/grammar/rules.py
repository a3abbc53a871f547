"""Rule files: where they are, what they import, whether they can be used.

A rule file is named by its path, or by a style that Veduta brings along (`haussmann`, or as it is
stored, `styles/haussmann.cga`). What it imports is read from its own folder, from the folders of
its project and from libraries (`project`), and from nowhere else.
"""

from __future__ import annotations

import difflib
import os
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import chain
from pathlib import Path

from veduta import _core
from veduta.grammar.encodings import decoded
from veduta.grammar.own_files import with_own_files
from veduta.grammar.project import RULES, SearchPath, search_path, with_folders
from veduta.grammar.rule_packages import SUFFIX as PACKAGE
from veduta.grammar.rule_packages import unpacked
from veduta.run.errors import InputError
from veduta.run.inputs import require_file
from veduta.run.names import real_path

MAX_BYTES = 8 * 2**20
"""Of one file, as the parser has it."""
MAX_FILES = 256
STYLES = Path(__file__).parent / "styles"
SUFFIX = ".cga"
CALLED = "CalledFirst"
"""The rule that a start rule with arguments is called by."""
_CALL = re.compile(r"([A-Za-z_][\w.]*)\s*\([^\n]*\)")
_HEAD = re.compile(r"^\s*([A-Za-z_]\w*)\s*\([^\n()]*\)\s*-->", re.MULTILINE)
_COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*|#[^\n]*", re.DOTALL)
_PLAIN_HEAD = re.compile(r"^\s*([A-Za-z_]\w*)\s*-->", re.MULTILINE)


@dataclass(frozen=True)
class RuleFiles:
    """A rule file and what it imports: the name of each file as messages have it, and its text.

    search: where assets, pictures and tables that the files name are looked for.
    notes: what is said of the files, such as their encodings.
    """

    path: Path
    files: tuple[tuple[str, str], ...]
    search: SearchPath
    notes: tuple[str, ...] = ()

    @property
    def texts(self) -> list[tuple[str, str]]:
        """The files, the main one first, by names that do not depend on where their folder is.

        In a project they are named from its folder on, as imports may name them so.
        """
        folder = os.path.dirname(self.files[0][0]) or "."
        above = [str(one) for one in self.search.folders if Path(folder).is_relative_to(one)]
        top = min(above, key=len, default=folder)
        if os.path.basename(top) == RULES:
            top = os.path.dirname(top) or "."
        return [(os.path.relpath(name, top), text) for name, text in self.files]


@dataclass(frozen=True)
class Verdict:
    """What checking found.

    told: all faults, each with its line and a caret. underived: what the rules ask for that is
    read but does not derive yet, told in the same way; empty where there are errors.
    """

    told: str
    errors: int
    warnings: int
    underived: str


def style_names() -> list[str]:
    """The styles that can be named without a path."""
    return sorted(path.stem for path in STYLES.glob(f"*{SUFFIX}"))


def find_rules(name: str) -> Path:
    """The rule file that is meant by a path, by a package of rules, or by the name of a style."""
    path = Path(name)
    if path.suffix.lower() == PACKAGE:
        return unpacked(path)
    if os.path.lexists(path):
        return path
    styles = style_names()
    if name in styles or path in {Path(STYLES.name, f"{style}{SUFFIX}") for style in styles}:
        return STYLES / f"{path.stem}{SUFFIX}"
    if path.suffix or os.path.dirname(name):
        raise InputError(name, "does not exist", "Check its name.")
    near = difflib.get_close_matches(name, styles, n=1)
    hint = f"Did you mean `{near[0]}`?" if near else f"Styles: {', '.join(styles)}."
    raise InputError(name, "is neither a file nor a style", hint)


def read_rules(
    path: Path, project: Path | None = None, libraries: Sequence[Path] = ()
) -> RuleFiles:
    """The file and all that it imports, as far as it is there; checking names what is missing.

    project: the folder that the file belongs to; found by itself where it is None. libraries:
    folders beside it in which imports and assets are looked for, too.
    """
    main = os.path.normpath(path).replace(os.sep, "/")
    search = search_path(path, project, libraries)
    files: dict[str, str] = {}
    notes: list[str] = []
    imports: dict[str, list[str]] = {}
    open_names = [main]
    while open_names:
        importer = open_names.pop(0)
        text, encoding = _read(Path(importer))
        if encoding is not None:
            notes.append(f"{importer}: is not UTF-8, and was read as {encoding}")
        files[importer] = text
        for written in _core.grammar_imports(text):
            name = _imported(importer, written, search)
            full = len(files) + len(open_names) >= MAX_FILES
            if name is not None:
                imports.setdefault(importer, []).append(name)
            if name is None or name in files or name in open_names or full:
                continue
            open_names.append(name)
    own = with_own_files(Path(main), files, search, imports)
    return RuleFiles(path, own, with_folders(search, files), tuple(notes))


def with_start(rules: RuleFiles, start: str | None) -> tuple[RuleFiles, str | None]:
    """A start rule that is called with arguments, `Lot(9)`, as a rule of its own; its name.

    It is written behind the last line of the main file. InputError where it is no call.
    """
    if start is None or "(" not in start:
        return rules, start
    call = _CALL.fullmatch(start.strip())
    if call is None:
        fault = "is no rule with arguments"
        raise InputError(f"--start {start}", fault, 'Write --start "Lot(9)".')
    takes = sorted({head for _, text in rules.files for head in _HEAD.findall(text)})
    if call[1].rsplit(".", 1)[-1] not in takes:
        fault = f"is no rule of {rules.path.name} that takes arguments"
        hint = f"It has: {', '.join(takes[:12])}." if takes else "It has none."
        raise InputError(f"--start {start}", fault, hint)
    (main, text), *others = rules.files
    name = CALLED
    while name in text:
        name += "_"
    files = ((main, f"{text}\n\n{name} --> {start.strip()}\n"), *others)
    return replace(rules, files=files), name


def _imported(importer: str, written: str, search: SearchPath) -> str | None:
    """The file that an import statement names, as a name of it; None where there is none."""
    plain = written.replace("\\", "/")
    own = Path(importer).parent / plain
    brought = [STYLES.parent / plain] if plain.startswith(f"{STYLES.name}/") else []
    if _is_of_styles(Path(importer)):
        brought.append(own)
    found = (path for path in (own, *search.candidates(plain)) if search.holds(path))
    of_styles = (path for path in brought if _is_of_styles(path))
    path = next(chain(found, of_styles), None)
    return None if path is None else os.path.normpath(path).replace(os.sep, "/")


def check_rules(rules: RuleFiles, start: str | None = None) -> Verdict:
    """What is wrong with the files, for derivations that begin with the rule `start`."""
    return Verdict(*_core.grammar_check(list(rules.files), start))


def compile_rules(
    rules: RuleFiles, style: str | None = None, start: str | None = None
) -> _core.GrammarRules:
    """The rules ready to derive in a style; InputError with all faults where they cannot.

    start: the rule that derivations begin with, where it is known.
    """
    files = list(rules.files)
    try:
        compiled = _core.GrammarRules(files, None, start)
        if style is None:
            return compiled
        if style not in compiled.styles:
            near = difflib.get_close_matches(style, compiled.styles, n=1)
            known = ", ".join(compiled.styles[:12])
            hint = f"Did you mean `{near[0]}`?" if near else f"It has: {known}."
            raise InputError(f"--style {style}", f"is no style of {rules.path.name}", hint)
        return _core.GrammarRules(files, style, start)
    except _core.GrammarFault as fault:
        raise InputError(
            rules.path,
            f"has faults\n{str(fault).rstrip()}\nNothing can be derived from it",
            "Mend these first.",
        ) from fault


def begins_nothing(rules: RuleFiles, compiled: _core.GrammarRules) -> bool:
    """Whether all rules of the main file take arguments, as those of libraries do, or it has none.

    The first of them stands for its start rule then, and cannot be derived as it is. A file with
    nothing in it is no library.
    """
    main = _COMMENT.sub("", rules.files[0][1])
    if not main.strip():
        return False
    taking, plain = set(_HEAD.findall(main)), set(_PLAIN_HEAD.findall(main))
    return all(name in taking and name not in plain for name in compiled.starts)


def read_text(path: Path) -> str:
    """The text of a rule file; InputError where it is none."""
    return _read(path)[0]


def _read(path: Path) -> tuple[str, str | None]:
    """The text, and its encoding where that is not UTF-8."""
    try:
        require_file(path, MAX_BYTES)
        content = path.read_bytes()
    except FileNotFoundError as error:
        raise InputError(path, "does not exist", "Check its name.") from error
    except OSError as error:
        raise InputError(
            path, f"cannot be read ({error.strerror})", "Check its permissions."
        ) from error
    if b"\0" in content and not content.startswith((b"\xff\xfe", b"\xfe\xff")):
        line = content[: content.index(0)].count(b"\n") + 1
        raise InputError(path, f"is no text (line {line})", "Name a rule file (.cga).")
    return decoded(content)


def _is_of_styles(path: Path) -> bool:
    """Whether it is a file of the styles that Veduta brings along."""
    real = str(real_path(path))
    return os.path.isfile(real) and real.startswith(str(real_path(STYLES)) + os.sep)
