"""Reproduces the paper's chart 9(c): relaxations a step for icosahedra in a room, with sticks in ordered lists and not.

    python paper_chart.py [FOLDER]
"""

import sys
from pathlib import Path

from matplotlib.figure import Figure

import tautline as tl

COUNTS = range(5, 26, 5)
SECONDS = 3


def relaxations(count: int, ordering: str) -> float:
    """A step, in the mean."""
    document = tl.Scene.named("icosahedra", n=count).to_dict()
    document["settings"].update(solver="paper", ordering=ordering)
    recording = tl.Scene(document).run(SECONDS, record=False, every=1)
    return float(recording.series["relaxations"].mean())


folder = Path(sys.argv[1] if len(sys.argv) > 1 else "out")
folder.mkdir(parents=True, exist_ok=True)
lines = {name: [relaxations(n, name) for n in COUNTS] for name in ("by-distance", "as-built")}
figure = Figure(figsize=(6, 4), layout="constrained")
axes = figure.subplots()
axes.plot(COUNTS, lines["by-distance"], "o-", label="ordered by graph distance")
axes.plot(COUNTS, lines["as-built"], "s--", label="in one order")
axes.set_xlabel("icosahedra")
axes.set_ylabel("relaxations a step")
axes.legend(frameon=False)
axes.grid(alpha=0.25)
figure.savefig(folder / "chart_9c.png", dpi=120)
for n, ordered, unordered in zip(COUNTS, lines["by-distance"], lines["as-built"]):
    print(f"{n:3} icosahedra: {ordered:7.1f} relaxations a step in ordered lists, {unordered:7.1f} in one order")

assert all(more > less for less, more in zip(lines["by-distance"], lines["by-distance"][1:])), "more bodies, more to do"
