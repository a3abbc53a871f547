"""`veduta VERB ...`: finds the verb, runs it, and tells errors the way people read them.

Nothing heavy is imported here, nor at the top of a verb's module: `veduta --help` answers at once.
A verb brings what does its work after it has read its arguments: help and misuse do not wait.
A verb's module has `SUMMARY` (one line) and `run(arguments) -> exit code`.
"""

from __future__ import annotations

import difflib
import importlib
import os
import re
import signal
import sys
import tempfile
import traceback
from collections.abc import Callable, Mapping, Sequence
from types import FrameType
from typing import NoReturn

import veduta
from veduta.cli.plain_words import plain_words
from veduta.cli.streams import drop_output, outlive_readers
from veduta.run.errors import (
    NO_ROOM,
    InputError,
    NotFoundError,
    UnfinishedError,
    UnwritableError,
    VedutaError,
)
from veduta.run.names import printable
from veduta.run.quiet import quiet_libraries
from veduta.run.threads import same_sums_anywhere

VERBS = (
    "facade", "grammar", "photos", "carve", "dense", "drive", "plan", "walk", "fauna",
    "demo", "view", "export",
)  # fmt: skip
DONE, BUG, BAD_USE, SOME_FAILED = 0, 1, 2, 3
STOPPED = "stopped"
GOES_ON = ": what is finished is on disk, and the same command does the rest"
INTERRUPTED, TERMINATED = 128 + signal.SIGINT, 128 + signal.SIGTERM


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; the result is the exit code."""
    outlive_readers()
    words = list(sys.argv[1:] if arguments is None else arguments)
    if not words or words[0] in {"-h", "--help", "help"}:
        return _printed(_help(), DONE if words else BAD_USE)
    if words[0] in {"-V", "--version"}:
        return _printed(f"veduta {veduta.__version__}", DONE)
    if words[0] in {"--licences", "--licenses"}:
        from veduta.cli.licences import licences

        return _printed(licences(), DONE)
    verb = words.pop(0)
    if verb not in VERBS:
        return _unknown(verb)
    signal.signal(signal.SIGTERM, _stop)
    same_sums_anywhere()
    quiet_libraries()
    return _guarded(verb, words, lambda: _plainly(verb, words))


def _plainly(verb: str, words: list[str]) -> int:
    """Run a verb under names that are UTF-8; its errors are told by those that were given."""
    module = importlib.import_module(f"veduta.cli.{verb}")
    with plain_words(verb, words) as plain:
        return _guarded(verb, words, lambda: int(module.run(plain)))


def _asks_help(words: Sequence[str]) -> bool:
    """Whether a call only asks what can be asked."""
    return not {"-h", "--help"}.isdisjoint(words)


def _guarded(verb: str, words: Sequence[str], run: Callable[[], int]) -> int:
    """Run a verb; every error becomes a line on standard error and an exit code."""
    try:
        code = run()
        if sys.stdout is not None:
            sys.stdout.flush()
        return code
    except UnicodeEncodeError as error:
        return _misnamed(verb, error)
    except OSError as error:
        return _no_room(error) if error.errno in NO_ROOM else _bug(verb, error)
    except InputError as error:
        _say(f"error: {error}")
        return BAD_USE
    except NotFoundError as error:
        _say(f"error: {error}")
        return SOME_FAILED
    except (KeyboardInterrupt, UnfinishedError) as error:
        _say(STOPPED if _asks_help(words) else f"{STOPPED}{GOES_ON}")
        return TERMINATED if isinstance(error, UnfinishedError) else INTERRUPTED
    except VedutaError as error:
        _say(f"error: {error}")
        return BAD_USE
    except Exception as error:  # noqa: BLE001  the last place where a bug can be told
        return _bug(verb, error)


def _printed(text: str, code: int) -> int:
    """Print what was asked for; the exit code."""
    try:
        print(text, flush=True)
    except OSError as error:
        return _no_room(error)
    return code


def _no_room(error: OSError) -> int:
    drop_output()
    _say(f"error: {UnwritableError.of(error)}")
    return BAD_USE


def _bug(verb: str, error: Exception) -> int:
    """Tell an error that nobody expected; called where it is handled."""
    _say(f"error: a bug in veduta {verb}: {type(error).__name__}: {error}")
    _say(f"Please report it with {save_traceback(traceback.format_exc())}")
    return BUG


def _misnamed(verb: str, error: UnicodeEncodeError) -> int:
    """A file's name that is no UTF-8 cannot be written into documents, reports and web pages."""
    text, at = str(error.object), error.start
    if not "\udc80" <= text[at] <= "\udcff":
        return _bug(verb, error)
    # What cannot be written may be a whole document that the name stands in.
    name = re.split(r'["/\n]', text[:at])[-1] + re.split(r'["/\n]', text[at:])[0]
    shown = os.fsencode(name).decode("utf-8", "backslashreplace")[:200]
    _say(f"error: {shown}: has a name that is not UTF-8. Rename it.")
    return BAD_USE


def save_traceback(text: str) -> str:
    """Write a traceback to a file of its own; its path."""
    with tempfile.NamedTemporaryFile(
        "w", prefix="veduta-bug-", suffix=".txt", delete=False, encoding="utf-8"
    ) as file:
        file.write(f"veduta {veduta.__version__}, Python {sys.version}\n\n{text}")
    return file.name


def tell_bugs(tracebacks: Mapping[str, str]) -> None:
    """Save the tracebacks of what failed, by name, in one file, and ask for a report with it."""
    if tracebacks:
        told = "\n".join(f"{name}:\n{text}" for name, text in tracebacks.items())
        _say(f"Please report it with {save_traceback(told)}")


def _help() -> str:
    lines = [
        "usage: veduta VERB [OPTIONS] ...",
        "",
        "Turns records of real places into measured, semantic, walkable 3D.",
        "",
    ]
    for verb in VERBS:
        summary = importlib.import_module(f"veduta.cli.{verb}").SUMMARY
        lines.append(f"  {verb:<10}{summary}")
    lines += [
        "",
        "`veduta VERB --help` explains a verb; `veduta --version` tells the version,",
        "`veduta --licences` what it is made with.",
    ]
    return "\n".join(lines)


def _unknown(verb: str) -> int:
    near = difflib.get_close_matches(verb, VERBS, n=1)
    hint = f"Did you mean `veduta {near[0]}`?" if near else "`veduta --help` lists the verbs."
    _say(f"error: {verb}: is not a verb of veduta. {hint}")
    return BAD_USE


def _stop(number: int, frame: FrameType | None) -> NoReturn:
    raise UnfinishedError("stopped by SIGTERM")


def _say(text: str) -> None:
    print(printable(text), file=sys.stderr)


if __name__ == "__main__":
    sys.exit(main())
