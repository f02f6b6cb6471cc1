"""What workers of the tests do: functions that every process can import."""

import os
import signal
import time
from pathlib import Path
from typing import Any

import tautline as tl


def drape(height: float, columns: int) -> tl.World:
    """A cloth that falls from a height (m)."""
    world = tl.World()
    world.add(tl.HalfSpace())
    world.add(tl.Cloth(tl.Grid(int(columns), 6, 1, 1), position=(0, height, 0)), name="cloth")
    return world


def lowest(world: tl.World, recording: tl.Recording) -> float:
    """Of the cloth's particles, in m."""
    return float(world["cloth"].positions[:, 1].min())


class Logged:
    """Makes a world and notes in a folder that a run began; the first one to come here with a deadly height, or every one,
    kills its process."""

    def __init__(self, folder: Path, deadly: float = -1, always: bool = False) -> None:
        self.folder = folder
        self.deadly = deadly
        self.always = always

    def __call__(self, height: float, columns: int) -> tl.World:
        descriptor, _ = _new_file(self.folder, f"{height}-{columns}-")
        os.close(descriptor)
        dead = self.folder / "dead"
        if height == self.deadly and (self.always or not dead.exists()):
            dead.touch()
            os.kill(os.getpid(), signal.SIGKILL)
        time.sleep(0.01)
        return drape(height, columns)

    def begun(self, height: float, columns: int) -> int:
        """How often a run began."""
        return len(list(self.folder.glob(f"{height}-{columns}-*")))


def process(number: int) -> int:
    """Which one this runs in."""
    time.sleep(0.05)
    return os.getpid()


def _new_file(folder: Path, prefix: str) -> Any:
    import tempfile

    return tempfile.mkstemp(prefix=prefix, dir=folder)
