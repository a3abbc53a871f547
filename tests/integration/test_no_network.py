"""No verb looks up the name of any host: all look-ups of the C library are trapped.

onnxruntime's telemetry also leaves an id of the machine in the home folder on first use, before it
sends anything: with it switched on (`ORT_DISABLE_TELEMETRY` deleted), that is what fails here.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from command_line import command

TRAP = r"""
#define _GNU_SOURCE
#include <netdb.h>
#include <stdio.h>
#include <stdlib.h>
#include <errno.h>
#include <sys/socket.h>
#include <dlfcn.h>
#include <string.h>

static void note(const char *what, const char *name) {
    const char *path = getenv("TRAP_FILE");
    FILE *file = path ? fopen(path, "a") : NULL;
    if (file) { fprintf(file, "%s %s\n", what, name ? name : "?"); fclose(file); }
}
int getaddrinfo(const char *name, const char *service, const struct addrinfo *hints,
                struct addrinfo **found) {
    note("getaddrinfo", name); *found = NULL; return EAI_AGAIN;
}
struct hostent *gethostbyname(const char *name) { note("gethostbyname", name); return NULL; }
struct hostent *gethostbyname2(const char *name, int family) {
    note("gethostbyname2", name); return NULL;
}
int connect(int file, const struct sockaddr *address, socklen_t size) {
    if (address->sa_family == AF_INET || address->sa_family == AF_INET6) {
        note("connect", "internet"); errno = ENETUNREACH; return -1;
    }
    int (*next)(int, const struct sockaddr *, socklen_t) = dlsym(RTLD_NEXT, "connect");
    return next(file, address, size);
}
ssize_t sendto(int file, const void *data, size_t size, int flags,
               const struct sockaddr *address, socklen_t length) {
    if (address && (address->sa_family == AF_INET || address->sa_family == AF_INET6)) {
        note("sendto", "internet"); errno = ENETUNREACH; return -1;
    }
    ssize_t (*next)(int, const void *, size_t, int, const struct sockaddr *, socklen_t) =
        dlsym(RTLD_NEXT, "sendto");
    return next(file, data, size, flags, address, length);
}
"""


@pytest.fixture(scope="module")
def trap(tmp_path_factory: pytest.TempPathFactory) -> Path:
    compiler = shutil.which("cc") or shutil.which("gcc")
    if compiler is None or not sys.platform.startswith("linux"):
        pytest.skip("name look-ups are trapped by a library for Linux, which needs a C compiler")
    folder = tmp_path_factory.mktemp("trap")
    (folder / "trap.c").write_text(TRAP)
    words = [compiler, "-shared", "-fPIC", "-o", "trap.so", "trap.c", "-ldl"]
    subprocess.run(words, cwd=folder, check=True)
    return folder / "trap.so"


def looked_up(trap: Path, folder: Path, words: list[str]) -> str:
    """What was asked for while a command ran; it must succeed."""
    told = folder / "looked-up.txt"
    told.write_text("")
    home = folder / "home"
    home.mkdir(exist_ok=True)
    env = os.environ | {
        "LD_PRELOAD": str(trap),
        "TRAP_FILE": str(told),
        "HOME": str(home),
        "XDG_CACHE_HOME": str(home / "cache"),
    }
    env.pop("ORT_DISABLE_TELEMETRY", None)
    done = subprocess.run(words, env=env, capture_output=True, text=True, timeout=300, check=False)
    assert done.returncode == 0, done.stderr
    assert not list(home.rglob("*onnxruntime*"))
    return told.read_text()


def test_the_trap_works(trap: Path, tmp_path: Path) -> None:
    code = (
        "import socket, contextlib\n"
        "with contextlib.suppress(OSError):\n"
        "    socket.getaddrinfo('host.invalid', 80)"
    )
    assert "getaddrinfo host.invalid" in looked_up(trap, tmp_path, [sys.executable, "-c", code])


def test_reading_a_facade_looks_nothing_up(trap: Path, photo: Path, tmp_path: Path) -> None:
    words = command("facade", "--rectified", photo, "-o", tmp_path / "out")
    assert looked_up(trap, tmp_path, words) == ""


def test_reading_text_looks_nothing_up(trap: Path, tmp_path: Path) -> None:
    """The engine that reads the words of plans is onnxruntime, in processes of its own."""
    code = (
        "import veduta, numpy as np\n"
        "from veduta.plan.text.engine import read_line\n"
        "print(read_line(np.full((48, 160, 3), 255, np.uint8)))\n"
        "import onnxruntime, time\n"
        "time.sleep(2)"
    )
    assert looked_up(trap, tmp_path, [sys.executable, "-c", code]) == ""


def test_deriving_looks_nothing_up(trap: Path, tmp_path: Path) -> None:
    rules = tmp_path / "box.cga"
    rules.write_text("Lot --> extrude(9)")
    words = command("grammar", "derive", rules, "-o", tmp_path / "out")
    assert looked_up(trap, tmp_path, words) == ""


def test_exporting_looks_nothing_up(trap: Path, one_house: Path, tmp_path: Path) -> None:
    for name in ("x.usda", "x.gpkg", "x.gml", "x.glb"):
        words = command("export", one_house, tmp_path / name)
        assert looked_up(trap, tmp_path, words) == ""
