"""The files of a house that a second process makes: drawings, IFC and CityJSON, then X3D."""

from __future__ import annotations

from veduta.plan.building import CITY_MODEL, SCENE, Building, BuildingFiles, Visit
from veduta.plan.drawing import draw
from veduta.plan.outputs.cityjson import house_cityjson
from veduta.plan.outputs.dxf import plan_dxf
from veduta.plan.outputs.ifc import house_ifc
from veduta.plan.outputs.svg import plan_svg
from veduta.plan.outputs.x3d import house_x3d


def files_of(what: Building | Visit) -> BuildingFiles:
    """Nothing is written: a second process does it, while the tour is sought or models written."""
    return _building_files(what) if isinstance(what, Building) else _scene_file(what)


def _building_files(building: Building) -> BuildingFiles:
    house, options = building.house, building.options
    drawings = [draw(space) for space in house.spaces]
    city, notes = house_cityjson(house, options)
    contents = {
        "plan.svg": plan_svg(drawings),
        "plan.dxf": plan_dxf(drawings),
        "house.ifc": house_ifc(house, options, building.site),
        CITY_MODEL: city,
    }
    return BuildingFiles(contents, notes)


def _scene_file(visit: Visit) -> BuildingFiles:
    building = visit.building
    scene = house_x3d(
        building.house, building.options, visit.start, tours=visit.tours, others=visit.others,
        site=building.site, backdrop=visit.backdrop,
    )  # fmt: skip
    return BuildingFiles({SCENE: scene}, [])
