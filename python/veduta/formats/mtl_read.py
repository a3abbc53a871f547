"""The materials of Wavefront MTL files: diffuse colours, and the pictures that lie on faces.

https://paulbourke.net/dataformats/mtl/ - `Kd` and `map_Kd` with its options; of these `-s` and `-o`
change where a picture lies, the others how it is filtered.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

from veduta.place.material import Colour

_VALUES = {
    "-blendu": 1, "-blendv": 1, "-bm": 1, "-boost": 1, "-cc": 1, "-clamp": 1, "-imfchan": 1,
    "-mm": 2, "-texres": 1, "-type": 1,
}  # fmt: skip
"""How many words follow each option; up to three numbers follow `-s`, `-o` and `-t`."""
_VECTORS = {"-s": 1.0, "-o": 0.0, "-t": 0.0}
"""What those have that are not given."""
_MOST = 3


@dataclass(frozen=True)
class MtlMaterial:
    """Colour (sRGB, 0..1), and the picture as the file names it; None where it has none.

    A point at (u, v) of the model lies at `stretch` times that plus `shift` of the picture.
    """

    colour: Colour | None = None
    picture: str | None = None
    stretch: tuple[float, float] = (1.0, 1.0)
    shift: tuple[float, float] = (0.0, 0.0)


def read_mtl(lines: Iterable[str]) -> dict[str, MtlMaterial]:
    """The materials by their names; ValueError where a colour is no colour."""
    found: dict[str, MtlMaterial] = {}
    name = ""
    for line in lines:
        word, _, rest = line.strip().replace("\t", " ").partition(" ")
        if word == "newmtl":
            name = rest.strip()
            found[name] = MtlMaterial()
        elif word == "Kd" and name:
            red, green, blue = (min(max(float(part), 0.0), 1.0) for part in rest.split()[:3])
            found[name] = replace(found[name], colour=(red, green, blue))
        elif word.lower() == "map_kd" and name:
            found[name] = _pictured(found[name], rest.strip())
    return {name: _seen(material) for name, material in found.items()}


def _seen(material: MtlMaterial) -> MtlMaterial:
    """Black that multiplies a picture would hide it: programs write it for "no colour"."""
    if material.picture is not None and material.colour == (0.0, 0.0, 0.0):
        return replace(material, colour=None)
    return material


def _pictured(material: MtlMaterial, text: str) -> MtlMaterial:
    """With the picture of a `map_Kd`: its options, then a name, which may have spaces."""
    vectors = {name: [start] * _MOST for name, start in _VECTORS.items()}
    while text.startswith("-"):
        option, _, rest = text.partition(" ")
        rest = rest.lstrip()
        if option in _VECTORS:
            for place in range(_MOST):
                word, _, after = rest.partition(" ")
                number = _number(word)
                if number is None:
                    break
                vectors[option][place] = number
                rest = after.lstrip()
        elif option in _VALUES:
            for _ in range(_VALUES[option]):
                rest = rest.partition(" ")[2].lstrip()
        else:
            break
        text = rest
    if not text:
        return material
    stretch, shift = vectors["-s"], vectors["-o"]
    return replace(
        material, picture=text, stretch=(stretch[0], stretch[1]), shift=(shift[0], shift[1])
    )


def _number(word: str) -> float | None:
    try:
        number = float(word)
    except ValueError:
        return None
    return number if abs(number) < 1e6 else None
