"""Opens a.usdc and a.pc2 of a folder in Blender, and compares each vertex in every frame with a.npz.

    python blender.py FOLDER

It takes the package ``bpy``; the tests run it where that is installed.
"""

import sys
from pathlib import Path
from typing import Any, Tuple

import bpy
import numpy as np

folder = Path(sys.argv[1])
arrays = np.load(folder / "a.npz")
frames = len(arrays["times"])
# As a share of how large things are, or in m: Blender turns everything to Z up with f32.
ROUNDING = 1e-6


def vertices(thing: Any, frame: int) -> Tuple[np.ndarray, np.ndarray]:
    """Of an object with its modifiers at a frame: in its own frame, and in the world with Y up."""
    bpy.context.scene.frame_set(frame)
    shown = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = shown.to_mesh()
    own = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", own)
    matrix = np.array(shown.matrix_world)
    x, y, z = (own.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3]).T
    return own.reshape(-1, 3), np.stack([x, z, -y], axis=1)


def expected(track: str, frame: int) -> np.ndarray:
    """Where its vertices are in the recording."""
    if f"{track}/positions" in arrays:
        return arrays[f"{track}/positions"][frame]
    if f"{track}/poses" not in arrays:
        return arrays[f"{track}/vertices"]
    position, (x, y, z, w) = np.split(arrays[f"{track}/poses"][frame].astype(float), [3])
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return arrays[f"{track}/vertices"] @ (np.eye(3) + 2 * w * cross + 2 * cross @ cross).T + position


def difference(positions: np.ndarray, others: np.ndarray) -> float:
    """The largest, as a share of how large they are, or in m."""
    return float(np.abs(positions - others).max() / max(1, np.abs(others).max()))


bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.wm.usd_import(filepath=str(folder / "a.usdc"))
assert (bpy.context.scene.frame_start, bpy.context.scene.frame_end) == (0, frames - 1)
largest = 0.0
for track in arrays["names"]:
    thing = bpy.data.objects[track.replace(" ", "_")]
    for frame in range(frames):
        own, placed = vertices(thing, frame)
        if f"{track}/positions" in arrays:
            assert np.array_equal(own, arrays[f"{track}/positions"][frame]), (track, frame)
        largest = max(largest, difference(placed, expected(track, frame)))
print(f"Blender {bpy.app.version_string} opens a.usdc; {frames} frames, vertices are off by {largest:.1e} at most")
assert largest < ROUNDING

bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.wm.obj_import(filepath=str(folder / "a.obj"))
(thing,) = bpy.data.objects
cache = thing.modifiers.new("cache", "MESH_CACHE")
cache.cache_format, cache.filepath = "PC2", str(folder / "a.pc2")
largest = 0.0
for frame in range(frames):
    own, placed = vertices(thing, frame)
    whole = np.concatenate([expected(track, frame) for track in arrays["names"]])
    assert own.shape == whole.shape
    largest = max(largest, difference(own, whole), difference(placed, whole))
print(f"and a.pc2 with a.obj; vertices are off by {largest:.1e} at most")
assert largest < ROUNDING
