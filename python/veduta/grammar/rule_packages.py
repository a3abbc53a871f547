"""Rule packages (`.rpk`): archives with the rules of a project and the assets that they need.

One that is a zip archive and holds sources is unpacked into a folder of its own for as long as the
program runs. CityEngine packs with 7z, and may leave the sources out: such a package is refused
with what to do instead.
"""

from __future__ import annotations

import atexit
import shutil
import tempfile
import zipfile
import zlib
from functools import lru_cache
from pathlib import Path, PurePosixPath

from veduta.run.errors import InputError
from veduta.run.inputs import require_file

SUFFIX = ".rpk"
MAX_BYTES, MAX_FILES = 2**30, 20_000
"""Of a package, unpacked: bytes, and files."""
_SEVEN = b"7z\xbc\xaf\x27\x1c"
_SOURCE, _COMPILED = ".cga", ".cgb"


def unpacked(path: Path) -> Path:
    """The main rule file of a package, unpacked once; InputError says why there is none.

    The main one lies directly in `rules`, is called as the package or marks a start rule.
    """
    try:
        require_file(path)
        state = path.stat()
    except FileNotFoundError as error:
        raise InputError(path, "does not exist", "Check its name.") from error
    return _unpacked(path, state.st_mtime_ns, state.st_size)


@lru_cache(maxsize=16)
def _unpacked(path: Path, changed_ns: int, size: int) -> Path:
    """As `unpacked`; a package that has changed is another one."""
    try:
        with path.open("rb") as package:
            head = package.read(len(_SEVEN))
    except OSError as error:
        told = f"cannot be read ({error.strerror})"
        raise InputError(path, told, "Check its permissions.") from error
    if head == _SEVEN:
        remedy = "Unpack it with 7-Zip, and name the .cga file in it."
        raise InputError(path, "is packed by 7z, which is not read", remedy)
    try:
        with zipfile.ZipFile(path) as archive:
            folder = _extracted(path, archive)
    except (zipfile.BadZipFile, RuntimeError, EOFError, zlib.error, OSError, ValueError) as error:
        fault = f"is no rule package that can be read ({error})"
        raise InputError(path, fault, "Share it anew, as a zip archive.") from error
    return _main_of(path, folder)


def _extracted(path: Path, archive: zipfile.ZipFile) -> Path:
    """The folder with the files of the archive; names that lead out of it are a fault."""
    if not all(member.filename for member in archive.infolist()):
        raise zipfile.BadZipFile("it has a file without a name")
    members = [member for member in archive.infolist() if not member.is_dir()]
    size = sum(member.file_size for member in members)
    if len(members) > MAX_FILES or size > MAX_BYTES:
        fault = f"holds {len(members)} files of {size / 2**20:.0f} MiB together"
        raise InputError(path, fault, "Unpack it, and name the .cga file in it.")
    for member in members:
        own = PurePosixPath(member.filename.replace("\\", "/"))
        if not own.parts or own.is_absolute() or ".." in own.parts or ":" in own.parts[0]:
            raise InputError(path, f"holds a file outside of it ({own})", "Share it anew.")
    folder = Path(tempfile.mkdtemp(prefix="veduta-rules-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    for member in members:
        target = folder.joinpath(*PurePosixPath(member.filename.replace("\\", "/")).parts)
        target.parent.mkdir(parents=True, exist_ok=True)
        with archive.open(member) as source, target.open("wb") as written:
            shutil.copyfileobj(source, written)
    return folder


def _main_of(path: Path, folder: Path) -> Path:
    sources = sorted(folder.rglob(f"*{_SOURCE}"), key=lambda one: (len(one.parts), one.name))
    if not sources:
        compiled = any(folder.rglob(f"*{_COMPILED}"))
        fault = "holds compiled rules alone (.cgb)" if compiled else "holds no rules (.cga)"
        raise InputError(path, fault, "Share the package with its sources.")
    named = [one for one in sources if one.stem.lower() == path.stem.lower()]
    starts = [one for one in sources if b"@StartRule" in one.read_bytes()]
    return (named or starts or sources)[0]
