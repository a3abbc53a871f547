"""The command `veduta plan`: a document becomes a house; what lies in OUT, and what stays."""

from __future__ import annotations

import json
from pathlib import Path

import pypdfium2
import pytest
from drawn_dxf import saved, two_rooms
from PIL import Image
from sample_plan import sample_plan
from test_validators import validate_city, validate_gltf

from veduta.cli.plan import _tell as tell
from veduta.formats.place_json import read_place
from veduta.formats.tiles import contents
from veduta.plan import pipeline
from veduta.plan.options import HouseOptions, InputOptions, PlanOptions, SiteOptions
from veduta.plan.pipeline import PlanResult, run_plan
from veduta.run import beside
from veduta.run.errors import InputError
from veduta.run.progress import Progress

FILES = {
    ".veduta", "garden.glb", "ground.glb", "house.city.json", "house.glb", "house.ifc",
    "house.x3d", "overlay.png", "place.json", "plan.dxf", "plan.json", "plan.svg", "report.html",
    "report.json", "sheet-1.png", "tiles", "tileset.json", "tour.png",
}  # fmt: skip


def plan(document: Path, out: Path, *, force: bool = False, seed: int = 0) -> PlanResult:
    options = PlanOptions(house=HouseOptions(seed=seed))
    return run_plan([document], out, options, Progress(quiet=True), force=force)


@pytest.fixture
def document(tmp_path: Path) -> Path:
    path = tmp_path / "plan.json"
    path.write_text(sample_plan().model_dump_json(by_alias=True))
    return path


def test_a_document_becomes_a_house_and_an_edit_is_rebuilt(
    tmp_path: Path, document: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "out"
    made = plan(document, out)
    assert (made.exit_code, made.outdated, made.up_to_date) == (0, False, False)
    assert {path.name for path in out.iterdir()} == FILES
    assert made.measures["rooms"] == 2
    assert read_place(out / "place.json").parts[0].model == "house.glb"
    assert read_place(out / "place.json").parts[0].city_model == "house.city.json"
    assert validate_city(out / "house.city.json")["valid"] is True
    assert "tiles/house.glb" in contents(out)
    for name in ("house.glb", "ground.glb", "garden.glb", *contents(out)[1:]):
        issues = validate_gltf(out / name)
        assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), issues["messages"]
    report = json.loads((out / "report.json").read_text())
    assert (report["verb"], report["state"]) == ("plan", "done")
    assert "sheet-1.png is missing: overlay.png has a blank sheet" in report["notes"]

    assert plan(document, out).up_to_date
    before = (out / "house.glb").read_bytes()
    content = json.loads((out / "plan.json").read_text())
    content["storeys"][0]["openings"][2]["width_m"] = 2.2
    edited = json.dumps(content)
    (out / "plan.json").write_text(edited)
    again = plan(document, out)
    assert (again.up_to_date, again.outdated) == (True, True)
    assert (out / "house.glb").read_bytes() == before
    with pytest.raises(InputError, match="other inputs or options"):
        plan(document, out, seed=5)

    rebuilt = plan(out / "plan.json", out, seed=3)
    assert (rebuilt.up_to_date, rebuilt.outdated) == (False, False)
    assert [note.split()[0] for note in rebuilt.notes] == ["--seed"]
    assert rebuilt.notes[0] in json.loads((out / "report.json").read_text())["notes"]
    capsys.readouterr()
    tell(rebuilt)
    assert f"note: {rebuilt.notes[0]}" in capsys.readouterr().out
    assert (out / "plan.json").read_text() == edited
    assert (out / "house.glb").read_bytes() != before
    assert plan(out / "plan.json", out, seed=3).up_to_date


def test_north_sun_and_panorama_survive_a_rebuild(tmp_path: Path, document: Path) -> None:
    """They are kept in plan.json, the picture beside it; an option goes before what is kept."""
    out, given = tmp_path / "out", tmp_path / "mine.png"
    Image.linear_gradient("L").resize((512, 256)).convert("RGB").save(given)
    plain = HouseOptions(no_furniture=True, no_tour=True)
    where = {"north": 30.0, "place": (51.5, -0.12), "time": "2026-06-21T16:00+01:00"}

    def made(path: Path, **site: object) -> PlanResult:
        options = PlanOptions(house=plain, site=SiteOptions(**site))
        return run_plan([path], out, options, Progress(quiet=True))

    assert made(document, **where, panorama=str(given)).exit_code == 0
    names = ("panorama.glb", "panorama.jpg", "house.glb", "place.json")
    first = {name: (out / name).read_bytes() for name in names}
    issues = validate_gltf(out / "panorama.glb")
    assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), issues["messages"]
    place = read_place(out / "place.json")
    assert place.sun is not None
    assert (place.sun.time, place.sun.assumed) == ("2026-06-21T16:00:00+01:00", [])
    assert [part.id for part in place.parts if part.backdrop] == ["panorama"]

    given.unlink()
    made(out / "plan.json")
    assert {name: (out / name).read_bytes() for name in names} == first
    made(out / "plan.json", north=90.0)
    content = json.loads((out / "plan.json").read_text())
    assert (content["north_deg"], content["place_deg"]) == (90.0, [51.5, -0.12])
    assert (out / "place.json").read_bytes() != first["place.json"]

    (out / "panorama.jpg").write_bytes(first["panorama.jpg"][:600])
    with pytest.raises(InputError, match=r"panorama.jpg"):
        made(out / "plan.json")
    (out / "panorama.jpg").unlink()
    with pytest.raises(InputError, match=r"panorama.jpg: is missing"):
        made(out / "plan.json")


def test_an_edited_document_keeps_its_panorama(tmp_path: Path, document: Path) -> None:
    """A rebuild with another one, of which the document does not know, takes none away."""
    out, given = tmp_path / "out", tmp_path / "mine.png"
    Image.linear_gradient("L").resize((512, 256)).convert("RGB").save(given)
    bare = HouseOptions(no_furniture=True, no_tour=True, lights="none", surroundings="none")

    def made(**site: object) -> PlanResult:
        path = out / "plan.json" if out.exists() else document
        options = PlanOptions(house=bare, site=SiteOptions(**site))
        return run_plan([path], out, options, Progress(quiet=True))

    made(panorama=str(given))
    first = (out / "panorama.jpg").read_bytes()
    content = json.loads((out / "plan.json").read_text())
    content["storeys"][0]["rooms"][0]["name"] = "Salon"
    (out / "plan.json").write_text(json.dumps(content))

    four = ",".join(f"{name}={given}" for name in "NESW")
    told = made(panorama=four)
    assert any("does not say what --north" in note for note in told.notes)
    assert (out / "panorama-north.jpg").exists()
    assert (out / "panorama.jpg").read_bytes() == first


def test_a_faulty_document_leaves_nothing_behind(tmp_path: Path, document: Path) -> None:
    content = json.loads(document.read_text())
    content["storeys"][0]["openings"][0]["wall"] = "gone"
    document.write_text(json.dumps(content))
    with pytest.raises(InputError, match=r"storeys\[0\].openings\[0\].wall: there is no 'gone'"):
        plan(document, tmp_path / "out")
    assert not (tmp_path / "out").exists()


def test_documents_and_drawings_do_not_go_together(tmp_path: Path, document: Path) -> None:
    drawing = tmp_path / "plan.png"
    drawing.write_bytes(b"")
    with pytest.raises(InputError, match="is a document among other inputs"):
        run_plan([document, drawing], tmp_path / "out", PlanOptions(), Progress(quiet=True))


def test_a_blank_drawing_ends_in_a_report_that_says_so(tmp_path: Path) -> None:
    drawing = tmp_path / "blank.png"
    Image.new("RGB", (400, 300), "white").save(drawing)
    result = run_plan([drawing], tmp_path / "out", PlanOptions(), Progress(quiet=True))
    assert result.exit_code == 3
    report = json.loads((tmp_path / "out" / "report.json").read_text())
    assert report["state"] == "failed"
    assert "blank" in report["failures"][0]["reason"]
    assert not (tmp_path / "out" / "house.glb").exists()


def test_a_pdf_of_another_kind_leaves_nothing_behind(tmp_path: Path) -> None:
    book = tmp_path / "book.pdf"
    pages = pypdfium2.PdfDocument.new()
    for _ in range(500):
        pages.new_page(595, 842)
    pages.save(book)
    with pytest.raises(InputError, match="has 500 pages"):
        run_plan([book], tmp_path / "out", PlanOptions(), Progress(quiet=True))
    assert not (tmp_path / "out").exists()


def test_a_page_without_a_plan_is_named(tmp_path: Path) -> None:
    house = tmp_path / "house.pdf"
    pages = pypdfium2.PdfDocument.new()
    for _ in range(2):
        pages.new_page(595, 842)
    pages.save(house)
    options = PlanOptions(input=InputOptions(pages="2"))
    result = run_plan([house], tmp_path / "out", options, Progress(quiet=True))
    assert result.exit_code == 3
    report = json.loads((tmp_path / "out" / "report.json").read_text())
    assert report["steps"][0]["name"] == "read house.pdf page 2"
    assert "house.pdf page 2 is blank" in report["failures"][0]["reason"]


def test_a_dxf_becomes_a_house_and_a_dwg_leaves_nothing_behind(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    drawing = saved(two_rooms(0.001), tmp_path / "house.dxf")
    out = tmp_path / "out"
    result = run_plan([drawing], out, PlanOptions(), Progress(quiet=True))
    assert (result.exit_code, result.measures["rooms"]) == (0, 2)
    assert {path.name for path in out.iterdir()} >= FILES

    # Beside a document that somebody has edited, drawings make nothing: options are dropped.
    content = json.loads((out / "plan.json").read_text()) | {"north_deg": 20.0}
    (out / "plan.json").write_text(json.dumps(content))
    for north, dropped in ((None, 0), (20.0, 0), (50.0, 1)):
        options = PlanOptions(site=SiteOptions(north=north))
        left = run_plan([drawing], out, options, Progress(quiet=True), force=True)
        assert sum("it was not made anew" in note for note in left.notes) == dropped
        assert left.left
    capsys.readouterr()
    tell(left)
    told = capsys.readouterr().out
    assert "Nothing was made." in told
    assert "rooms" not in told

    drawing.write_bytes(b"AC1027" + bytes(100))
    with pytest.raises(InputError, match=r"house\.dxf: is a DWG file"):
        run_plan([drawing], tmp_path / "other", PlanOptions(), Progress(quiet=True))
    assert not (tmp_path / "other").exists()


def test_a_run_that_was_stopped_is_done_by_the_next(
    tmp_path: Path, document: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def stopped(*_: object) -> None:
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr(pipeline, "write_result", stopped)
        with pytest.raises(KeyboardInterrupt):
            plan(document, tmp_path / "out")
    assert not (tmp_path / "out" / "house.glb").exists()
    again = plan(document, tmp_path / "out")
    assert (again.exit_code, again.up_to_date) == (0, False)
    assert {path.name for path in (tmp_path / "out").iterdir()} >= FILES


def test_one_core_makes_the_same_files(
    tmp_path: Path, document: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with monkeypatch.context() as patch:
        patch.setattr(beside, "available_cores", lambda: 2)
        plan(document, tmp_path / "two")
    with monkeypatch.context() as patch:
        patch.setattr(beside, "available_cores", lambda: 1)
        plan(document, tmp_path / "one")
    for name in ("plan.svg", "plan.dxf", "house.ifc", "house.city.json", "house.glb"):
        assert (tmp_path / "two" / name).read_bytes() == (tmp_path / "one" / name).read_bytes()


def test_pages_are_of_no_use_to_a_document(tmp_path: Path, document: Path) -> None:
    options = PlanOptions(input=InputOptions(pages="2"))
    with pytest.raises(InputError, match="--pages: is for PDFs"):
        run_plan([document], tmp_path / "out", options, Progress(quiet=True))


def test_thirty_pixels_are_too_few_for_a_plan(tmp_path: Path) -> None:
    drawing = tmp_path / "thumb.png"
    Image.new("RGB", (30, 40), "white").save(drawing)
    result = run_plan([drawing], tmp_path / "out", PlanOptions(), Progress(quiet=True))
    assert result.failure is not None
    assert "thumb.png is 30 x 40 px. Scan it" in result.failure.reason
