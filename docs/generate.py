"""Writes the tables and schemas of the docs that follow from the code: `python docs/generate.py`.

A table stands between `<!-- NAME -->` and `<!-- /NAME -->` in a page. With `--check` nothing is
written, and the exit code is 1 when a page is out of date.
"""

from __future__ import annotations

import dataclasses
import functools
import json
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Annotated, Any, get_args, get_origin, get_type_hints

import tyro
from library_pages import classes_text, formats_rows, functions_text, rules_text
from pydantic import BaseModel
from style_tables import attribute_rows

from veduta.cli.carve_call import CarveCall
from veduta.cli.demo_call import DemoCall
from veduta.cli.dense_call import DenseCall
from veduta.cli.drive_call import DriveCall
from veduta.cli.facade_call import FacadeCall
from veduta.cli.fauna_call import FaunaCall
from veduta.cli.grammar_call import DeriveCall, SampleCall, TreeCall
from veduta.cli.photos_call import PhotosCall
from veduta.cli.plan_call import PlanCall
from veduta.drive.document.log import DriveLog
from veduta.drive.document.model import DriveDocument
from veduta.facade.cleared import BEFORE_COLOURS, KINDS
from veduta.facade.document import CLASSES
from veduta.facade.outputs import COLOURS
from veduta.facade.report import FILES
from veduta.grammar.assets.catalogue import LEVELS, builtin, builtin_names, described
from veduta.grammar.rules import style_names
from veduta.grammar.surfaces.catalogue import PREFIX, SURFACES
from veduta.photos.report import FILES as PHOTOS_FILES
from veduta.plan.document import TYPES_OF, Opening, Room
from veduta.plan.report import FILES as PLAN_FILES
from veduta.run.options import declared_options, flag

DOCS = Path(__file__).parent
_BOUNDS = {
    "exclusiveMinimum": "> {}",
    "minimum": ">= {}",
    "exclusiveMaximum": "< {}",
    "maximum": "<= {}",
}
POSITIONAL = get_args(tyro.conf.Positional[str])[1]
_KINDS = {"number": "number", "integer": "integer", "boolean": "flag", "string": "text"}


def options_table(call: type[Any]) -> str:
    """All options of a verb's argument class: its own, and those of its option models."""
    rows: list[Sequence[str]] = []
    for name, annotation in get_type_hints(call, include_extras=True).items():
        kind = get_args(annotation)[0] if get_origin(annotation) is Annotated else annotation
        if isinstance(kind, type) and issubclass(kind, BaseModel):
            rows += _model_rows(kind)
        else:
            rows.append(_argument_row(call, name, annotation))
    return table(("option", "takes", "default", "what it is"), rows)


def _model_rows(model: type[BaseModel]) -> list[Sequence[str]]:
    """A row per field."""
    rows: list[Sequence[str]] = []
    for option in declared_options(model):
        shown, word = f"`{option.default}`", option.flag
        if option.default is True:
            shown, word = "on", flag(f"no_{option.name}")
        elif option.default in (None, False):
            shown = ""
        rows.append((f"`{word}`", _takes(option.value), shown, option.description))
    return rows


def _takes(schema: dict[str, Any]) -> str:
    if schema.get("type") == "array":
        return f"{schema['minItems']} numbers"
    if schema.get("format") == "path":
        return "file"
    if "enum" in schema:
        return _listed(schema["enum"])
    bounds = [text.format(schema[key]) for key, text in _BOUNDS.items() if key in schema]
    return " ".join([_KINDS[schema["type"]], ", ".join(bounds)]).strip()


def _argument_row(call: type[Any], name: str, annotation: Any) -> Sequence[str]:
    """A row for an argument that is declared with `tyro.conf.arg`."""
    settings = next(part for part in annotation.__metadata__ if getattr(part, "help", None))
    default = next(field.default for field in dataclasses.fields(call) if field.name == name)
    required = default is dataclasses.MISSING
    flags = ", ".join(f"`{word}`" for word in (*(settings.aliases or ()), flag(name)))
    if POSITIONAL in annotation.__metadata__:
        flags = f"`{settings.metavar}`"
    takes = "flag" if default is False else settings.metavar.removesuffix("...")
    shown = (
        "" if default in (None, False, ()) or settings.help_behavior_hint == "" else f"`{default}`"
    )
    return flags, takes, "required" if required else shown, settings.help


def files_table(files: Sequence[tuple[str, str]]) -> str:
    """The files of one result, and its reports."""
    reports = (
        ("report.json", "steps, times, counts, measures, what was rejected and why"),
        ("report.html", "the same with pictures, in one file"),
    )
    return table(("file", "what it is"), [(f"`{name}`", text) for name, text in (*files, *reports)])


def before_table() -> str:
    """What may stand before a front, with its colour in `before.png`."""
    rows = [
        (str(index), name, "#{:02x}{:02x}{:02x}".format(*BEFORE_COLOURS[index]))
        for index, name in enumerate(KINDS)
    ]
    return table(("index", "what stands there", "colour"), rows)


def classes_table() -> str:
    """The label of each class and its colour."""
    rows = [
        (str(index), name, "#{:02x}{:02x}{:02x}".format(*COLOURS[name]))
        for index, name in enumerate(CLASSES)
    ]
    return table(("label", "class", "colour"), rows)


def assets_table() -> str:
    """What Veduta brings along for `i`, with its size and triangles by level of detail."""
    rows = []
    for name in builtin_names():
        levels = [builtin(f"{name}@{level}") for level in range(LEVELS)]
        assets = [asset for asset in levels if asset is not None]
        low, high = assets[0].box_m
        size = " x ".join(f"{side:.2f}" for side in (high - low).tolist())
        triangles = " / ".join(str(len(asset.shared_mesh.indices)) for asset in assets)
        parts = ", ".join(slot.name for slot in assets[0].slots)
        rows.append((f"`{name}`", described(name), size, parts, triangles))
    return table(("name", "what it is", "x, y, z (m)", "parts", "triangles"), rows)


def textures_table() -> str:
    """What Veduta brings along for `texture`, with its size and mean colour."""
    rows = []
    for name, surface in SURFACES.items():
        width, height = surface.size_m
        mean = "#" + "".join(f"{round(255 * channel):02x}" for channel in surface.mean)
        rows.append((f"`{PREFIX}{name}`", surface.told, f"{width:.2f} x {height:.2f}", mean))
    return table(("name", "what it is", "width x height (m)", "mean"), rows)


def attributes_table(style: str) -> str:
    """What a style takes, group by group."""
    return table(("attribute", "takes", "default", "what it is"), attribute_rows(style))


def table(columns: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A markdown table."""
    lines = [columns, ["---"] * len(columns), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def plan_values_table() -> str:
    """The words that fields of a plan.json take."""
    opening, room = Opening.model_fields, Room.model_fields
    types = "; ".join(f"of a {kind}: {_listed(words)}" for kind, words in TYPES_OF.items())
    rows = [
        (".openings[].kind", _words(opening["kind"].annotation)),
        (".openings[].type", types),
        (".openings[].hinge", _words(opening["hinge"].annotation)),
        (".openings[].swing", _words(opening["swing"].annotation)),
        (".rooms[].use", _words(room["use"].annotation)),
    ]
    return table(("field", "takes"), [(f"`{name}`", words) for name, words in rows])


def formats_table() -> str:
    """All formats that places are written in."""
    columns = ("ending", "`--to`", "what it is", "what it has no word for", "is read")
    return table(columns, formats_rows())


def _words(literal: Any) -> str:
    return _listed(get_args(literal))


def _listed(words: Sequence[str]) -> str:
    return ", ".join(f"`{word}`" for word in words)


TABLES: dict[str, dict[str, Callable[[], str]]] = {
    "assets.md": {"assets": assets_table},
    "demo.md": {"options": lambda: options_table(DemoCall)},
    "carve.md": {"options": lambda: options_table(CarveCall)},
    "dense.md": {"options": lambda: options_table(DenseCall)},
    "drive.md": {"options": lambda: options_table(DriveCall)},
    "facade.md": {
        "options": lambda: options_table(FacadeCall),
        "files": lambda: files_table(FILES),
        "classes": classes_table,
        "before": before_table,
    },
    "fauna.md": {"options": lambda: options_table(FaunaCall)},
    "grammar.md": {
        "options": lambda: options_table(DeriveCall),
        "sample": lambda: options_table(SampleCall),
        "tree": lambda: options_table(TreeCall),
    },
    "photos.md": {
        "options": lambda: options_table(PhotosCall),
        "files": lambda: files_table(PHOTOS_FILES),
    },
    "library.md": {"functions": functions_text, "classes": classes_text, "rules": rules_text},
    "formats.md": {"formats": formats_table},
    "plan.md": {
        "options": lambda: options_table(PlanCall),
        "files": lambda: files_table(PLAN_FILES),
        "values": plan_values_table,
    },
    "textures.md": {"textures": textures_table},
    "styles.md": {name: functools.partial(attributes_table, name) for name in style_names()},
}


SCHEMAS: dict[str, type[BaseModel]] = {
    "schemas/drive-toml.schema.json": DriveLog,
    "schemas/drive.schema.json": DriveDocument,
}


def schema_text(model: type[BaseModel]) -> str:
    """The JSON schema of what a file may hold."""
    dialect = {"$schema": "https://json-schema.org/draft/2020-12/schema"}
    return json.dumps(dialect | model.model_json_schema(by_alias=True), indent=1) + "\n"


def generated(page: str, text: str) -> str:
    """The text of a page with its tables made anew."""
    for name, make in TABLES[page].items():
        start, end = f"<!-- {name} -->\n", f"<!-- /{name} -->"
        before, found, rest = text.partition(start)
        _, closed, after = rest.partition(end)
        if not (found and closed):
            raise SystemExit(f"{page}: has no place for the table `{name}`")
        text = f"{before}{start}{make()}\n{end}{after}"
    return text


def main(arguments: Sequence[str]) -> int:
    """Bring all pages up to date, or say which are not."""
    stale = []
    for page in (*TABLES, *SCHEMAS):
        path = DOCS / page
        text = path.read_text("utf-8") if path.exists() else ""
        made = schema_text(SCHEMAS[page]) if page in SCHEMAS else generated(page, text)
        if made != text:
            stale.append(page)
            if "--check" not in arguments:
                path.write_text(made, "utf-8")
    if stale:
        verb = "is out of date" if "--check" in arguments else "was brought up to date"
        print("\n".join(f"{page} {verb}" for page in stale))
    return 1 if stale and "--check" in arguments else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
