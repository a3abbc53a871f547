"""What libraries complain of without need is said by no process."""

from __future__ import annotations

import warnings

from veduta.run.quiet import quiet_libraries


def test_only_what_is_right_all_the_same_is_hushed() -> None:
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        quiet_libraries()
        warnings.warn("divide by zero encountered in buffer", RuntimeWarning, stacklevel=1)
        warnings.warn("invalid value encountered in divide", RuntimeWarning, stacklevel=1)
    assert [str(one.message) for one in told] == ["invalid value encountered in divide"]
