"""What dicts hold."""

from __future__ import annotations

from typing import Dict, TypedDict

import numpy as np
from numpy.typing import NDArray


class Series(TypedDict):
    """Figures at the start, at every frame and at the end. Energies are in J; contacts are those of rigid bodies, without
    those of cloth and rope in small steps; relaxations are of a step."""

    time: NDArray[np.float64]
    kinetic_energy: NDArray[np.float64]
    potential_energy: NDArray[np.float64]
    contacts: NDArray[np.uint64]
    max_strain: NDArray[np.float32]
    relaxations: NDArray[np.uint64]


class Parameter(TypedDict):
    """What can be chosen about a named scene."""

    description: str
    default: float
    min: float
    max: float


class NamedScene(TypedDict):
    """A scene with a name and parameters."""

    name: str
    description: str
    parameters: Dict[str, Parameter]
