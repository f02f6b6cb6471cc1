"""Rigid bodies, cloth and rope in one world, deterministic to the bit.

Metres, kilograms, seconds, radians; right-handed, Y up; quaternions are x, y, z, w; triangles run counter-clockwise seen
from outside. Vectors are any sequences of three numbers; points are arrays of the shape (n, 3).

>>> import tautline as tl
>>> world = tl.World()
>>> floor = world.add(tl.HalfSpace())
>>> box = world.add(tl.RigidBody(tl.Shape.cuboid((0.5, 0.5, 0.5)), position=(0, 2, 0), mass=2))
>>> recording = world.run(2)
>>> abs(box.position[1] - 0.5) < 0.01
True
"""

from ._engine import (
    Anchor,
    Attachment,
    Batch,
    Body,
    Cloth,
    ContactEvent,
    Distance,
    Grab,
    Grid,
    HalfSpace,
    Hit,
    Joint,
    Lattice,
    Recording,
    RigidBody,
    Rope,
    Scene,
    Settings,
    Shape,
    SoftSolid,
    StepReport,
    World,
    __version__,
    distance,
    read_mesh,
    scenes,
    set_threads,
)
from ._errors import (
    InvalidValueError,
    MeshError,
    SceneError,
    SnapshotError,
    StaleHandleError,
    TautlineError,
)
from ._mesh import from_trimesh, line, recording_to_trimesh, to_trimesh
from ._ray import RayExecutor
from ._sweep import sweep
from ._validate import validate

__all__ = [
    "Anchor",
    "Attachment",
    "Batch",
    "Body",
    "Cloth",
    "ContactEvent",
    "Distance",
    "Grab",
    "Grid",
    "HalfSpace",
    "Hit",
    "InvalidValueError",
    "Joint",
    "Lattice",
    "MeshError",
    "RayExecutor",
    "Recording",
    "RigidBody",
    "Rope",
    "Scene",
    "SceneError",
    "Settings",
    "Shape",
    "SnapshotError",
    "SoftSolid",
    "StaleHandleError",
    "StepReport",
    "TautlineError",
    "World",
    "__version__",
    "distance",
    "from_trimesh",
    "line",
    "read_mesh",
    "recording_to_trimesh",
    "scenes",
    "set_threads",
    "sweep",
    "to_trimesh",
    "validate",
]

# Whoever reads a traceback knows them as tautline's own.
for _error in (InvalidValueError, MeshError, SceneError, SnapshotError, StaleHandleError, TautlineError):
    _error.__module__ = __name__
