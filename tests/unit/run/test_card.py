"""The graphics card of a run: asked for in vain, vanished in the middle, and the same results."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from veduta import _core
from veduta.run.card import Engine, choose_engine, tell_engine
from veduta.run.errors import InputError
from veduta.run.options import Options
from veduta.run.progress import no_progress
from veduta.run.work import Work

BUILT = hasattr(_core, "GraphicsCard")


class _Gone(RuntimeError):
    """In the place of the extension's GpuFault."""


class _Card:
    def __init__(self, *, software: bool = False) -> None:
        raise _Gone("there is no graphics card that can compute")


def _without_cards(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(_core, "GraphicsCard", _Card, raising=False)
    monkeypatch.setattr(_core, "GpuFault", _Gone, raising=False)


def test_without_a_card_auto_goes_on_and_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    _without_cards(monkeypatch)
    engine = choose_engine("auto")
    assert engine.card is None
    assert engine.told == "the processor: there is no graphics card that can compute"
    assert engine.run(lambda _: 1, lambda: 2) == 2
    assert choose_engine("cpu").card is None


def test_without_a_card_gpu_is_an_error_with_the_remedy(monkeypatch: pytest.MonkeyPatch) -> None:
    _without_cards(monkeypatch)
    with pytest.raises(InputError, match="no graphics card") as caught:
        choose_engine("gpu")
    assert caught.value.subject == "--device gpu"
    assert "--device auto" in caught.value.remedy


def test_without_shaders_built_the_remedy_is_to_build_them(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delattr(_core, "GraphicsCard", raising=False)
    assert "built without" in choose_engine("auto").told
    with pytest.raises(InputError, match="built without") as caught:
        choose_engine("gpu")
    assert "make gpu" in caught.value.remedy


def test_a_card_that_vanishes_is_given_up_or_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    _without_cards(monkeypatch)
    given: Any = object()

    def vanished(_: object) -> int:
        raise _Gone("the graphics card vanished: it was pulled out")

    engine = Engine("auto", given, "the graphics card X")
    assert engine.run(vanished, lambda: 2) == 2
    assert engine.card is None
    assert engine.lost is not None
    assert "pulled out" in engine.lost
    with pytest.raises(InputError, match="pulled out"):
        Engine("gpu", given, "the graphics card X").run(vanished, lambda: 2)


def test_auto_leaves_steps_to_the_processor_that_a_card_slows_down() -> None:
    card: Any = object()
    engine = Engine("auto", card, "the graphics card X")
    asked: list[str] = []

    def slow(_: object) -> str:
        asked.append("card")
        time.sleep(0.02)
        return "found"

    def fast() -> str:
        asked.append("cores")
        return "found"

    assert engine.run(slow, fast, "links") == "found"
    assert engine.slower == {"links"}
    asked.clear()
    assert engine.run(slow, fast, "links") == "found"
    assert asked == ["cores"]

    def soon(_: object) -> str:
        asked.append("card")
        return "found"

    def late() -> str:
        time.sleep(0.02)
        return "found"

    engine.run(soon, late, "pairs")
    assert engine.slower == {"links"}
    work = Work(Path(), Path(), "dense", "1", Options(), no_progress)
    tell_engine(work, engine)
    # Both times of either step are told, whichever was faster.
    links, pairs = work.notes
    assert "the processor was faster" in links
    assert "the card was faster" in pairs
    assert all(f"{step}: 0.0" in note for step, note in (("links", links), ("pairs", pairs)))
    assert all("s on the card" in note and "s on the cores" in note for note in work.notes)
    asked.clear()
    engine.run(soon, late, "pairs")
    assert asked == ["card"]
    # Who asks for the card gets it.
    asked.clear()
    assert Engine("gpu", card, "X").run(slow, fast, "links") == "found"
    assert asked == ["card"]


@pytest.mark.skipif(not BUILT, reason="built without graphics cards: make gpu")
def test_a_real_card_finds_the_same_and_may_vanish() -> None:
    engine = choose_engine("auto", software=True)
    if engine.card is None:
        pytest.skip(f"no adapter, not even software (Debian: mesa-vulkan-drivers): {engine.told}")
    draw = np.random.default_rng(3)
    here = draw.integers(0, 255, (40, 60, 3), dtype=np.uint8)
    there = np.roll(here, 5, axis=1)
    shown = np.ones((40, 60), dtype=bool)

    def match(core: Any) -> np.ndarray[tuple[int, ...], np.dtype[np.float32]]:
        found: np.ndarray[tuple[int, ...], np.dtype[np.float32]] = core.match_pair(
            here,
            there,
            shown,
            shown,
            _core.PairRule(
                low=-2,
                count=12,
                rows=9,
                gamma_colour=20.0,
                gamma_px=9.0,
                most=40,
                path=(600, 12_000),
            ),
        )
        return found

    wanted = match(_core)
    assert np.nanmedian(wanted) == pytest.approx(5.0, abs=0.5)
    np.testing.assert_allclose(engine.run(match, lambda: wanted * 0.0), wanted, atol=1e-4)
    engine.card.destroy()
    np.testing.assert_array_equal(engine.run(match, lambda: wanted), wanted)
    assert engine.lost is not None
