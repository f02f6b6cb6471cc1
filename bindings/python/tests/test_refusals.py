"""What is wrong is said, by field, with what would be right."""

import pickle
from typing import Any, Callable

import numpy as np
import pytest

import tautline as tl

SPHERE = tl.Shape.sphere(0.5)
GOOD = np.zeros((100, 3), np.float32)


@pytest.mark.parametrize(
    ("path", "call"),
    [
        ("radius", lambda: tl.Shape.sphere(-1)),
        ("settings.substeps", lambda: tl.Settings(substeps=0)),
        ("settings.gravity.y", lambda: tl.Settings(gravity=(0, float("nan"), 0))),
        ("mass", lambda: tl.World().add(tl.RigidBody(SPHERE, mass=0))),
        ("mass", lambda: tl.RigidBody(SPHERE, mass=1, density=1)),
        ("position.x", lambda: tl.World().add(tl.RigidBody(SPHERE, position=(float("inf"), 0, 0)))),
        ("motion", lambda: tl.RigidBody(SPHERE, motion="floating")),  # type: ignore[arg-type]
        ("dt", lambda: tl.World().step(0)),
        ("dt", lambda: tl.World().step(float("nan"))),
        ("dt", lambda: tl.World(dt=1e9)),
        ("seconds", lambda: tl.World().run(-1)),
        ("seconds", lambda: tl.World().run(float("nan"))),
        ("every", lambda: tl.World().run(1, every=0)),
        ("points", lambda: tl.Rope([[0, 0], [1, 0]])),
        ("points", lambda: tl.Shape.convex_hull("points")),
        ("triangles", lambda: tl.Cloth((np.eye(3), [[0, 1, 2.5]]))),
        ("triangles[0]", lambda: tl.Cloth((np.eye(3), [[0, 1, -2]]))),
        ("surface", lambda: tl.Cloth(3)),  # type: ignore[arg-type]
        ("points", lambda: tl.Shape.convex_hull([[0, 0, 0], [1, 0, 0], [0, 1, 0]])),
        ("mesh", lambda: tl.Shape.from_mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])),
        ("a[1]", lambda: tl.distance([[0, 0, 0], [float("nan"), 0, 0]], [[1, 1, 1]])),
        ("b", lambda: tl.distance([[0, 0, 0]], np.zeros((0, 3)))),
        ("snapshot", lambda: tl.World().restore(b"no snapshot")),
        ("name", lambda: tl.Scene.named("no-such-scene")),
        ("n", lambda: tl.Scene.named("tower", n=-1)),
        ("height", lambda: tl.Scene.named("tower", height=2)),
        ("count", lambda: tl.set_threads(0)),
        ("cases", lambda: tl.validate([999])),
    ],
)
def test_refused_by_field(path: str, call: Callable[[], Any]) -> None:
    with pytest.raises(tl.TautlineError) as refusal:
        call()
    assert isinstance(refusal.value, ValueError)
    assert refusal.value.path == path, str(refusal.value)


@pytest.mark.parametrize(
    ("problem", "positions"),
    [
        (r"expected shape \(100, 3\), not \[99, 3\]", np.zeros((99, 3), np.float32)),
        ("expected dtype float32, not float64", np.zeros((100, 3))),
        ("C-contiguous", np.zeros((3, 100), np.float32).T),
        ("C-contiguous", np.zeros((200, 3), np.float32)[::2]),
        (r"positions\[7\]: .* is not finite", np.where(np.arange(100)[:, None] == 7, np.nan, GOOD).astype(np.float32)),
        ("expected a numpy.ndarray", GOOD.tolist()),
        (r"expected shape", np.zeros(300, np.float32)),
    ],
)
def test_arrays_that_are_set_are_as_the_engines_own(drape: tl.World, problem: str, positions: Any) -> None:
    before = drape.state_hash
    with pytest.raises(tl.InvalidValueError, match=problem):
        drape["cloth"].set_positions(positions)
    assert drape.state_hash == before
    with pytest.raises(tl.InvalidValueError, match=problem.replace("positions", "velocities")):
        drape["cloth"].set_particle_velocities(positions)
    assert drape.state_hash == before
    drape["cloth"].set_positions(GOOD + np.float32(2))
    assert (drape["cloth"].positions == 2).all()
    drape["cloth"].set_particle_velocities(GOOD + np.float32(3))
    assert np.allclose(drape["cloth"].particle_velocities, 3)


def test_a_scene_names_all_its_problems() -> None:
    document = tl.Scene.named("cloth-on-cube").to_dict()
    document["dt"] = -1
    document["bodies"][-1]["cloth"]["mass"] = 0
    with pytest.raises(tl.SceneError) as refusal:
        tl.Scene(document)
    paths = [path for path, _ in refusal.value.problems]
    assert "dt" in paths and any(path.endswith("cloth.mass") for path in paths)
    document["bodies"][-1]["cloth"]["colour"] = "red"
    with pytest.raises(tl.SceneError, match="colour"):
        tl.Scene(document)


def test_vectors_say_what_they_are() -> None:
    with pytest.raises(TypeError, match=r"three numbers \(x, y, z\)"):
        tl.RigidBody(SPHERE, position=(1, 2))


def test_the_removed_and_the_foreign_are_refused(drape: tl.World) -> None:
    cube = drape["cube"]
    with pytest.raises(tl.InvalidValueError, match="another world"):
        tl.World().remove(cube)
    drape.remove(cube)
    assert not cube.is_there and "removed" in repr(cube)
    for use in (lambda: cube.position, lambda: cube.mass, lambda: cube.positions, lambda: drape.remove(cube)):
        with pytest.raises(tl.StaleHandleError):
            use()
    with pytest.raises(KeyError):
        drape["cube"]


def test_files_that_are_not_there() -> None:
    with pytest.raises(FileNotFoundError):
        tl.Scene.load("no-such-file.json")


def test_exceptions_go_between_processes() -> None:
    error = tl.SceneError("dt: wrong", "dt", [("dt", "wrong")])
    again = pickle.loads(pickle.dumps(error))
    assert (str(again), again.path, again.problems) == ("dt: wrong", "dt", [("dt", "wrong")])
