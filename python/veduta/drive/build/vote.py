"""A page on which people vote whether segments look better than they were scanned (tables 1 and 2)."""

from __future__ import annotations

import html
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

VOTE, PAGE = "vote", "vote.html"
_JPEG_QUALITY = 85
_CHOICES = (
    ("2", "left much better"), ("1", "left better"), ("0", "the same"), ("-1", "right better"),
    ("-2", "right much better"),
)  # fmt: skip
_CLASSES = ("significantly better", "better", "same", "worse", "significantly worse")
_STYLE = """
body { font: 16px/1.5 system-ui, sans-serif; margin: 2rem auto; max-width: 96rem; padding: 0 1rem; color: #16202a; }
.pair { display: grid; grid-template-columns: 1fr 1fr; gap: .5rem; }
.pair img { width: 100%; background: #e2e5e7; }
fieldset { border: 0; padding: .3rem 0 2rem; display: flex; gap: 1.2rem; flex-wrap: wrap; }
table { border-collapse: collapse; margin: 0 2rem 1rem 0; display: inline-table; }
td, th { border-bottom: 1px solid #ccd3d8; padding: .2rem .8rem; text-align: left; }
td + td { text-align: right; }
"""
_SCRIPT = """
function told() {
  const votes = [...document.querySelectorAll("fieldset")].map((field) => {
    const chosen = field.querySelector("input:checked");
    const sign = field.dataset.made === "left" ? 1 : -1;
    return { segment: field.dataset.segment, trees: field.dataset.trees === "yes", vote: chosen ? sign * Number(chosen.value) : null };
  });
  for (const table of document.querySelectorAll("table")) {
    const own = votes.filter(({ trees, vote }) => vote !== null && !(table.id === "two" && trees));
    [...table.querySelectorAll("td + td")].forEach((cell, row) => {
      const count = own.filter(({ vote }) => vote === 2 - row).length;
      cell.textContent = own.length === 0 ? "" : `${count} (${Math.round((100 * count) / own.length)} %)`;
    });
  }
  return votes;
}
document.addEventListener("change", told);
document.querySelector("button").addEventListener("click", () => {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([JSON.stringify(told(), null, 1)], { type: "application/json" }));
  link.download = "votes.json";
  link.click();
});
"""


@dataclass(frozen=True)
class Pair:
    """A segment's two pictures: their names in `vote/`. trees: whether it was left as it is."""

    segment: str
    before: str
    after: str
    trees: bool


def write_pair(
    segment: str, trees: bool, pictures: tuple[NDArray[np.uint8], NDArray[np.uint8]], folder: Path
) -> Pair:
    """Write two pictures (h, w, 3) into the `vote/` of a folder."""
    (folder / VOTE).mkdir(exist_ok=True)
    names = [f"{segment}-{word}.jpg" for word in ("scanned", "made")]
    for name, pixels in zip(names, pictures, strict=True):
        Image.fromarray(pixels).save(folder / VOTE / name, quality=_JPEG_QUALITY)
    return Pair(segment, names[0], names[1], trees)


def write_vote(pairs: Sequence[Pair], folder: Path, seed: int) -> bool:
    """`vote.html`; nothing where there are no pairs. Which side is which is drawn for each pair."""
    if not pairs:
        return False
    random = np.random.default_rng(seed)
    shown = "\n".join(_pair(one, bool(random.integers(2))) for one in pairs)
    tables = _table("one", "All segments") + _table("two", "Those that are not mostly trees")
    page = (
        '<!doctype html><html lang="en"><meta charset="utf-8"><title>Which is better?</title>'
        f"<style>{_STYLE}</style><h1>Which is better?</h1><p>Each pair shows a piece of the street"
        " as it was scanned, and as it was made of that; which is which differs from pair to pair."
        " Say which you would rather have of a city.</p>"
        f"{shown}<h2>What was said of those that were made</h2>{tables}"
        f"<p><button>Save the votes</button></p><script>{_SCRIPT}</script></html>\n"
    )
    (folder / PAGE).write_text(page, encoding="utf-8")
    return True


def _pair(pair: Pair, made_left: bool) -> str:
    name = html.escape(pair.segment, quote=True)
    files = (pair.after, pair.before) if made_left else (pair.before, pair.after)
    images = "".join(
        f'<img src="{VOTE}/{html.escape(file, quote=True)}" alt="{side} picture of {name}">'
        for side, file in zip(("Left", "Right"), files, strict=True)
    )
    choices = "".join(
        f'<label><input type="radio" name="{name}" value="{value}"> {words}</label>'
        for value, words in _CHOICES
    )
    return (
        f'<h2>{name}</h2><div class="pair">{images}</div><fieldset data-segment="{name}"'
        f' data-made="{"left" if made_left else "right"}" data-trees="{"yes" if pair.trees else "no"}">'
        f"{choices}</fieldset>"
    )


def _table(identity: str, title: str) -> str:
    rows = "".join(f"<tr><td>{words}</td><td></td></tr>" for words in _CLASSES)
    return f'<table id="{identity}"><caption>{title}</caption>{rows}</table>'
