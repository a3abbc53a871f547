"""Sky in a roof's texture, shadows of balconies, whole vehicles, and guesses in the roof."""

from __future__ import annotations

import numpy as np
from sample_document import EAVES_PX, METRES_PER_PX, element, sample_document

from veduta.facade.cleared.kinds import KINDS, hidden_kinds
from veduta.facade.cleared.shadows import shadows_below
from veduta.facade.cleared.surface import clear_surface
from veduta.facade.eyes import Seen
from veduta.facade.photo_masks import PixelBox
from veduta.facade.sky_fringe import sky_with_fringe, without_sky

ROOF, SKY, WALL = (90, 60, 50), (215, 222, 230), (210, 190, 160)


def test_the_fringe_goes_with_the_sky_and_the_roof_goes_on() -> None:
    picture = np.full((120, 160, 3), ROOF, np.uint8)
    picture[:40] = SKY
    picture[40:43] = (170, 165, 165)  # mixed
    picture[43:50, 60:80] = (212, 220, 228)  # sky that was not found
    sky = np.zeros((120, 160), np.bool_)
    sky[:41] = True
    whole = sky_with_fringe(picture, sky)
    assert whole[:43].all()
    assert whole[43:49, 61:79].all()
    assert not whole[60:].any()
    made = without_sky(picture, whole, (90 / 255, 60 / 255, 50 / 255))
    assert np.abs(made.astype(int) - ROOF).max() <= 40
    assert np.array_equal(made[60:], picture[60:])
    nothing = np.zeros_like(sky)
    assert np.array_equal(without_sky(picture, nothing, (0.3, 0.2, 0.2)), picture)
    assert not sky_with_fringe(picture, nothing).any()


def test_a_shadow_is_what_is_dark_right_below_a_balcony() -> None:
    picture = np.full((200, 100, 3), WALL, np.uint8)
    picture[60:75, 10:60] = np.array(WALL) * 0.6
    picture[90:95, 10:60] = np.array(WALL) * 0.6  # a course further down
    picture[60:70, 70:90] = (60, 110, 60)  # a plant
    wall = np.ones((200, 100), np.bool_)
    wall[40:60, 10:60] = False
    found = shadows_below(picture, wall, [(slice(40, 60), slice(10, 60))], 120.0)
    assert found[60:75, 10:60].all()
    assert found.sum() == 15 * 50
    assert not shadows_below(picture, wall, [], 120.0).any()
    lit = np.full_like(picture, 200)
    assert not shadows_below(lit, wall, [(slice(40, 60), slice(10, 60))], 120.0).any()


def test_a_vehicle_is_taken_whole() -> None:
    names = ("window", "wall", *KINDS[1:])
    classes = np.zeros((len(names), 100, 100), np.float32)
    classes[1] = 1.0
    vehicle = names.index("vehicle")
    classes[vehicle, 80:98, 20:60] = 0.9
    classes[1, 80:98, 20:60] = 0.1
    # Its cab is hardly seen as one, and its windscreen not at all.
    classes[vehicle, 66:80, 20:40] = 0.2
    classes[0, 84:90, 30:40], classes[vehicle, 84:90, 30:40] = 0.9, 0.0
    empty = np.zeros((1, 50, 50), np.float32)
    borders = np.zeros((4, 50, 50), np.float32)
    seen = Seen(names, ("window",), classes, empty, borders, 1.0, 1.0, 100, 100)
    kinds = hidden_kinds(seen) == KINDS.index("vehicle")
    assert kinds[66:98, 20:40].all()
    assert kinds[80:98, 20:60].all()
    assert not kinds[:60].any()


def test_a_doubtful_balcony_takes_no_dormer_out() -> None:
    dormer = element("window", 4.0, 15.4, 1.2, 1.6)
    balcony = element("balcony", 3.8, 15.4, 1.6, 0.8)
    guess = balcony.model_copy(update={"score": 0.3})
    picture = np.random.default_rng(2).integers(0, 255, (800, 520, 3)).astype(np.uint8)
    box, before = PixelBox(0, 0, 520, 800), np.zeros((800, 520), np.uint8)
    rows = slice(round(EAVES_PX - 1.2 / METRES_PER_PX), round(EAVES_PX - 0.6 / METRES_PER_PX))
    for given, filled in ((balcony, True), (guess, False)):
        cleared = clear_surface(sample_document([dormer, given]), picture, box, before)
        assert bool(cleared.filled[rows].any()) is filled
