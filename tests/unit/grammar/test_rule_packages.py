"""Rule packages: unpacked where they hold sources, refused with the reason otherwise."""

from __future__ import annotations

import zipfile
from pathlib import Path

import pytest

from veduta.grammar.deriving import deriver
from veduta.grammar.one_lot import plain_lot
from veduta.grammar.options import GrammarOptions
from veduta.grammar.rules import find_rules, read_rules
from veduta.run.errors import InputError

WEDGE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 1 3 4\n"
MAIN = 'import P : "parts/p.cga"\n@StartRule\nLot --> P.Body'
PART = 'Body --> extrude(4) i("mod/wedge.obj") report("wedges", 1) A.'


def package(path: Path, files: dict[str, str]) -> Path:
    with zipfile.ZipFile(path, "w") as archive:
        for name, text in files.items():
            archive.writestr(name, text)
    return path


def test_a_package_derives_with_its_imports_and_assets(tmp_path: Path) -> None:
    path = package(
        tmp_path / "house.rpk",
        {
            "rules/main.cga": MAIN,
            "rules/parts/p.cga": PART,
            "rules/another.cga": "Other --> NIL",
            "assets/mod/wedge.obj": WEDGE,
        },
    )
    main = find_rules(str(path))
    assert main.name == "main.cga"
    rules = read_rules(main)
    made = deriver(rules.files, rules.search, GrammarOptions())
    built = made.together([plain_lot()], 2.0)
    assert dict(built.reports(0)) == {"wedges": 1.0}
    assert not made.library.missing
    assert find_rules(str(path)) == main


def test_the_rule_file_that_is_called_as_the_package_is_the_main_one(tmp_path: Path) -> None:
    files = {"rules/a.cga": "@StartRule\nA --> NIL", "rules/Town.cga": "Lot --> NIL"}
    assert find_rules(str(package(tmp_path / "town.rpk", files))).name == "Town.cga"


@pytest.mark.parametrize(
    ("files", "fault"),
    [
        ({"bin/rules/a.cgb": "x"}, "compiled rules alone"),
        ({"readme.txt": "x"}, "holds no rules"),
        ({"../a.cga": "Lot --> NIL"}, "outside of it"),
        ({"/etc/a.cga": "Lot --> NIL"}, "outside of it"),
        ({"C:/a.cga": "Lot --> NIL"}, "outside of it"),
    ],
)
def test_packages_without_sources_or_with_paths_out_of_them(
    tmp_path: Path, files: dict[str, str], fault: str
) -> None:
    path = package(tmp_path / "p.rpk", files)
    with pytest.raises(InputError, match=fault) as told:
        find_rules(str(path))
    assert str(path) in str(told.value)
    assert sorted(one.name for one in tmp_path.iterdir()) == ["p.rpk"]


def test_what_is_no_package(tmp_path: Path) -> None:
    seven, broken = tmp_path / "seven.rpk", tmp_path / "broken.rpk"
    seven.write_bytes(b"7z\xbc\xaf\x27\x1c" + bytes(40))
    broken.write_bytes(b"PK\x03\x04 and no more")
    with pytest.raises(InputError, match="packed by 7z") as told:
        find_rules(str(seven))
    assert "7-Zip" in str(told.value)
    with pytest.raises(InputError, match="no rule package that can be read"):
        find_rules(str(broken))
    with pytest.raises(InputError, match="does not exist"):
        find_rules(str(tmp_path / "none.rpk"))


def test_a_package_that_was_shared_anew_is_read_anew(tmp_path: Path) -> None:
    path = package(tmp_path / "a.rpk", {"rules/one.cga": "Lot --> NIL"})
    assert find_rules(str(path)).name == "one.cga"
    package(path, {"rules/another.cga": "Lot --> NIL", "readme.txt": "longer than before"})
    assert find_rules(str(path)).name == "another.cga"


def test_a_damaged_package_is_named(tmp_path: Path) -> None:
    path = package(tmp_path / "a.rpk", {"rules/one.cga": "Lot --> NIL\n" * 400})
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("rules/one.cga", "Lot --> NIL\n" * 400)
    data = bytearray(path.read_bytes())
    start = data.index(b"rules/one.cga") + len(b"rules/one.cga")
    data[start : start + 12] = b"\xff" * 12
    path.write_bytes(bytes(data))
    with pytest.raises(InputError, match=r"a\.rpk"):
        find_rules(str(path))


def test_a_file_where_a_folder_should_be_is_named(tmp_path: Path) -> None:
    path = package(tmp_path / "a.rpk", {"rules": "x", "rules/one.cga": "Lot --> NIL"})
    with pytest.raises(InputError, match=r"a\.rpk"):
        find_rules(str(path))


def test_names_of_files_that_cannot_be_read_are_named(tmp_path: Path) -> None:
    """One without letters, and one whose letters are no UTF-8 in a single of its two places."""
    nameless = package(tmp_path / "b.rpk", {"QQ": "Lot --> NIL"})
    nameless.write_bytes(nameless.read_bytes().replace(b"QQ", b"\0Q"))
    with pytest.raises(InputError, match="a file without a name"):
        find_rules(str(nameless))
    path = package(tmp_path / "c.rpk", {"rules/äb.cga": "Lot --> NIL"})
    data = path.read_bytes()
    name = "rules/äb.cga".encode()
    path.write_bytes(data.replace(name, name.replace(b"\xa4", b"\xff"), 1))
    with pytest.raises(InputError, match=r"c\.rpk.*no rule package that can be read"):
        find_rules(str(path))
