"""Meshes from and to trimesh."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Optional, Tuple

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from ._engine import Body, Recording


def from_trimesh(mesh: Any) -> Tuple[NDArray[np.float32], NDArray[np.uint32]]:
    """The vertices (n, 3) in m and the triangles (m, 3) of a ``trimesh.Trimesh``, for ``Shape.from_mesh``, ``Cloth`` and
    ``SoftSolid``."""
    return np.asarray(mesh.vertices, dtype=np.float32), np.asarray(mesh.faces, dtype=np.uint32)


def to_trimesh(body: "Body") -> Any:
    """The surface of a body where it is now, in m, as a ``trimesh.Trimesh`` with its vertices in the engine's order."""
    import trimesh

    return trimesh.Trimesh(body.surface_positions, body.triangles, process=False)


def recording_to_trimesh(recording: "Recording", track: str, frame: Optional[int] = None) -> Any:
    """The surface of a track at a frame, the last if absent, in m, as a ``trimesh.Trimesh``."""
    import trimesh

    positions = recording.positions(track)
    index = len(positions) - 1 if frame is None else min(frame, len(positions) - 1)
    return trimesh.Trimesh(positions[index], recording.triangles(track), process=False)


def line(start: Any, end: Any, segments: int) -> NDArray[np.float32]:
    """Points (segments + 1, 3) from ``start`` to ``end`` (m), for a straight ``Rope``."""
    return np.linspace(np.asarray(start, float), np.asarray(end, float), segments + 1, dtype=np.float32)
