"""Rule files: where they are, what they may import, how they are laid out."""

from __future__ import annotations

import os
import re
from pathlib import Path

import pytest

from veduta import _core
from veduta.grammar.derivation import derive, parse
from veduta.grammar.layout import formatted, write_formatted
from veduta.grammar.rules import (
    check_rules,
    compile_rules,
    find_rules,
    read_rules,
    style_names,
    with_start,
)
from veduta.run.errors import InputError


def write(folder: Path, **files: str) -> Path:
    for name, text in files.items():
        path = folder / f"{name.replace('__', '/')}.cga"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return folder / "main.cga"


def test_imports_are_read_from_the_folder_and_below(tmp_path: Path) -> None:
    main = write(
        tmp_path,
        main='import a : "lib/a.cga"\nLot --> a.A',
        lib__a='import b : "../b.cga"\nA --> b.B',
        b="B --> NIL",
    )
    rules = read_rules(main)
    assert [name for name, _ in rules.texts] == ["main.cga", "lib/a.cga", "b.cga"]
    assert check_rules(rules).told == ""
    compile_rules(rules)


def test_imports_stay_in_the_folder(tmp_path: Path) -> None:
    secret = tmp_path / "secret.cga"
    secret.write_text("B --> NIL")
    folder = tmp_path / "rules"
    for path in ("../secret.cga", str(secret), "sub/../../secret.cga", "link.cga", "none.cga"):
        main = write(folder, main=f'import b : "{path}"\nLot --> b.B')
        if not os.path.lexists(folder / "link.cga"):
            (folder / "link.cga").symlink_to(secret)
        rules = read_rules(main)
        assert len(rules.files) == 1
        assert "cannot import" in check_rules(rules).told


def test_a_fault_while_deriving_names_its_file_and_place(tmp_path: Path) -> None:
    """Also where the rule is in a file that is imported."""
    lot = [[(0.0, 0.0, 0.0), (9.0, 0.0, 0.0), (9.0, 9.0, 0.0)]]
    bad = "split(x) { { 0.0000001 : B. }* }"
    alone = compile_rules(read_rules(write(tmp_path, main=f"\nLot --> {bad}")))
    (told,) = alone.derive([lot], [0])
    assert str(told).startswith(f"{tmp_path}/main.cga:2:9: ")
    main = write(tmp_path, main='import a : "a.cga"\nLot --> a.A', a=f"A --> {bad}")
    (told,) = compile_rules(read_rules(main)).derive([lot], [0])
    assert str(told).startswith(f"{tmp_path}/a.cga:1:7: ")


def test_faults_are_shown_with_their_line(tmp_path: Path) -> None:
    verdict = check_rules(read_rules(write(tmp_path, main="Lot --> extrud(3)\n")))
    assert (verdict.errors, verdict.warnings) == (1, 0)
    assert f"{tmp_path}/main.cga:1:9: error" in verdict.told
    assert "^^^^^^" in verdict.told
    assert "extrude" in verdict.told


def test_what_does_not_derive_is_no_error_of_the_file(tmp_path: Path) -> None:
    rules = read_rules(write(tmp_path, main="Lot --> softenNormals(3)"))
    verdict = check_rules(rules)
    assert (verdict.errors, "softenNormals" in verdict.underived) == (0, True)
    compiled = compile_rules(rules)
    assert "`softenNormals` does not derive: the shape stays as it is" in compiled.notes


def test_a_style_needs_no_path_and_a_slip_is_helped() -> None:
    assert find_rules("haussmann").is_file()
    assert find_rules("styles/haussmann.cga") == find_rules("haussmann")
    with pytest.raises(InputError, match="Did you mean `haussmann`"):
        find_rules("hausmann")
    with pytest.raises(InputError, match="does not exist"):
        find_rules("rules/none.cga")


@pytest.mark.parametrize("name", style_names())
def test_styles_are_sound_and_laid_out(name: str) -> None:
    path = find_rules(name)
    verdict = check_rules(read_rules(path))
    assert (verdict.told, verdict.underived) == ("", "")
    assert formatted(path)[1] is False


def test_formatting_rewrites_what_differs(tmp_path: Path) -> None:
    main = write(tmp_path, main="Lot-->extrude( 3 )  A // high\nA-->NIL\n")
    assert write_formatted(main) is True
    text = main.read_text()
    assert text == "Lot --> extrude(3) A // high\nA --> NIL\n"
    stamp = main.stat().st_mtime_ns
    assert write_formatted(main) is False
    assert main.stat().st_mtime_ns == stamp


def test_formatting_leaves_a_faulty_file_alone(tmp_path: Path) -> None:
    main = write(tmp_path, main="Lot --> extrude(")
    with pytest.raises(InputError, match="cannot be formatted"):
        write_formatted(main)
    assert main.read_text() == "Lot --> extrude("


def test_what_is_no_text_is_refused(tmp_path: Path) -> None:
    (tmp_path / "a.cga").write_bytes(b"Lot --> NIL\n\0\1\2")
    with pytest.raises(InputError, match=r"is no text \(line 2\)"):
        read_rules(tmp_path / "a.cga")
    with pytest.raises(InputError, match="is a folder"):
        read_rules(tmp_path)


def test_the_first_rule_file_of_the_docs_makes_a_house(repository: Path, tmp_path: Path) -> None:
    page = (repository / "docs" / "grammar.md").read_text("utf-8")
    text, *others = re.findall(r"^```cga\n(.*?)^```", page, re.MULTILINE | re.DOTALL)
    for number, other in enumerate(others):
        assert check_rules(read_rules(write(tmp_path / str(number), main=other))).told == ""
    rules = read_rules(write(tmp_path, main=text))
    assert check_rules(rules).told == ""
    lot = [[(0.0, 0.0, 0.0), (10.0, 0.0, 0.0), (10.0, 8.0, 0.0), (0.0, 8.0, 0.0)]]
    (house,) = compile_rules(rules).derive([lot], [0], attributes=[{"height": 12.0}])
    assert not isinstance(house, str)
    assert {"window", "wall", "roof"} == set(house.feature_class)
    assert house.positions_m[:, 2].max() == pytest.approx(14.0)


def test_the_language_page_says_what_derives(repository: Path) -> None:
    """Each operation of the engine has a `yes` in the table, and no other operation has one."""
    page = (repository / "docs" / "grammar-language.md").read_text("utf-8")
    rows = re.findall(r"^\| `(\w+)` \|.*\|([^|]*)\|$", page, re.MULTILINE)
    said = {name for name, derives in rows if derives.strip().startswith("yes")}
    assert said == set(_core.grammar_operations())


def test_a_start_rule_with_arguments_is_called_by_one_of_its_own(tmp_path: Path) -> None:
    text = "CalledFirst --> NIL\nLot(h, name) --> extrude(h) Mass(name)\nMass(n) --> X."
    main = write(tmp_path, main=text)
    rules, name = with_start(read_rules(main), 'Lot(2 * 4.5, "a")')
    assert name == "CalledFirst_"
    compile_rules(rules)
    (_, whole), *_ = rules.files
    built = derive(parse(whole), [[(0, 0), (6, 0), (6, 4), (0, 4)]], start=name)
    z = built.place().parts["building"].triangles()[0][:, 2]
    assert z.max() - z.min() == pytest.approx(9.0)
    plain = read_rules(main)
    assert with_start(plain, "Lot") == (plain, "Lot")
    assert with_start(plain, None) == (plain, None)


@pytest.mark.parametrize(
    ("start", "fault", "remedy"),
    [
        ("Lott(9)", "no rule of main.cga that takes arguments", "It has: Lot"),
        ("Lot(9", "is no rule with arguments", 'Write --start "Lot(9)"'),
        ("Lot(9) X\nY(1)", "is no rule with arguments", "Write"),
        ("Mass(1)", "no rule of main.cga that takes arguments", "It has: Lot"),
    ],
)
def test_a_start_that_cannot_be_called(start: str, fault: str, remedy: str, tmp_path: Path) -> None:
    main = write(tmp_path, main="Lot(h) --> extrude(h) Mass\nMass --> X.")
    with pytest.raises(InputError) as told:
        with_start(read_rules(main), start)
    assert fault in told.value.fault
    assert remedy in told.value.remedy
