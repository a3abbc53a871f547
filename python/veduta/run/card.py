"""The graphics card that a verb may use: chosen once, and told when it is not there or vanishes."""

from __future__ import annotations

from collections.abc import Callable
from time import perf_counter
from typing import Any, Literal, TypeVar

from pydantic import Field

from veduta import _core
from veduta.run.errors import InputError
from veduta.run.options import Options
from veduta.run.work import Work

Device = Literal["auto", "cpu", "gpu"]
T = TypeVar("T")

GO_ON = "--device auto, which goes on with the processor."
NOT_BUILT = "this Veduta was built without graphics cards"


class DeviceOptions(Options):
    """What computes the heavy steps that there are shaders for."""

    device: Device = Field(
        default="auto",
        description=(
            "a graphics card where there is one and it is faster (auto), the processor (cpu), or a"
            " graphics card and nothing else (gpu)"
        ),
    )


class Engine:
    """Where the heavy steps of a run are computed.

    card: the open graphics card, or None: the processor. told: how it was chosen, for the report.
    lost: why the card was given up in the middle, or None. tried: of the steps that were computed
    on both, what that showed. slower: those of them that are slower on the card.
    """

    def __init__(self, device: Device, card: _core.GraphicsCard | None, told: str) -> None:
        self.device: Device = device
        self.card = card
        self.told = told
        self.lost: str | None = None
        self.tried: dict[str, str] = {}
        self.slower: set[str] = set()

    def run(
        self,
        on_card: Callable[[_core.GraphicsCard], T],
        on_cores: Callable[[], T],
        step: str | None = None,
    ) -> T:
        """On the card where there is one. If it vanishes, `auto` computes this again on the
        processor and stays there; where `gpu` was asked for that is an InputError.

        step: of many alike, whose results are the same bytes on both: `auto` computes the first on
        both and goes on with the faster.
        """
        if self.card is None or step in self.slower:
            return on_cores()
        if self.device == "auto" and step is not None and step not in self.tried:
            return self.trial(step, on_card, on_cores)
        return self._on_card(on_card, on_cores)

    def trial(
        self, step: str, on_card: Callable[[_core.GraphicsCard], T], on_cores: Callable[[], T]
    ) -> T:
        """What the processor finds; `slower` has the step where the card took longer."""
        began = perf_counter()
        found = on_cores()
        cores_s = perf_counter() - began
        self._on_card(on_card, lambda: found)  # a first call compiles and warms
        began = perf_counter()
        self._on_card(on_card, lambda: found)
        card_s = perf_counter() - began
        if self.card is not None:
            self.tried[step] = f"{step}: {card_s:.3f} s on the card, {cores_s:.3f} s on the cores"
            if card_s >= cores_s:
                self.slower.add(step)
        return found

    def _on_card(self, on_card: Callable[[_core.GraphicsCard], T], on_cores: Callable[[], T]) -> T:
        if self.card is None:
            return on_cores()
        try:
            return on_card(self.card)
        except _fault() as why:
            if self.device == "gpu":
                raise InputError("--device gpu", str(why), f"Use {GO_ON}") from why
            self.card, self.lost = None, str(why)
            return on_cores()


def choose_engine(device: Device, *, software: bool = False) -> Engine:
    """The card or the processor, as `device` says; InputError where `gpu` is asked for in vain.

    software: adapters that compute on the processor, too, for tests.
    """
    if device == "cpu":
        return Engine(device, None, "the processor, as --device cpu says")
    made: Any = getattr(_core, "GraphicsCard", None)
    if made is None:
        if device == "gpu":
            raise InputError("--device gpu", NOT_BUILT, f"Run `make gpu` once, or use {GO_ON}")
        return Engine(device, None, f"the processor: {NOT_BUILT}")
    try:
        card: _core.GraphicsCard = made(software=software)
    except _fault() as why:
        if device == "gpu":
            raise InputError("--device gpu", str(why), f"Use {GO_ON}") from why
        return Engine(device, None, f"the processor: {why}")
    return Engine(device, card, f"the graphics card {card.name()}")


def tell_engine(work: Work, engine: Engine) -> None:
    """In the report: what computed, and that the card was given up where it was."""
    work.fact("Computed by", engine.told)
    work.measure("computed_by", engine.told)
    for step, shown in engine.tried.items():
        faster = "the processor" if step in engine.slower else "the card"
        work.note(f"Tried on both, of which {faster} was faster and went on: {shown}.")
    if engine.lost is not None:
        work.doubt(f"{engine.lost}; from there on the processor computed")


def say_engine(work: Work, engine: Engine) -> None:
    """At the end of the summary, which the terminal says: with `auto` nobody chose."""
    where = "the processor" if engine.card is None else engine.told
    work.summary = f"{work.summary}; computed by {where}"


def _fault() -> type[Exception]:
    """What a card raises; where there are none, nothing does."""
    found: type[Exception] = getattr(_core, "GpuFault", _Never)
    return found


class _Never(Exception):
    """Raised by nothing."""
