"""Views: no copy, read-only, and never of memory that has gone."""

import gc
import threading

import numpy as np
import pytest

import tautline as tl


def address(array: np.ndarray) -> int:
    return int(array.__array_interface__["data"][0])


def test_a_view_is_the_engines_own_memory(drape: tl.World) -> None:
    view = drape.positions
    assert view.shape == (4 + 100, 3) and view.dtype == np.float32
    assert address(view) == drape._positions_address
    before = view.copy()
    drape.step()
    assert not np.array_equal(view, before), "it shows what the step did"
    assert address(drape.positions) == address(view)
    cloth = drape["cloth"].positions
    assert address(cloth) == address(view) + 4 * 12
    assert np.shares_memory(cloth, view)


def test_stepping_every_scene_leaves_positions_where_they_are() -> None:
    for about in tl.scenes():
        world = tl.Scene.named(about["name"]).build()
        view = world.positions
        for _ in range(3):
            world.step()
        assert address(view) == world._positions_address, about["name"]


def test_views_are_read_only(drape: tl.World) -> None:
    for view in (drape.positions, drape["cloth"].positions, drape["cloth"].inverse_masses):
        with pytest.raises(ValueError, match="read-only"):
            view[0] = 0
        with pytest.raises(ValueError, match="WRITEABLE"):
            view.flags.writeable = True
        with pytest.raises(ValueError):
            view.reshape(-1).flags.writeable = True


def test_a_view_outlives_its_world() -> None:
    world = tl.World()
    rope = world.add(tl.Rope(tl.line((0, 0, 0), (1, 0, 0), 20_000)))
    view, slices = world.positions, rope.positions[5:]
    expected = view.copy()
    del world, rope
    gc.collect()
    # What is freed would be taken by others.
    others = [np.full(20_001 * 3, np.nan, np.float32) for _ in range(50)]
    assert np.array_equal(view, expected) and np.array_equal(slices, expected[5:])
    del others


def test_growth_removal_and_restoring_leave_views_as_they_were(drape: tl.World) -> None:
    ball = tl.Shape.sphere(0.1)
    snapshot = drape.snapshot()

    def grow() -> None:
        for i in range(200):
            drape.add(tl.RigidBody(ball, position=(3, i, 0)))

    for change in (grow, lambda: drape.remove(drape["cloth"]), lambda: drape.restore(snapshot)):
        view = drape.positions
        expected, place = view.copy(), address(view)
        change()
        drape.step()
        gc.collect()
        assert address(view) == place and np.array_equal(view, expected)
        assert address(drape.positions) != place, "the world has moved on"
        assert address(drape.positions) == drape._positions_address


def test_without_a_view_nothing_is_copied(drape: tl.World) -> None:
    drape.positions  # Looked at and let go.
    gc.collect()
    place = drape._positions_address
    drape.remove(drape["cloth"])
    assert drape._positions_address == place


def test_a_change_that_is_refused_leaves_views_attached(drape: tl.World) -> None:
    view = drape.positions
    with pytest.raises(tl.InvalidValueError):
        drape.add(tl.RigidBody(tl.Shape.sphere(0.1), mass=-1))
    with pytest.raises(tl.InvalidValueError, match="another body"):
        drape.add(tl.RigidBody(tl.Shape.sphere(0.1)), name="cube")
    assert address(view) == drape._positions_address
    assert len(drape) == 3


def test_a_world_that_is_looked_at_goes_on_with_the_same_bits() -> None:
    def run(look: bool) -> str:
        world = tl.Scene.named("chain").build()
        views = []
        for i in range(60):
            if look:
                views.append(world.positions)
            if i % 20 == 10:
                world.add(tl.RigidBody(tl.Shape.sphere(0.1), position=(0, 5, i)))
            world.step()
        return world.state_hash

    assert run(True) == run(False)


def test_views_hold_while_other_threads_step_and_change(drape: tl.World) -> None:
    stop = threading.Event()
    failures = []

    def look() -> None:
        while not stop.is_set():
            views = [drape.positions for _ in range(4)]
            if not all(np.isfinite(view).all() for view in views):
                failures.append("a view holds what is no number")

    thread = threading.Thread(target=look)
    thread.start()
    ball = tl.Shape.sphere(0.1)
    for i in range(40):
        body = drape.add(tl.RigidBody(ball, position=(5, 1 + i, 0)))
        drape.step()
        if i % 2:
            drape.remove(body)
    stop.set()
    thread.join()
    assert not failures


def test_an_empty_world_has_an_empty_view() -> None:
    assert tl.World().positions.shape == (0, 3)
