"""Rule files anywhere may import the styles that Veduta brings along, and their parts."""

from __future__ import annotations

from pathlib import Path

import pytest

from veduta.grammar.derivation import derive, parse
from veduta.run.errors import InputError

LOT = [[(0.0, 0.0), (14.0, 0.0), (14.0, 12.0), (0.0, 12.0)]]


def written(folder: Path, text: str) -> Path:
    path = folder / "mine.cga"
    path.write_text(text)
    return path


def test_a_style_with_its_attributes_set(tmp_path: Path) -> None:
    path = written(
        tmp_path, 'import house : "styles/haussmann.cga" (storeys = 3)\nLot --> house.Lot\n'
    )
    here = derive(parse(path), LOT, seed=4).part().bounds_m
    own = derive(parse("haussmann"), LOT, seed=4, attributes={"storeys": 3.0}).part().bounds_m
    assert here[1][2] == pytest.approx(own[1][2], abs=0.5)  # heights of floors are drawn


def test_a_part_of_the_styles_with_what_it_imports_itself(tmp_path: Path) -> None:
    path = written(
        tmp_path,
        'import openings : "styles/parts/openings.cga"\n'
        'Lot --> openings.OpeningDoor(0.2, "#442211")\n',
    )
    assert len(derive(parse(path), LOT)) > 2


def test_a_file_of_the_own_folder_goes_before(tmp_path: Path) -> None:
    (tmp_path / "styles").mkdir()
    (tmp_path / "styles/haussmann.cga").write_text("Lot --> extrude(7)\n")
    path = written(tmp_path, 'import house : "styles/haussmann.cga"\nLot --> house.Lot\n')
    assert derive(parse(path), LOT).part().bounds_m[1][2] == pytest.approx(7.0)


@pytest.mark.parametrize("name", ["styles/baroque.cga", "styles/../rules.py", "haussmann.cga"])
def test_what_is_no_style_is_not_there(tmp_path: Path, name: str) -> None:
    path = written(tmp_path, f'import house : "{name}"\nLot --> house.Lot\n')
    with pytest.raises(InputError, match="it is not there"):
        parse(path)
