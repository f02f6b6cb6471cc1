"""Scenes that tests share."""

import json
from pathlib import Path
from typing import Dict

import pytest

import tautline as tl

ROOT = Path(__file__).resolve().parents[3]


@pytest.fixture
def drape() -> tl.World:
    """A floor, a fixed cube, and a cloth that falls on it."""
    world = tl.World()
    world.add(tl.HalfSpace(), name="floor")
    cube = tl.Shape.cuboid((0.5, 0.5, 0.5))
    world.add(tl.RigidBody(cube, position=(0, 0.5, 0), motion="fixed"), name="cube")
    world.add(tl.Cloth(tl.Grid(10, 10, 2, 2), position=(0, 1.2, 0)), name="cloth")
    return world


@pytest.fixture(scope="session")
def golden() -> Dict[str, str]:
    """The hashes that the engine's own tests expect after 120 steps, by scene and solver."""
    path = ROOT / "crates/tautline-scene/tests/golden_hashes.json"
    return {name: entry["hash"] for name, entry in json.loads(path.read_text()).items()}
