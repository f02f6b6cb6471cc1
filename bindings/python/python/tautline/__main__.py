"""``python -m tautline``: runs a scene and writes what it looked like."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import List, Optional, Tuple

from . import InvalidValueError, Scene, TautlineError, __version__, scenes
from ._save import check


def main(arguments: Optional[List[str]] = None) -> int:
    parser = argparse.ArgumentParser("python -m tautline", description="Run a scene and write a picture of it.")
    names = ", ".join(str(scene["name"]) for scene in scenes())
    parser.add_argument("scene", nargs="?", default="hammock", help=f"a scene file, or one of {names}")
    parser.add_argument("--set", action="append", default=[], metavar="NAME=VALUE", help="a parameter of the scene")
    parser.add_argument("--seconds", type=float, help="how long to run; what the scene says if absent")
    parser.add_argument("--out", type=Path, help="the file to write; SCENE.png if absent")
    parser.add_argument("--version", action="version", version=f"tautline {__version__}")
    options = parser.parse_args(arguments)
    try:
        scene = _find(options.scene, options.set)
        out: Path = options.out or Path(f"{scene.name}.png")
        check(out)
        recording = scene.run(options.seconds, progress=_percent if sys.stderr.isatty() else None)
        out.parent.mkdir(parents=True, exist_ok=True)
        recording.save(out)
    except (TautlineError, ImportError, OSError) as error:
        print(error, file=sys.stderr)
        return 1
    milliseconds = 1000 * recording.engine_seconds / recording.steps
    print(f"{scene.name}: {recording.steps} steps of {milliseconds:.2f} ms, state {recording.state_hash}")
    print(f"  wrote {out}")
    return 0


def _find(scene: str, assignments: List[str]) -> Scene:
    if Path(scene).suffix in (".json", ".json5", ".toml"):
        if assignments:
            raise InvalidValueError("--set: parameters are those of named scenes, and a file has none", "set")
        return Scene.load(scene)
    return Scene.named(scene, **dict(_parameter(assignment) for assignment in assignments))


def _parameter(assignment: str) -> Tuple[str, float]:
    name, _, value = assignment.partition("=")
    try:
        return name, float(value)
    except ValueError:
        raise InvalidValueError(f"--set {assignment}: expected NAME=NUMBER", "set") from None


def _percent(done: int, total: int) -> None:
    print(f"\r{100 * done // total} %", end="\n" if done >= total else "", file=sys.stderr, flush=True)


if __name__ == "__main__":
    sys.exit(main())
