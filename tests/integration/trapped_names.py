"""A library that traps all look-ups of names, and all ways to the internet, of a process."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

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


def compiled_trap(folder: Path) -> Path | None:
    """The library, to be loaded first; None where there is no compiler, or none for the system."""
    compiler = shutil.which("cc") or shutil.which("gcc")
    if compiler is None or not sys.platform.startswith("linux"):
        return None
    (folder / "trap.c").write_text(TRAP)
    words = [compiler, "-shared", "-fPIC", "-o", "trap.so", "trap.c", "-ldl"]
    subprocess.run(words, cwd=folder, check=True)
    return folder / "trap.so"


def trapped_environment(trap: Path, folder: Path) -> dict[str, str]:
    """What sets the trap; what is asked for is written to `looked-up.txt` in the folder."""
    home = folder / "home"
    home.mkdir(exist_ok=True)
    (folder / "looked-up.txt").write_text("")
    env = os.environ | {
        "LD_PRELOAD": str(trap),
        "TRAP_FILE": str(folder / "looked-up.txt"),
        "HOME": str(home),
        "XDG_CACHE_HOME": str(home / "cache"),
    }
    env.pop("ORT_DISABLE_TELEMETRY", None)
    return env


def looked_up(folder: Path) -> str:
    """What was asked for in that environment."""
    assert not list((folder / "home").rglob("*onnxruntime*"))
    return (folder / "looked-up.txt").read_text()
