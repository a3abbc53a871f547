"""A place as USD (`.usda`, `.usdc`, `.usd`) or as an archive with its textures (`.usdz`).

https://openusd.org - a stage in metres, z up. A part is an Xform with one Mesh, whose looks are
GeomSubsets of the family `materialBind`, each bound to a UsdPreviewSurface that is named after its
class. What each face is (`primvars:veduta:feature`, a row) and the table (`veduta:id`,
`veduta:class`, `veduta:provenance`) stand with the mesh. What moves is a SkelRoot (`usd_skel`).
"""

from __future__ import annotations

import os
import re
import shutil
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from veduta.formats.known_values import known
from veduta.formats.pictures import Pictures
from veduta.formats.shapes import Look, Shape, shapes
from veduta.formats.usd_skel import add_motion, moves
from veduta.imaging.srgb import linear_of_srgb
from veduta.place.mesh import Mesh
from veduta.place.place import Place
from veduta.run.atomic import sync_file
from veduta.run.errors import InputError

if TYPE_CHECKING:
    from pxr import Usd

_ROOT = "/Place"

_PACKED_S = 315_619_200
"""The second of January 1980 (s): the first whole day that archives can tell in any time zone."""


def write_usd(place: Place, path: Path) -> None:
    """Write the stage, and the textures beside it (in a `.usdz`: within it)."""
    try:
        from pxr import Usd, UsdUtils
    except ImportError as error:
        raise InputError(
            path, "USD is written by usd-core, which is not installed", "pip install 'veduta[usd]'"
        ) from error
    # A stage knows its textures by their place beside it: all is made together, and moved then.
    with tempfile.TemporaryDirectory(prefix=f".{path.name}.", dir=path.parent) as name:
        work = Path(name)
        packed = path.suffix.lower() == ".usdz"
        scene = work / (f"{path.stem}.usdc" if packed else path.name)
        stage = Usd.Stage.CreateNew(str(scene))
        _fill(stage, place, scene)
        stage.Save()
        del stage
        if packed:
            archive = work / "packed.usdz"
            for file in work.iterdir():
                # The archive has the times of its files: the same place gives the same bytes.
                os.utime(file, (_PACKED_S, _PACKED_S))
            if not UsdUtils.CreateNewUsdzPackage(str(scene), str(archive)):
                raise InputError(path, "USD's own packing of it failed", "Write .usdc instead.")
            sync_file(archive)
            archive.replace(path)
            return
        made = sorted(work.iterdir(), key=lambda file: file == scene)
        for file in made:
            sync_file(file)
            shutil.move(file, path.parent / file.name)


def _fill(stage: Usd.Stage, place: Place, scene: Path) -> None:
    from pxr import UsdGeom

    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    root = UsdGeom.Xform.Define(stage, _ROOT)
    stage.SetDefaultPrim(root.GetPrim())
    told = {
        name: getattr(place, name)
        for name in ("title", "description", "author", "licence", "crs", "scale")
        if getattr(place, name)
    }
    told["origin"] = " ".join(map(str, place.origin_m))
    for name, value in told.items():
        root.GetPrim().SetCustomDataByKey(f"veduta:{name}", value)
    UsdGeom.Scope.Define(stage, f"{_ROOT}/Looks")
    names = _PrimNames()
    pictures = Pictures(scene)
    looks: dict[str, Any] = {}
    for shape in shapes(place):
        mesh = _mesh(stage, shape, names)
        for look, rows in shape.by_look():
            if look.name not in looks:
                looks[look.name] = _material(stage, look, pictures.name(look), names)
            _bind(mesh, look, rows, looks[look.name])


class _PrimNames:
    """Names that prims may have, each once."""

    def __init__(self) -> None:
        self._taken: dict[str, int] = {}

    def unique(self, name: str) -> str:
        """The name with what may not be in it replaced, and a number where it is taken."""
        plain = re.sub(r"[^A-Za-z0-9_]", "_", name) or "_"
        plain = f"_{plain}" if plain[0].isdigit() else plain
        count = self._taken[plain] = self._taken.get(plain, 0) + 1
        return plain if count == 1 else self.unique(f"{plain}_{count}")


def _mesh(stage: Usd.Stage, shape: Shape, names: _PrimNames) -> Any:
    """The mesh of a part, in the frame of the place."""
    from pxr import Sdf, UsdGeom, UsdSkel, Vt

    kind = UsdSkel.Root if moves(shape.content) else UsdGeom.Xform
    above = kind.Define(stage, f"{_ROOT}/{names.unique(shape.placed.id)}")
    above.GetPrim().SetDisplayName(shape.placed.standing.name or shape.placed.id)
    for name, value in known(shape.content.attributes).items():
        above.GetPrim().SetCustomDataByKey(f"veduta:{re.sub('[^A-Za-z0-9_]', '_', name)}", value)
    mesh = UsdGeom.Mesh.Define(stage, above.GetPath().AppendChild("Mesh"))
    own = shape.triangles
    points = own.positions_m.astype(np.float32)
    mesh.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(np.ascontiguousarray(points)))
    counts = np.full(len(own.corners), 3, dtype=np.int32)
    mesh.CreateFaceVertexCountsAttr(Vt.IntArray.FromNumpy(counts))
    corners = np.ascontiguousarray(own.corners.reshape(-1).astype(np.int32))
    mesh.CreateFaceVertexIndicesAttr(Vt.IntArray.FromNumpy(corners))
    mesh.CreateNormalsAttr(Vt.Vec3fArray.FromNumpy(own.normals.astype(np.float32)))
    mesh.SetNormalsInterpolation(UsdGeom.Tokens.vertex)
    mesh.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
    if len(points):
        box = np.stack([points.min(axis=0), points.max(axis=0)])
        mesh.CreateExtentAttr(Vt.Vec3fArray.FromNumpy(box))
    api = UsdGeom.PrimvarsAPI(mesh)
    uv = np.column_stack([own.uv[:, 0], 1.0 - own.uv[:, 1]]).astype(np.float32)
    kinds = Sdf.ValueTypeNames
    api.CreatePrimvar("st", kinds.TexCoord2fArray, UsdGeom.Tokens.vertex).Set(
        Vt.Vec2fArray.FromNumpy(np.ascontiguousarray(uv))
    )
    api.CreatePrimvar("veduta:feature", kinds.IntArray, UsdGeom.Tokens.uniform).Set(
        Vt.IntArray.FromNumpy(own.feature.astype(np.int32))
    )
    if own.colours is not None:
        light = linear_of_srgb(own.colours / 255.0).astype(np.float32)
        mesh.CreateDisplayColorPrimvar(UsdGeom.Tokens.vertex).Set(Vt.Vec3fArray.FromNumpy(light))
    features, rows = shape.features, range(len(shape.features))
    columns = {
        "id": list(features.id),
        "class": [features.semantic(row).value for row in rows],
        "provenance": [features.provenance(row).value for row in rows],
    }
    for name, texts in columns.items():
        attribute = mesh.GetPrim().CreateAttribute(f"veduta:{name}", kinds.StringArray)
        attribute.Set(Vt.StringArray(texts))
    if isinstance(shape.content, Mesh) and moves(shape.content):
        transform = shape.placed.standing.transform
        add_motion(stage, above.GetPath(), mesh, shape.content, transform)
    return mesh


def _bind(mesh: Any, look: Look, rows: Any, material: Any) -> None:
    from pxr import UsdGeom, UsdShade, Vt

    subset = UsdGeom.Subset.CreateGeomSubset(
        mesh,
        re.sub(r"[^A-Za-z0-9_]", "_", look.name),
        UsdGeom.Tokens.face,
        Vt.IntArray.FromNumpy(rows.astype(np.int32)),
        UsdShade.Tokens.materialBind,
        UsdGeom.Tokens.partition,
    )
    UsdShade.MaterialBindingAPI.Apply(mesh.GetPrim())
    UsdShade.MaterialBindingAPI.Apply(subset.GetPrim()).Bind(material)


def _material(stage: Usd.Stage, look: Look, picture: str | None, names: _PrimNames) -> Any:
    """A UsdPreviewSurface with the colour or the texture of a look."""
    from pxr import Gf, Sdf, UsdShade

    at = Sdf.Path(f"{_ROOT}/Looks/{names.unique(look.name)}")
    material, shader = (
        UsdShade.Material.Define(stage, at),
        UsdShade.Shader.Define(stage, at.AppendChild("Surface")),
    )
    shader.CreateIdAttr("UsdPreviewSurface")
    own, kinds = look.material, Sdf.ValueTypeNames
    light = [float(value) for value in linear_of_srgb(np.array(own.colour))]
    for name, value in (
        ("roughness", own.roughness), ("metallic", own.metalness), ("opacity", own.opacity)
    ):  # fmt: skip
        shader.CreateInput(name, kinds.Float).Set(float(value))
    if own.glow > 0.0:
        glow = Gf.Vec3f(*(own.glow * value for value in light))
        shader.CreateInput("emissiveColor", kinds.Color3f).Set(glow)
    diffuse = shader.CreateInput("diffuseColor", kinds.Color3f)
    if picture is None:
        diffuse.Set(Gf.Vec3f(*light))
    else:
        reader = UsdShade.Shader.Define(stage, at.AppendChild("st"))
        reader.CreateIdAttr("UsdPrimvarReader_float2")
        reader.CreateInput("varname", kinds.String).Set("st")
        texture = UsdShade.Shader.Define(stage, at.AppendChild("Texture"))
        texture.CreateIdAttr("UsdUVTexture")
        texture.CreateInput("file", kinds.Asset).Set(Sdf.AssetPath(f"./{picture}"))
        texture.CreateInput("sourceColorSpace", kinds.Token).Set("sRGB")
        texture.CreateInput("scale", kinds.Float4).Set(Gf.Vec4f(*light, 1.0))
        for axis in ("wrapS", "wrapT"):
            texture.CreateInput(axis, kinds.Token).Set("repeat")
        texture.CreateInput("st", kinds.Float2).ConnectToSource(
            reader.CreateOutput("result", kinds.Float2)
        )
        diffuse.ConnectToSource(texture.CreateOutput("rgb", kinds.Float3))
    material.CreateSurfaceOutput().ConnectToSource(shader.CreateOutput("surface", kinds.Token))
    return material
