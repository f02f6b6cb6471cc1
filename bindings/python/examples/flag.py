"""A flag in the wind: where its tip is read from a view of the engine's memory, and a figure shows what it did.

    python flag.py [FOLDER]
"""

import sys
from pathlib import Path

import numpy as np

import tautline as tl

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "out")
folder.mkdir(parents=True, exist_ok=True)
world = tl.World(tl.Settings(wind=(6, 0, 0.5)), name="flag")
grid = tl.Grid(30, 20, 1.5, 1.0)
pole = [row * grid.columns for row in range(grid.rows)]
upright = (np.sqrt(0.5), 0, 0, np.sqrt(0.5))
flag = world.add(
    tl.Cloth(grid, position=(0, 2, 0), rotation=upright, density=0.15, drag=1.2, lift=0.8, pins=pole), name="flag"
)

view = flag.positions  # Not a copy: every step shows in it.
tip = []


def look(done: int, total: int) -> None:
    tip.append(view[-1].copy())


recording = world.run(3, every=2, progress=look)
recording.plot().savefig(folder / "flag.png")
recording.save(folder / "flag.gif", size=(320, 240), frame_rate=15)
print(f"the free edge is {view[grid.columns - 1 :: grid.columns, 0].mean():.2f} m downwind of the pole")

assert view[:, 0].max() > 0.7, "the wind carries it"
assert np.allclose(view[pole, 0], -0.75, atol=1e-5), "the pole holds it"
