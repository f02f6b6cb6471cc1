"""Recordings as Universal Scene Description, by the package ``usd-core``."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any, Set

import numpy as np

if TYPE_CHECKING:
    from ._engine import Recording


def write_usd(recording: "Recording", path: Path) -> None:
    """Writes ``.usd``, ``.usda`` or ``.usdc``: Y up, metres, a time sample for each frame.

    What is rigid is a mesh whose transform moves, what deforms a mesh whose points do. A mesh is named after its track.
    """
    from pxr import Gf, Sdf, Usd, UsdGeom, Vt

    stage = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    stage.SetTimeCodesPerSecond(recording.frame_rate)
    stage.SetFramesPerSecond(recording.frame_rate)
    stage.SetStartTimeCode(0)
    stage.SetEndTimeCode(recording.frame_count - 1)
    root = UsdGeom.Xform.Define(stage, "/recording")
    stage.SetDefaultPrim(root.GetPrim())
    names: Set[str] = set()
    for track in recording.tracks:
        name = _prim_name(track, names)
        mesh = UsdGeom.Mesh.Define(stage, Sdf.Path("/recording").AppendChild(name))
        mesh.GetPrim().SetMetadata("comment", track)
        triangles = recording.triangles(track).astype(np.int32)
        mesh.CreateFaceVertexIndicesAttr(Vt.IntArray.FromNumpy(triangles.ravel()))
        mesh.CreateFaceVertexCountsAttr(Vt.IntArray.FromNumpy(np.full(len(triangles), 3, np.int32)))
        # Triangles are the surface itself, not a cage of it.
        mesh.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
        mesh.CreateDoubleSidedAttr(recording.is_sheet(track))
        color = Gf.Vec3f(*(_linear(channel) for channel in recording.color(track)))
        mesh.CreateDisplayColorAttr([color])
        _write_motion(recording, track, mesh)
    _export(stage, path)


def _write_motion(recording: "Recording", track: str, mesh: Any) -> None:
    from pxr import Gf, UsdGeom, Vt

    points = mesh.CreatePointsAttr()
    extent = mesh.CreateExtentAttr()
    poses = recording.poses(track)
    if poses is not None:
        vertices = recording.vertices(track)
        points.Set(Vt.Vec3fArray.FromNumpy(vertices))
        extent.Set(_extent(vertices))
        place = mesh.AddTranslateOp(UsdGeom.XformOp.PrecisionFloat)
        turn = mesh.AddOrientOp(UsdGeom.XformOp.PrecisionFloat)
        for frame, (x, y, z, i, j, k, w) in enumerate(poses.tolist()):
            place.Set(Gf.Vec3f(x, y, z), frame)
            turn.Set(Gf.Quatf(w, i, j, k), frame)
        return
    positions = recording.positions(track)
    if len(positions) == 1:
        points.Set(Vt.Vec3fArray.FromNumpy(positions[0]))
        extent.Set(_extent(positions[0]))
        return
    for frame, shape in enumerate(positions):
        points.Set(Vt.Vec3fArray.FromNumpy(np.ascontiguousarray(shape)), frame)
        extent.Set(_extent(shape), frame)


def _extent(points: "np.ndarray[Any, np.dtype[np.float32]]") -> Any:
    from pxr import Vt

    return Vt.Vec3fArray.FromNumpy(np.stack([points.min(axis=0), points.max(axis=0)]))


def _linear(channel: int) -> float:
    """From sRGB, 0 to 255."""
    value = channel / 255
    return value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4


def _prim_name(track: str, names: Set[str]) -> str:
    """A name that USD takes, and that no other track has."""
    from pxr import Tf

    name = Tf.MakeValidIdentifier(track)
    while name in names:
        name += "_"
    names.add(name)
    return str(name)


def _export(stage: Any, path: Path) -> None:
    """Beside the place where it belongs, then moved there: it is there whole or not at all."""
    with tempfile.TemporaryDirectory(prefix=".tautline-", dir=path.parent) as folder:
        part = Path(folder) / path.name
        if not stage.GetRootLayer().Export(str(part)):
            raise OSError(f"{path}: USD could not write it")
        os.replace(part, path)
