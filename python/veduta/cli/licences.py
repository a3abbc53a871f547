"""`veduta --licences`: what Veduta is made with, and under which licences."""

from __future__ import annotations

from collections.abc import Iterator
from importlib import metadata
from pathlib import Path

OWN = "veduta"
STUDIO = Path(__file__).resolve().parents[1] / "studio" / "static" / "licences.txt"
NOTES = {
    "ifcopenshell": "writes the IFC files of `veduta plan`; LGPL: it is used as it is, and may be"
    " replaced by another version; its wheels bring Open CASCADE (LGPL 2.1 with an exception), GMP"
    " and MPFR (LGPL), modules made with CGAL (LGPL and GPL; Veduta loads none of them),"
    " OpenCOLLADA, RocksDB, libxml2, PCRE, Boost, Manifold and wgpu",
    "pi-heif": "reads HEIC; its wheels bring libheif and libde265 (LGPL)",
    "pyogrio": "its wheels bring GDAL, GEOS, PROJ and SQLite",
    "rasterio": "its wheels bring GDAL, PROJ and others",
    "opencv-contrib-python-headless": "its wheels bring FFmpeg (LGPL) and others",
}


def licences() -> str:
    """A line for each package that is installed with Veduta, and the notices of the studio."""
    lines = ["Veduta is Apache-2.0. It is made with these works of others:", ""]
    rows = sorted(_needed(), key=lambda row: row[0].lower())
    width = max((len(f"{name} {version}") for name, version, _ in rows), default=0)
    for name, version, licence in rows:
        note = f" - {NOTES[name.lower()]}" if name.lower() in NOTES else ""
        lines.append(f"{f'{name} {version}':<{width}}  {licence}{note}")
    lines += ["", "Their texts lie beside each package (`*.dist-info`).", ""]
    if STUDIO.is_file():
        lines.append(STUDIO.read_text("utf-8"))
    return "\n".join(lines)


def _needed() -> Iterator[tuple[str, str, str]]:
    """Name, version and licence of what Veduta needs, and what that needs in its turn."""
    waiting, seen = [OWN], {OWN}
    while waiting:
        for wanted in _requires(waiting.pop()):
            key = wanted.lower().replace("_", "-")
            if key in seen:
                continue
            seen.add(key)
            try:
                found = metadata.distribution(wanted)
            except metadata.PackageNotFoundError:
                continue
            waiting.append(wanted)
            yield found.metadata["Name"], found.version, _licence(found)


def _requires(name: str) -> list[str]:
    """Names of what a package needs; what only an extra needs is left out."""
    try:
        told = metadata.requires(name) or []
    except metadata.PackageNotFoundError:
        return []
    plain = [line.partition(";") for line in told]
    needed = [head for head, _, condition in plain if "extra ==" not in condition.replace("'", '"')]
    return [_name(head) for head in needed]


def _name(requirement: str) -> str:
    end = next(
        (at for at, letter in enumerate(requirement) if not (letter.isalnum() or letter in "-_.")),
        len(requirement),
    )
    return requirement[:end]


def _licence(found: metadata.Distribution) -> str:
    """As the package says it: an SPDX expression, a classifier, or the first line of a text."""
    told = found.metadata
    if told["License-Expression"]:
        return str(told["License-Expression"])
    classifiers = [
        line.rpartition(" :: ")[2]
        for line in told.get_all("Classifier") or []
        if line.startswith("License ::")
    ]
    if classifiers:
        return ", ".join(classifiers)
    text = str(told["License"] or "").strip()
    return text.splitlines()[0][:80] if text else "see its files"
