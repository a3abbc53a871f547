"""The peak memory of a process and all that it starts.

Memory is summed over them 20 times a second, as the kernel accounts it: proportional set size
(pages that several processes share are counted once) and resident set size (counted for each).
"""

from __future__ import annotations

import os
import re
import subprocess
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

SAMPLE_S = 0.05


@dataclass
class Peak:
    """The largest sums seen, in bytes, and the most processes that were at work."""

    pss: int = 0
    rss: int = 0
    processes: int = 0


def watched(process: subprocess.Popen[bytes]) -> Peak:
    """The peak memory of a process and its descendants until it ends."""
    with _sampled(process.pid) as peak:
        process.wait()
    return peak


@contextmanager
def grown() -> Iterator[Peak]:
    """By how much this process and what it starts grow meanwhile; whole when it is left."""
    before = [memory(pid) for pid in descendants(os.getpid())]
    peak = Peak()
    with _sampled(os.getpid()) as whole:
        yield peak
    peak.pss = max(0, whole.pss - sum(pss for pss, _ in before))
    peak.rss = max(0, whole.rss - sum(rss for _, rss in before))
    peak.processes = whole.processes


@contextmanager
def _sampled(pid: int) -> Iterator[Peak]:
    peak, over = Peak(), threading.Event()

    def sample() -> None:
        while not over.is_set():
            family = [memory(each) for each in descendants(pid)]
            peak.pss = max(peak.pss, sum(pss for pss, _ in family))
            peak.rss = max(peak.rss, sum(rss for _, rss in family))
            peak.processes = max(peak.processes, len(family))
            over.wait(SAMPLE_S)

    sampler = threading.Thread(target=sample)
    sampler.start()
    try:
        yield peak
    finally:
        over.set()
        sampler.join()


def descendants(pid: int) -> list[int]:
    """The process and all that it started."""
    children = Path(f"/proc/{pid}/task/{pid}/children")
    try:
        found = [int(child) for child in children.read_text().split()]
    except (FileNotFoundError, ProcessLookupError):
        return [pid]
    return [pid, *(other for child in found for other in descendants(child))]


def memory(pid: int) -> tuple[int, int]:
    """Proportional and resident set size in bytes; zero for a process that has gone."""
    try:
        text = Path(f"/proc/{pid}/smaps_rollup").read_text()
    except (FileNotFoundError, ProcessLookupError, PermissionError):
        return 0, 0
    sizes = dict(re.findall(r"^(Pss|Rss):\s+(\d+) kB", text, re.MULTILINE))
    return int(sizes.get("Pss", 0)) * 1024, int(sizes.get("Rss", 0)) * 1024
