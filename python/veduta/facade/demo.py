"""A street made from a seed, its photo rebuilt by the verb, and the result beside the truth.

OUT/truth has the photo and what is true about it, OUT/place is what `veduta facade` makes of the
photo, OUT/comparison says how the two agree: as the document in OUT/place is now, also where
somebody has edited it since. OUT/street is a procedural street around the rebuilt house, and
OUT/place.json shows both together.
"""

from __future__ import annotations

import json
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from pydantic import BaseModel, ConfigDict, Field

from veduta.facade.batch import CallResult, run_call
from veduta.facade.compare import Comparison, compare
from veduta.facade.compare_picture import comparison_png, truth_png
from veduta.facade.demo_options import DemoOptions
from veduta.facade.demo_street import LOTS, LOTS_FILE, derive_street, joined_place, street_lots
from veduta.facade.document import FacadeDocument
from veduta.facade.load import DOCUMENT, load_document
from veduta.facade.options import EyesOptions, FacadeOptions, RectifyOptions, ScaleOptions
from veduta.facade.pipeline import VERSION as FACADE_VERSION
from veduta.formats.place_json import write_place
from veduta.geometry import homography
from veduta.grammar.pipeline import DeriveResult
from veduta.run.digests import file_digest, result_key
from veduta.run.outputs import OutFolder, Standing, open_out, writing_to
from veduta.run.progress import Progress
from veduta.run.record import CALL, load_record
from veduta.synthetic.facade import SyntheticFacade, make_facade
from veduta.synthetic.options import SyntheticOptions
from veduta.synthetic.truth import FacadeTruth

VERSION = "2"
TRUTH, PLACE, COMPARISON = "truth", "place", "comparison"
PHOTO = "street.jpg"
RECORD = "comparison.json"


class DemoRecord(BaseModel):
    """What the demo came to; `comparison.json`."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    style: str
    seed: int
    photo_px: tuple[int, int]
    focal_mm35: float
    distance_m: float = Field(description="from the camera to the wall")
    given: list[str] = Field(description="what the verb was told beside the photo")
    document_sha256: str = Field(default="", description="of the facade.json that was compared")
    comparison: Comparison
    seconds_photo: float
    seconds_rebuild: float


@dataclass(frozen=True)
class DemoResult:
    """`record` is None where the photo gave no building; `call` (None when up to date) says why."""

    out: Path
    record: DemoRecord | None
    call: CallResult | None = None
    edited: bool = False
    """Whether the document is no longer as `veduta facade` wrote it."""
    street: DeriveResult | None = None
    """What became of the lots around it; None when up to date."""


def run_demo(
    out: Path, options: DemoOptions, street: SyntheticOptions, progress: Progress, *, force: bool
) -> DemoResult:
    """Make the street, rebuild it from its photo, compare; the same call again is up to date."""
    versions = f"{VERSION}, facade {FACADE_VERSION}"
    key = result_key("demo", versions, options, street.model_dump(mode="json"))
    path = out / PLACE / Path(PHOTO).stem / DOCUMENT
    with open_out(out, "demo", key, force=force) as folder:
        if folder.standing is Standing.UP_TO_DATE and path.exists():
            record = _record_of(folder, key, path, options, street)
            return DemoResult(out, record, edited=_is_edited(path))
        started = time.perf_counter()
        facade = make_facade(options.seed, street)
        seconds_photo = time.perf_counter() - started
        _publish_truth(folder, key, facade)
        knowledge = what_the_user_knows(facade, options)
        started = time.perf_counter()
        call = run_call([out / TRUTH / PHOTO], out / PLACE, knowledge, progress, force=force)
        seconds_rebuild = time.perf_counter() - started
        if call.failed:
            return DemoResult(out, None, call)
        document = load_document(path)
        record = DemoRecord(
            style=facade.truth.style,
            seed=options.seed,
            photo_px=(facade.camera.width_px, facade.camera.height_px),
            focal_mm35=round(facade.camera.focal_mm35),
            distance_m=round(-float(facade.camera.position_m[1]), 2),
            given=_given(options),
            document_sha256=file_digest(path),
            comparison=compare(document, facade.truth),
            seconds_photo=round(seconds_photo, 2),
            seconds_rebuild=round(seconds_rebuild, 2),
        )
        _publish_comparison(folder, key, facade, document, record)
        street_of = (facade.truth.style, options.seed, document)
        neighbours = _publish_street(folder, key, street_of, progress)
        folder.finish()
        return DemoResult(out, record, call, edited=_is_edited(path), street=neighbours)


def _record_of(
    folder: OutFolder, key: str, path: Path, options: DemoOptions, street: SyntheticOptions
) -> DemoRecord:
    """The record of a finished demo, compared anew where its document is another one by now."""
    text = (folder.path / COMPARISON / RECORD).read_text(encoding="utf-8")
    record = DemoRecord.model_validate_json(text)
    digest = file_digest(path)
    if digest == record.document_sha256:
        return record
    document = load_document(path)
    facade = make_facade(options.seed, street)
    update = {"document_sha256": digest, "comparison": compare(document, facade.truth)}
    record = record.model_copy(update=update)
    _publish_comparison(folder, key, facade, document, record)
    return record


def _publish_street(
    folder: OutFolder,
    key: str,
    street_of: tuple[str, int, FacadeDocument],
    progress: Progress,
) -> DeriveResult:
    """The lots around the house, what is built on them, and the place of all.

    street_of: the style and the seed of the street, and the house.
    """
    out = folder.path
    style, seed, document = street_of
    work = folder.work_folder(LOTS)
    with writing_to(out):
        (work / LOTS_FILE).write_text(street_lots(document, style, seed), encoding="utf-8")
    folder.publish(LOTS, key, work)
    found = derive_street(out, style, seed, progress, force=True)
    work = folder.work_folder(CALL)
    with writing_to(out):
        write_place(joined_place(out, PLACE), work / "place.json")
    folder.publish(CALL, key, work)
    return found


def _is_edited(path: Path) -> bool:
    known = load_record(path.parents[1])
    name = f"{path.parent.name}/{path.name}"
    return known is not None and file_digest(path) != known.files.get(name)


def _publish_comparison(
    folder: OutFolder,
    key: str,
    facade: SyntheticFacade,
    document: FacadeDocument,
    record: DemoRecord,
) -> None:
    work = folder.work_folder(COMPARISON)
    with writing_to(folder.path):
        (work / RECORD).write_text(record.model_dump_json(indent=1) + "\n", encoding="utf-8")
        picture = comparison_png(facade.photo, facade.truth, document)
        (work / "comparison.png").write_bytes(picture)
    folder.publish(COMPARISON, key, work)


def what_the_user_knows(facade: SyntheticFacade, options: DemoOptions) -> FacadeOptions:
    """What a person with the photo in hand would type; nothing else of the truth is used.

    The plain eyes, for the learned ones were trained on pictures of the same synthetic styles.
    """
    rectify, scale = RectifyOptions(), ScaleOptions()
    if options.corners:
        truth = facade.truth
        wall = [
            [0.0, truth.height_m],
            [truth.width_m, truth.height_m],
            [truth.width_m, 0.0],
            [0.0, 0.0],
        ]
        clicked = np.rint(homography.apply(truth.photo_from_facade, np.array(wall))).ravel()
        rectify = RectifyOptions.model_validate({"corners": clicked.tolist()})
    if not options.unmeasured:
        scale = ScaleOptions(height_m=round(facade.truth.height_m, 1))
    return FacadeOptions(eyes=EyesOptions(eyes="plain"), rectify=rectify, scale=scale)


def _given(options: DemoOptions) -> list[str]:
    given = ["the focal length (EXIF)"]
    if not options.unmeasured:
        given.append("the height of the wall to 0.1 m")
    if options.corners:
        given.append("the corners of the wall to a pixel")
    return given


def _publish_truth(folder: OutFolder, key: str, facade: SyntheticFacade) -> None:
    work = folder.work_folder(TRUTH)
    with writing_to(folder.path):
        (work / PHOTO).write_bytes(facade.jpeg)
        (work / "labels.png").write_bytes(truth_png(facade.truth))
        (work / "truth.json").write_text(_truth_json(facade.truth), encoding="utf-8")
    folder.publish(TRUTH, key, work)


def _truth_json(truth: FacadeTruth) -> str:
    elements = [
        {
            "class": element.label,
            "floor": element.floor,
            "column": element.column,
            "x_m": element.rect.x_m,
            "y_m": element.rect.y_m,
            "width_m": element.rect.width_m,
            "height_m": element.rect.height_m,
            "visible_corners_px": element.quad_px.round(3).tolist(),
        }
        for element in truth.elements
    ]
    content = {
        "style": truth.style,
        "width_m": truth.width_m,
        "height_m": truth.height_m,
        "storeys": truth.storeys,
        "columns": truth.columns,
        "photo_from_facade": truth.photo_from_facade.tolist(),
        "elements": elements,
    }
    return json.dumps(content, indent=1) + "\n"
