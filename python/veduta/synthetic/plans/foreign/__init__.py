"""Six more ways in which strangers draw: hair lines, colours, prints, permits, pages, squares."""
