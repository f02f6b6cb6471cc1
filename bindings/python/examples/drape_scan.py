"""Drapes a cloth over a scanned mesh, and exports it to USD.

    python drape_scan.py [FOLDER [SCAN]]

SCAN is an .obj or .stl, in m, Y up; without one, a boulder is made up.
"""

import sys
from pathlib import Path

import numpy as np

import tautline as tl


def boulder(radius: float) -> "tuple[np.ndarray, np.ndarray]":
    """A sphere with bumps, as triangles."""
    sphere = tl.Shape.sphere(radius)
    points = sphere.positions.astype(float)
    bumps = 1 + 0.12 * np.sin(7 * points[:, :1]) * np.cos(5 * points[:, 1:2] + 1) + 0.08 * np.sin(9 * points[:, 2:])
    return points * bumps, sphere.triangles


folder = Path(sys.argv[1] if len(sys.argv) > 1 else "out")
folder.mkdir(parents=True, exist_ok=True)
positions, triangles = tl.read_mesh(sys.argv[2]) if len(sys.argv) > 2 else boulder(0.5)
positions = positions - [0, positions[:, 1].min(), 0]  # It stands on the floor.
top, width = positions[:, 1].max(), np.ptp(positions, axis=0).max()

world = tl.World(name="drape")
world.add(tl.HalfSpace(), name="floor")
world.add(tl.RigidBody(tl.Shape.triangle_mesh(positions, triangles), motion="fixed"), name="scan")
sheet = tl.Grid(40, 40, 2 * width, 2 * width)
cloth = world.add(tl.Cloth(sheet, position=(0, 1.1 * top, 0), density=0.2, friction=0.4), name="cloth")

recording = world.run(1.5, every=2)
recording.save(folder / "drape.usdc")
recording.save(folder / "drape.png")
print(f"the cloth covers what is {top:.2f} m high, and is strained by {100 * world.strain[0]:.1f} % at most")

heights = cloth.positions[:, 1]
assert heights.max() > 0.9 * top, "it lies on the scan"
assert heights.min() < 0.5 * top, "and hangs down its sides"
