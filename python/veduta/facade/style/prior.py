"""What a style says of its attributes before any photo is seen: their distributions, as densities.

They are read from the rule file: `attr storeys = 30% : 4 50% : 5 else : 6`, `attr bayWidth = 2.2 +
rand(0.5)`, or a value alone. Buildings of a style are not all as its rules draw them, so a share of
the probability lies evenly over the attribute's `@Range`; a value alone is the middle of a normal
distribution. Colours, details and attributes that say nothing of the front keep what the file has.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

Value = float | str | bool
_ATTRIBUTE = re.compile(r"((?:^@[^\n]*\n)*)^attr\s+(\w+)\s*=\s*([^\n]+)$", re.MULTILINE)
_RANGE = re.compile(r"@Range\(min=([\d.]+),\s*max=([\d.]+)\)")
_DRAWN = re.compile(r"([\d.]+)\s*\+\s*rand\(([\d.]+)\)")
_CHANCE = re.compile(r"([\d.]+)%\s*:\s*(\"[^\"]*\"|[\w.]+)")
_ELSE = re.compile(r"else\s*:\s*(\"[^\"]*\"|[\w.]+)")
COUNTS = ("storeys", "bayStoreys")
"""Attributes of the styles that count floors: whole numbers, where a file gives one value."""
_LEFT_OUT = ("height", "LOD", "sides", "balconyDepth", "roofAngle", "frontYard", "houseDepth")


@dataclass(frozen=True)
class PriorParameters:
    """elsewhere: share of the probability that lies evenly over the range of an attribute. near:
    deviation of an attribute that the file gives as one value, of that value.
    """

    elsewhere: float = 0.2
    near: float = 0.05


_OWN = PriorParameters()


@dataclass(frozen=True)
class Real:
    """A length: evenly in `low` to `high` (normal about their middle where they are the same), or,
    for a share of `PriorParameters.elsewhere`, anywhere from `least` to `most`.
    """

    low: float
    high: float
    least: float
    most: float

    def log_density(self, value: Value) -> float:
        """Natural logarithm of the density at a value."""
        at = float(value)
        if not self.least <= at <= self.most:
            return -math.inf
        density = _OWN.elsewhere / (self.most - self.least)
        if self.high > self.low:
            density += (
                (1.0 - _OWN.elsewhere) * (self.low <= at <= self.high) / (self.high - self.low)
            )
        else:
            spread = _OWN.near * self.low
            peak = math.exp(-0.5 * ((at - self.low) / spread) ** 2)
            density += (1.0 - _OWN.elsewhere) * peak / (spread * math.sqrt(2.0 * math.pi))
        return math.log(density)

    def draw(self, rng: np.random.Generator) -> float:
        """A value by chance."""
        if rng.random() < _OWN.elsewhere:
            return float(rng.uniform(self.least, self.most))
        if self.high > self.low:
            return float(rng.uniform(self.low, self.high))
        near = rng.normal(self.low, _OWN.near * self.low)
        return float(np.clip(near, self.least, self.most))

    @property
    def middle(self) -> float:
        """The value that a search begins with."""
        return 0.5 * (self.low + self.high)

    @property
    def step(self) -> float:
        """The deviation of a step of a random walk."""
        return 0.05 * (self.most - self.least)


@dataclass(frozen=True)
class Choice:
    """One of some values, each with its chance. `ordered`: whole numbers that follow each other."""

    values: tuple[Value, ...]
    chances: tuple[float, ...]
    ordered: bool = False

    def log_density(self, value: Value) -> float:
        """Natural logarithm of the chance of a value."""
        if value not in self.values:
            return -math.inf
        return math.log(self.chances[self.values.index(value)])

    def draw(self, rng: np.random.Generator) -> Value:
        """A value by chance."""
        return self.values[int(rng.choice(len(self.values), p=self.chances))]

    @property
    def middle(self) -> Value:
        """The likeliest value."""
        return self.values[int(np.argmax(self.chances))]


Distribution = Real | Choice


def distributions(text: str) -> dict[str, Distribution]:
    """The distributions of the attributes of a style's rule file that shape its front."""
    found: dict[str, Distribution] = {}
    for notes, name, value in _ATTRIBUTE.findall(text):
        if name in _LEFT_OUT or "@Color" in notes or "@Hidden" in notes:
            continue
        distribution = _distribution(name, notes, value.strip())
        if distribution is not None:
            found[name] = distribution
    return found


def _distribution(name: str, notes: str, value: str) -> Distribution | None:
    limits = _RANGE.search(notes)
    least, most = (float(limits[1]), float(limits[2])) if limits else (math.nan, math.nan)
    chances = [(_value(word), 0.01 * float(share)) for share, word in _CHANCE.findall(value)]
    if chances:
        rest = _ELSE.search(value)
        if rest:
            chances.append((_value(rest[1]), 1.0 - sum(chance for _, chance in chances)))
        return _choice(dict(chances), least, most)
    drawn = _DRAWN.fullmatch(value)
    if drawn and limits:
        low = float(drawn[1])
        return Real(low, low + float(drawn[2]), least, most)
    alone = _value(value)
    if isinstance(alone, bool):
        return _choice({alone: 1.0 - _OWN.elsewhere, not alone: _OWN.elsewhere}, math.nan, math.nan)
    if isinstance(alone, float) and limits:
        whole = name in COUNTS and alone.is_integer() and least.is_integer()
        return _choice({alone: 1.0}, least, most) if whole else Real(alone, alone, least, most)
    return None


def _choice(chances: Mapping[Value, float], least: float, most: float) -> Choice:
    """With a share for each whole number of the range, where there is one."""
    if math.isnan(least) or not all(isinstance(value, float) for value in chances):
        return Choice(tuple(chances), tuple(chances.values()))
    every = [float(number) for number in range(math.ceil(least), math.floor(most) + 1)]
    shares = [
        (1.0 - _OWN.elsewhere) * chances.get(number, 0.0) + _OWN.elsewhere / len(every)
        for number in every
    ]
    return Choice(tuple(every), _normal(shares), ordered=True)


def _normal(shares: Sequence[float]) -> tuple[float, ...]:
    total = sum(shares)
    return tuple(share / total for share in shares)


def _value(word: str) -> Value:
    if word.startswith('"'):
        return word.strip('"')
    if word in ("true", "false"):
        return word == "true"
    try:
        return float(word)
    except ValueError:
        return word
