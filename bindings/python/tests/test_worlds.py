"""Worlds: the engine's own bits and answers, and Python that goes on meanwhile."""

import _thread
import copy
import multiprocessing
import os
import pickle
import subprocess
import threading
import time
from typing import Dict, List

import numpy as np
import pytest

import tautline as tl

G = 9.81


@pytest.mark.parametrize("name", ["icosahedra", "hammock", "ragdoll", "catenary", "tablecloth"])
def test_the_engines_own_hashes(name: str, golden: Dict[str, str]) -> None:
    world = tl.Scene.named(name).build()
    for _ in range(120):
        world.step()
    assert world.state_hash == golden[f"{name} default"]


def test_the_command_lines_hashes() -> None:
    program = os.environ.get("TAUTLINE_PROGRAM")
    if program is None:
        pytest.skip("TAUTLINE_PROGRAM names no command line to compare with")
    out = subprocess.run([program, "run", "hammock", "--seconds", "1", "--json"], capture_output=True, check=True)
    assert tl.Scene.named("hammock").run(1, record=False).state_hash in out.stdout.decode()


def test_a_batch_gives_the_same_bits_as_one_by_one() -> None:
    worlds = [tl.Scene.named("icosahedra", n=20, seed=seed).build() for seed in range(6)]
    alone = [world.copy() for world in worlds]
    batch = tl.Batch(worlds)
    batch.step(30)
    for world in alone:
        for _ in range(30):
            world.step()
    assert batch.state_hashes == [world.state_hash for world in alone]
    assert len(set(batch.state_hashes)) == 6, "another seed, another scene"
    assert np.array_equal(batch.positions, np.stack([world.positions for world in alone]))
    assert batch.centers.shape == batch.velocities.shape == (6, len(worlds[0]), 3)
    assert np.allclose(batch.energies[:, 0], [world.kinetic_energy for world in alone])
    with pytest.raises(tl.InvalidValueError, match="already"):
        tl.Batch([worlds[0], worlds[0]])
    with pytest.raises(tl.InvalidValueError, match="do not stack"):
        tl.Batch([worlds[0], tl.World()]).positions


def test_free_fall() -> None:
    world = tl.World(tl.Settings(sleep=None))
    ball = world.add(tl.RigidBody(tl.Shape.sphere(0.1), position=(0, 100, 0), velocity=(2, 0, 0)))
    world.run(2, record=False)
    assert ball.position[1] == pytest.approx(100 - G * 2, abs=1e-3)  # 100 − ½ g t²
    assert ball.position[0] == pytest.approx(4, abs=1e-4)
    assert ball.velocity[1] == pytest.approx(-2 * G, abs=0.02), "its mean over the last substep"


def test_setters_forces_and_impulses() -> None:
    world = tl.World(tl.Settings(gravity=(0, 0, 0), sleep=None))
    body = world.add(tl.RigidBody(tl.Shape.cuboid((0.5, 0.5, 0.5)), mass=3))
    body.set_pose((1, 2, 3), (0, 1, 0, 0))
    body.velocity = np.array([1.0, 0, 0])
    body.angular_velocity = (0, 2, 0)
    assert body.position == pytest.approx([1, 2, 3]) and body.rotation == pytest.approx([0, 1, 0, 0])
    assert body.velocity == pytest.approx([1, 0, 0]) and body.angular_velocity == pytest.approx([0, 2, 0], abs=1e-6)
    body.apply_impulse((3, 0, 0))
    assert body.velocity == pytest.approx([2, 0, 0], abs=1e-5)
    body.angular_velocity = (0, 0, 0)
    body.apply_force((0, 18, 0))
    world.step(0.1)
    half = 0.1 / 16  # Of a substep: a velocity is the mean over the last one.
    assert body.velocity == pytest.approx([2, 6 * (0.1 - half), 0], abs=1e-5)
    assert world.momentum == pytest.approx([6, 18 * (0.1 - half), 0], abs=1e-4)
    assert np.trace(body.inertia) == pytest.approx(3 * 3 / 6)  # m a²/6 about each axis
    body.motion = "kinematic"
    assert body.motion == "kinematic"


def test_cloth_is_pinned_and_pulled(drape: tl.World) -> None:
    cloth = drape["cloth"]
    cloth.pin(0)
    assert cloth.inverse_masses[0] == 0
    place = cloth.positions[0].copy()
    drape.run(0.5, record=False)
    assert np.array_equal(cloth.positions[0], place)
    assert cloth.positions[55, 1] < 1.2
    assert cloth.particle_velocities.shape == (100, 3)
    assert cloth.triangles.shape == (162, 3) and cloth.triangles.dtype == np.uint32


def test_ropes_soft_solids_joints_and_attachments() -> None:
    world = tl.World()
    rope = world.add(tl.Rope(tl.line((0, 3, 0), (0, 2, 0), 10), pins=[0]))
    load = world.add(tl.RigidBody(tl.Shape.cuboid((0.2, 0.2, 0.2)), mass=5, position=(0, 1.8, 0)))
    hook = world.attach(tl.Anchor.particle(rope, 10), tl.Anchor.point(load, (0, 0.2, 0)))
    rod = world.add(tl.RigidBody(tl.Shape.capsule(0.05, 0.4), position=(3, 2, 0), mass=1))
    hinge = world.add_hinge_joint(rod, axis=(0, 0, 1), anchor=(3, 2.4, 0), motor=(2.0, 100.0))
    jelly = world.add(tl.SoftSolid(tl.Lattice((0.2, 0.2, 0.2), (3, 3, 3)), position=(6, 0.4, 0)))
    world.add(tl.HalfSpace())
    world.run(1, record=False)
    assert hook.force[1] == pytest.approx(-5 * G, abs=0.5), "the load pulls the rope down"
    assert rope.rope_length == pytest.approx(1)
    assert hinge.kind == "hinge" and not hinge.is_broken
    assert rod.angular_velocity[2] == pytest.approx(2, abs=0.05), "the motor turns it"
    assert jelly.kind == "soft_solid" and 0.1 < jelly.center_of_mass[1] < 0.3
    hinge.remove()
    assert not world.joints
    with pytest.raises(tl.StaleHandleError):
        hinge.angle
    with pytest.raises(tl.InvalidValueError, match="another world"):
        tl.World().add_fixed_joint(rod)
    grab = world.grab(load, load.position)
    grab.move_to((0.5, 1.8, 0))
    world.run(1, record=False)
    assert load.position[0] > 0.3
    grab.release()


def test_joints_break_and_say_so() -> None:
    world = tl.World()
    body = world.add(tl.RigidBody(tl.Shape.sphere(0.2), mass=10, position=(0, 5, 0)))
    world.add_ball_joint(body, break_force=50)
    broken = []
    for _ in range(10):
        world.step()
        broken += world.broken_joints
    assert len(broken) == 1 and broken[0].is_broken


def test_contact_events() -> None:
    world = tl.World()
    floor = world.add(tl.HalfSpace())
    ball = world.add(tl.RigidBody(tl.Shape.sphere(0.1), position=(0, 1, 0), report_contacts=True))
    began = []
    for _ in range(60):
        world.step()
        began += [event for event in world.contact_events if event.kind == "began"]
    assert len(began) == 1
    assert began[0].bodies == (floor, ball)
    assert began[0].approach_speed == pytest.approx((2 * G * 0.9) ** 0.5, abs=0.05)
    assert began[0].normal == pytest.approx([0, 1, 0])


def test_queries() -> None:
    world = tl.World()
    floor = world.add(tl.HalfSpace())
    ball = world.add(tl.RigidBody(tl.Shape.sphere(0.5), position=(0, 2, 0), motion="fixed"))
    hit = world.ray_cast((0, 5, 0), (0, -1, 0))
    assert hit is not None and hit.body == ball and hit.distance == pytest.approx(2.5)
    assert [hit.body for hit in world.ray_cast_all((0, 5, 0), (0, -1, 0))] == [ball, floor]
    below = world.ray_cast((0, 5, 0), (0, -1, 0), exclude=ball)
    assert below is not None and below.body == floor
    assert world.ray_cast((0, 5, 0), (0, 1, 0)) is None
    swept = world.shape_cast(tl.Shape.sphere(0.5), (0, 5, 0), (0, -4, 0))
    assert swept is not None and swept.distance == pytest.approx(0.5, abs=1e-4)
    assert world.overlap(tl.Shape.cuboid((1, 1, 1)), (0, 2, 0)) == [ball]
    near = world.closest_point((0, 3, 0))
    assert near is not None and near.body == ball and near.distance == pytest.approx(0.5)


def test_the_distance_of_two_cubes() -> None:
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
    for gap in (0.5, 1e-3, -0.25):
        found = tl.distance(corners, corners + [2 + gap, 0.3, 0.2])
        assert found.distance == pytest.approx(gap, abs=1e-6) and found.normal == pytest.approx([1, 0, 0], abs=1e-5)
        between = np.subtract(found.point_b, found.point_a)
        assert between == pytest.approx(np.multiply(found.distance, found.normal), abs=1e-5)


def test_snapshots_copies_and_pickles_go_on_with_the_same_bits(drape: tl.World) -> None:
    drape.run(0.3, record=False)
    others = [drape.copy(), copy.deepcopy(drape), pickle.loads(pickle.dumps(drape))]
    others.append(tl.World.from_snapshot(drape.snapshot()))
    snapshot = drape.snapshot()
    drape.run(0.2, record=False)
    for other in others:
        other.run(0.2, record=False)
        assert other.state_hash == drape.state_hash
    drape.run(0.2, record=False)
    cloth = drape["cloth"]
    drape.restore(snapshot)
    assert cloth.is_there and cloth.name == "cloth"
    drape.run(0.2, record=False)
    assert drape.state_hash == others[0].state_hash


def test_scenes_are_edited_as_dicts_and_pickled(golden: Dict[str, str]) -> None:
    scene = tl.Scene.named("tower", n=3)
    document = scene.to_dict()
    assert tl.Scene(document) == scene == pickle.loads(pickle.dumps(scene))
    document["settings"]["substeps"] = np.int64(4)
    document["bodies"] = document["bodies"][:2]
    changed = tl.Scene(document)
    assert changed != scene and changed.build().settings.substeps == 4 and len(changed.build()) == 2


def test_cues_are_followed() -> None:
    bar = {"name": "bar", "motion": "kinematic", "shape": {"box": {"size": [1, 1, 1]}}}
    cues = [{"at": 0.5, "body": "bar", "velocity": [2, 0, 0]}]
    world = tl.Scene({"tautline": 1, "bodies": [{"rigid": bar}], "cues": cues}).build()
    world.run(1)
    assert world["bar"].position[0] == pytest.approx(1, abs=1e-4)


def test_cases_with_a_known_answer() -> None:
    outcomes = tl.validate([1, 2])
    assert [outcome["id"] for outcome in outcomes] == [1, 2]
    assert all(outcome["pass"] for outcome in outcomes)


def test_ctrl_c_ends_a_run_where_it_is() -> None:
    world = tl.Scene.named("icosahedra", n=300).build()
    timer = threading.Timer(0.5, _thread.interrupt_main)
    start = time.perf_counter()
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        world.run(600, record=False)
    timer.join()
    assert time.perf_counter() - start < 30
    assert 0 < world.time < 600
    world.step()


def test_progress_is_told_and_what_it_raises_ends_the_run() -> None:
    told = []
    world = tl.Scene.named("tower", n=3).build()
    world.run(1, progress=lambda done, total: told.append((done, total)))
    assert told[-1] == (60, 60) and told == sorted(told)
    with pytest.raises(ZeroDivisionError):
        world.run(1, progress=lambda done, total: 1 / 0)


def test_python_goes_on_while_a_world_takes_one_step() -> None:
    document = tl.Scene.named("icosahedra", n=2000).to_dict()
    document["settings"]["substeps"] = 1000
    world = tl.Scene(document).build()
    reports: List[tl.StepReport] = []
    thread = threading.Thread(target=lambda: reports.append(world.step()))
    thread.start()
    counted = 0
    while thread.is_alive():
        counted += 1
        time.sleep(0.0005)
    print(f"counted to {counted} during a step of {1000 * reports[0].seconds:.0f} ms")
    # Were Python held up by the step, this thread would come to its turn before and after it only.
    assert counted > 50


def test_stepping_from_python_costs_nothing_to_speak_of() -> None:
    world = tl.Scene.named("icosahedra", n=1000).build()
    world.run(0.5, record=False)
    shares = []
    for _ in range(5):
        start = time.perf_counter()
        inside = sum(world.step().seconds for _ in range(40))
        shares.append((time.perf_counter() - start) / inside - 1)
    print(f"calls from Python add {100 * min(shares):.2f} %, at most {100 * max(shares):.2f} %")
    # The least of several: what else the machine does is not the call's.
    assert min(shares) < 0.02


def _hash_of_a_run(seconds: float) -> str:
    return tl.Scene.named("icosahedra", n=50).run(seconds, record=False).state_hash


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system does not fork")
@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_a_forked_process_steps_too() -> None:
    here = _hash_of_a_run(0.2)
    with multiprocessing.get_context("fork").Pool(2) as pool:
        assert pool.map_async(_hash_of_a_run, [0.2, 0.2]).get(timeout=60) == [here, here]


def test_threads_change_nothing() -> None:
    here = _hash_of_a_run(0.3)
    tl.set_threads(2)
    assert _hash_of_a_run(0.3) == here
