"""Figures of a run over time."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING

from ._errors import missing

try:
    from matplotlib.figure import Figure
except ImportError as absent:
    raise missing("figures are drawn by matplotlib", "plot") from absent

if TYPE_CHECKING:
    from ._engine import Recording


class Plot(Figure):
    """A figure that shows itself in a notebook, whatever backend there is."""

    def _repr_png_(self) -> bytes:
        picture = io.BytesIO()
        self.savefig(picture, format="png", dpi=80)
        return picture.getvalue()


def plot(recording: "Recording") -> Figure:
    """Energy, contacts of rigid bodies and the largest strain over time, one below the other."""
    series = recording.series
    time = series["time"]
    figure = Plot(figsize=(7, 6.5), layout="constrained")
    energy, contacts, strain = figure.subplots(3, 1, sharex=True)
    kinetic, potential = series["kinetic_energy"], series["potential_energy"]
    energy.plot(time, kinetic, label="kinetic")
    energy.plot(time, potential, label="potential")
    energy.plot(time, kinetic + potential, label="sum", color="0.3", linestyle="--")
    energy.set_ylabel("energy in J")
    energy.legend(frameon=False, ncols=3)
    contacts.plot(time, series["contacts"], color="C4")
    contacts.set_ylabel("rigid contacts")
    contacts.set_ylim(bottom=0, top=max(1, 1.05 * series["contacts"].max()))
    strain.plot(time, 100 * series["max_strain"], color="C3")
    strain.set_ylabel("largest strain in %")
    strain.set_ylim(bottom=0)
    strain.set_xlabel("time in s")
    for axes in (energy, contacts, strain):
        axes.grid(alpha=0.25)
        axes.spines[["top", "right"]].set_visible(False)
        axes.margins(x=0)
    figure.suptitle(recording.name)
    return figure
