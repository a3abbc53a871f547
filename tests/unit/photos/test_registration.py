"""Streets of boxes laid into their town: right, or refused."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import registration_streets
from registration import errors
from registration_streets import SimulatedStreet, simulated_street
from scipy.spatial.transform import Rotation

from veduta.photos.city.facades import facades_of
from veduta.photos.city.model import CityBuilding, CityModel
from veduta.photos.laying import walls_in_the_world
from veduta.photos.world import register as register_step
from veduta.photos.world.believed import Standing, believed
from veduta.photos.world.columns import plane_fit
from veduta.photos.world.evidence import Matches
from veduta.photos.world.free_space import sight_lines, violations
from veduta.photos.world.gauss_newton import Pose
from veduta.photos.world.georeference import Georeference, Similarity
from veduta.photos.world.georeferencing import Georeferenced
from veduta.photos.world.refine import PLANE, Refined
from veduta.photos.world.register import register
from veduta.photos.world.report import georef_notes
from veduta.photos.world.weighing import residuals_of


@pytest.fixture(scope="module", params=[2, 1], ids=["both sides", "one side"])
def street(request: pytest.FixtureRequest) -> SimulatedStreet:
    return simulated_street(30, streets=2, sides=request.param)


@pytest.fixture(scope="module")
def found(street: SimulatedStreet) -> Georeference:
    """The street laid into the town that it is part of."""
    return laid(street, street.model)


def laid(street: SimulatedStreet, model: CityModel) -> Georeference:
    return register(street.structure, street.walls, model, None, 0)


def test_a_street_in_the_model_is_laid_where_it_is(
    street: SimulatedStreet, found: Georeference
) -> None:
    again = laid(street, street.model)
    assert found.accepted, found.why
    apart, turned = errors(street, found)
    assert 0.0 < apart < 0.3
    assert 0.0 < turned < 0.5
    assert found.best is not None
    assert (found.best.shift_sd_m > 0.005).all()
    assert (found.best.shift_sd_m < 0.3).all()
    assert found.crs == "EPSG:25832"
    assert len(found.best.residuals) >= 5
    assert again.best is not None
    assert np.array_equal(
        found.best.world_from_model.rotation, again.best.world_from_model.rotation
    )
    assert again.why == found.why
    assert found.notes == ()


def test_walls_come_to_stand_before_their_facades(
    street: SimulatedStreet, found: Georeference
) -> None:
    walls = walls_in_the_world(street.walls, found)
    facades = facades_of(street.model)
    middles = np.array([(wall.start + wall.end) / 2.0 for wall in walls])
    apart = np.einsum("wfi,fi->wf", middles[:, None] - facades.start, facades.outward)
    along = np.einsum("wfi,fi->wf", middles[:, None] - facades.start, facades.along)
    on = (along > 0.0) & (along < facades.width)
    nearest = np.where(on, np.abs(apart), np.inf).min(axis=1)
    # Two of the walls are none.
    assert (nearest < 0.4).sum() >= len(walls) - 3
    assert all(0.0 <= wall.bottom + 1.0 < wall.top for wall in walls)
    assert walls_in_the_world(street.walls, None) == street.walls


def test_a_wall_that_has_lost_its_facade_is_named_alone() -> None:
    """The last step of a fit may move a wall out of its facade's reach."""
    walls = simulated_street(30, streets=2, sides=1).walls[:2]
    count = len(walls)
    none = np.full((1, count, 3), np.nan)
    matches = Matches(
        facade=np.array([[[-1, -1, -1], [-1, -1, 1]]]),
        off_m=none,
        edges_m=none[..., :2],
        lift_m=np.zeros(1),
        evidence=np.zeros((1, count)),
    )
    refined = Refined(
        pose=Pose(Similarity(1.0, np.eye(3), np.zeros(3))),
        covariance=np.eye(7),
        wall=np.array([0, 0, 1, 1]),
        kind=np.array([PLANE, PLANE, PLANE, PLANE + 1]),
        left_m=np.array([3.0, 4.0, 0.5, 9.0]),
        weight=np.ones(4),
    )
    found = residuals_of(refined, matches, walls, ["north", "south"])
    assert [one.name for one in found] == [f"{walls[0].id} at no facade", f"{walls[1].id} at south"]
    assert [one.distance_m for one in found] == pytest.approx([np.sqrt(12.5), 0.5])


def test_a_street_that_is_not_in_the_model_is_refused(street: SimulatedStreet) -> None:
    found = laid(street, street.removed)
    assert not found.accepted
    assert found.why


def test_a_street_that_is_there_twice_is_refused(street: SimulatedStreet) -> None:
    def beside(building: CityBuilding) -> CityBuilding:
        x, y, z = building.offset_m
        return CityBuilding(f"{building.id}-copy", building.part, (x + 300.0, y + 500.0, z))

    copies = tuple(beside(one) for one in street.model.buildings)
    found = laid(street, replace(street.model, buildings=street.model.buildings + copies))
    assert not found.accepted
    assert "two placements fit nearly as well" in found.why
    assert found.second is not None


def test_a_terrace_of_equal_houses_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    def terrace(
        rng: np.random.Generator, streets: int, per_side: int
    ) -> tuple[list[tuple[float, float, float, float, float]], list[float]]:
        fronts = [(60.0 * street, side) for street in range(streets) for side in (1.0, -1.0)]
        boxes = [
            (8.0 * n, middle + (7.5 if side > 0 else -17.5), 8.0, 10.0, 9.0)
            for middle, side in fronts
            for n in range(per_side)
        ]
        return boxes, [60.0 * street for street in range(streets)]

    monkeypatch.setattr(registration_streets, "_town", terrace)
    street = simulated_street(1, streets=2)
    assert not laid(street, street.model).accepted


def test_a_refinement_that_runs_away_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    def away(refined: Refined, *_: object) -> Refined:
        world = refined.world_from_model
        moved = replace(world, shift=world.shift + 10.0)
        return replace(refined, pose=replace(refined.pose, similarity=moved))

    monkeypatch.setattr(register_step, "refine_by_points", away)
    street = simulated_street(4, streets=1)
    found = laid(street, street.model)
    assert found.best is not None
    assert errors(street, found)[0] < 1.0
    notes = georef_notes([Georeferenced((found,))])
    assert sum("leads away from the walls' placement" in note for note in notes) == 1


def test_too_few_walls_are_refused(street: SimulatedStreet) -> None:
    found = register(street.structure, street.walls[:2], street.model, None, 0)
    assert not found.accepted
    assert "of 3 that it takes" in found.why


def test_what_may_not_be_is_found_as_rays_find_it() -> None:
    """Against Python's own crossing of each line with each wall, and of each camera with a box."""
    street = simulated_street(4, streets=1)
    world = street.world_from_model
    lines = sight_lines(street.structure, 0)
    facades = facades_of(street.model)
    truth = violations(lines, facades, world)
    assert truth.blocked_share < 0.02
    assert truth.inside_share == 0.0
    aside = replace(world, shift=world.shift + np.array([6.0, 9.0, 0.0]))
    found = violations(lines, facades, aside)
    rows = range(0, len(lines.point), 40)
    for row in rows:
        start, end = aside.moved(np.stack([lines.centre[row], lines.point[row]]))
        expected = False
        for one in range(len(facades)):
            before = float((start[:2] - facades.start[one]) @ facades.outward[one])
            after = float((end[:2] - facades.start[one]) @ facades.outward[one])
            if before > 0.0 and after < -1.0:
                meets = start + before / (before - after) * (end - start)
                along = float((meets[:2] - facades.start[one]) @ facades.along[one])
                inside = 0.0 < along < facades.width[one]
                expected |= bool(inside and meets[2] < facades.top[one] - 0.7)
        assert found.blocked[row] == expected
    assert found.blocked_share > 0.05


def test_the_plane_fit_is_that_in_space() -> None:
    rng = np.random.default_rng(0)
    own = rng.standard_normal((1, 6)) + 1j * rng.standard_normal((1, 6))
    world = 2.0 * np.exp(0.7j) * own + (3 + 4j) + 0.1 * rng.standard_normal((1, 6))
    found = plane_fit(own, world)
    flat = [np.column_stack([z[0].real, z[0].imag, np.zeros(6)]) for z in (own, world)]
    about = [one - one.mean(axis=0) for one in flat]
    turn, _ = Rotation.align_vectors(about[1], about[0])
    assert np.isclose(np.angle(found.turn[0]), turn.as_euler("xyz")[2])


STANDING = Standing(
    evidence=60.0, second=20.0, chance=20.0, walls=8, explained=0.9, blocked=0.01, inside=0.0,
    covariance=np.diag([1e-6, 1e-6, 1e-6, 1e-6, 1e-3, 1e-3, 1e-3]),
)  # fmt: skip


@pytest.mark.parametrize(
    ("change", "why"),
    [
        ({"evidence": 25.0, "second": None}, "chance"),
        ({"second": 55.0}, "two placements"),
        ({"walls": 2}, "only 2 walls"),
        ({"explained": 0.3}, "explains only 30 %"),
        ({"blocked": 0.4}, "stand before 40 %"),
        ({"inside": 0.5}, "inside of buildings"),
        ({"covariance": np.diag([1e-6, 1e-6, 1e-6, 1e-6, 1.0, 1e-3, 1e-3])}, "the place"),
    ],
)
def test_each_reason_refuses_by_itself(change: dict[str, object], why: str) -> None:
    assert believed(STANDING)[0]
    accepted, told = believed(replace(STANDING, **change))  # type: ignore[arg-type]
    assert not accepted
    assert why in told
