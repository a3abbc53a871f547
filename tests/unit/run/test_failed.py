"""The report of what failed, the digests of inputs, and files of OUT that are no documents."""

import hashlib
import json
from pathlib import Path

import pytest

from veduta.run.digests import input_digest
from veduta.run.edited import refuse_other_json
from veduta.run.errors import InputError
from veduta.run.failed import failure_report
from veduta.run.options import Options
from veduta.run.page import Page
from veduta.run.report import Failure, StepRecord


def test_a_failure_says_how_far_it_came_and_why_it_ended() -> None:
    failure = Failure(subject="a.jpg", kind="not-found", reason="no <wall> is seen")
    steps = [StepRecord("read", 0.5, {"pixels": 12})]
    report, page = failure_report("plan", "a.jpg", failure, Options(), steps)
    said = json.loads(report.to_json())
    assert said["state"] == "failed"
    assert said["failures"] == [
        {"subject": "a.jpg", "kind": "not-found", "reason": "no <wall> is seen"}
    ]
    assert [step["name"] for step in said["steps"]] == ["read"]
    assert said["measures"] == {}
    assert b"Nothing was built." in page
    assert b"no &lt;wall&gt; is seen" in page


def test_a_failure_has_the_page_and_the_engines_of_its_verb() -> None:
    failure = Failure(subject="a", kind="not-found", reason="no pair holds")
    page = Page(title="a", summary="No photos could be placed.")
    report, text = failure_report(
        "photos", "a", failure, Options(), [], page=page, engines={"engine": "3.1"}
    )
    assert report.versions["engine"] == "3.1"
    assert set(report.versions) == {"veduta", "python", "engine"}
    assert b"No photos could be placed." in text


def test_the_digest_of_an_input_is_that_of_its_bytes(tmp_path: Path) -> None:
    path = tmp_path / "a.json"
    path.write_bytes(b"{}")
    assert input_digest(path, 2) == hashlib.sha256(b"{}").hexdigest()


def test_an_input_that_is_missing_or_too_large_is_named(tmp_path: Path) -> None:
    path = tmp_path / "a.json"
    with pytest.raises(InputError, match=r"a\.json: does not exist") as missing:
        input_digest(path, if_missing="It must lie beside the others.")
    assert missing.value.remedy == "It must lie beside the others."
    path.write_bytes(b"[1]")
    with pytest.raises(InputError, match="more than"):
        input_digest(path, 2)
    with pytest.raises(InputError, match="is a folder"):
        input_digest(tmp_path)


def test_a_file_of_out_that_is_no_document_is_refused() -> None:
    others = {"place.json": "says where the house stands"}
    refuse_other_json(Path("out/plan.json"), others, "a plan", str)
    with pytest.raises(InputError, match="says where the house stands, and is no document of a"):
        refuse_other_json(Path("out/place.json"), others, "a plan", str)
