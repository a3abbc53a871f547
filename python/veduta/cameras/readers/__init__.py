"""One file for each source of cameras: `find` says whether it is there, `read` reads it."""
