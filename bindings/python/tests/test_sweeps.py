"""Sweeps: the same results wherever they run, also where workers die."""

import json
import os
import signal
import threading
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any, Dict, List

import numpy as np
import pytest

import runs
import tautline as tl

GRID = {"height": [0.1 + 0.05 * i for i in range(16)], "columns": [4, 5, 6, 7]}
METRICS = {"state_hash": "state_hash", "lowest": runs.lowest}
SECONDS = 0.2


def rows(table: Any) -> List[Dict[str, Any]]:
    """Of a table, whatever it is."""
    return list(table.to_dict("records")) if hasattr(table, "to_dict") else list(table)


@pytest.fixture(scope="module")
def serial() -> List[Dict[str, Any]]:
    """What all 64 runs come to, one after another."""
    return rows(tl.sweep(runs.drape, GRID, SECONDS, METRICS, executor="serial"))


def test_a_grid_in_order(serial: List[Dict[str, Any]]) -> None:
    assert [(row["height"], row["columns"]) for row in serial] == [(h, c) for h in GRID["height"] for c in GRID["columns"]]
    assert all(row["error"] == "" for row in serial)
    assert len({row["state_hash"] for row in serial}) == 64


def test_named_scenes_documents_and_seeds() -> None:
    told: List[Any] = []
    named = rows(tl.sweep("icosahedra", {"n": [5]}, 0.1, executor="serial", repeats=3, progress=lambda *at: told.append(at)))
    assert [row["seed"] for row in named] == [1, 2, 3] and len({row["state_hash"] for row in named}) == 3
    assert told == [(0, 3), (1, 3), (2, 3), (3, 3)]
    scene = tl.Scene.named("tower", n=2)
    changed = rows(tl.sweep(scene, {"settings.substeps": np.array([4, 8])}, 0.1, executor="serial"))
    assert changed[1]["state_hash"] == scene.run(0.1, record=False).state_hash != changed[0]["state_hash"]
    wrong = rows(tl.sweep(scene, {"bodies[99].rigid.mass": [1]}, 0.1, executor="serial"))
    assert "there is no such field" in wrong[0]["error"]
    for field, options in {
        "metrics": {"metrics": ["charm"]},
        "executor": {"executor": "threads"},
        "save": {"save": ".obj", "folder": "."},
        "folder": {"save": ".npz"},
        "params.n": {"params": {"n": 3}},
    }.items():
        with pytest.raises(tl.InvalidValueError) as refusal:
            tl.sweep("tower", **{"params": {"n": [3]}, **options})
        assert refusal.value.path == field


def test_processes_of_this_machine(serial: List[Dict[str, Any]], tmp_path: Path) -> None:
    table = tl.sweep(runs.drape, GRID, SECONDS, METRICS, folder=tmp_path, save=".npz")
    assert rows(table) == serial
    assert len(list(tmp_path.glob("*.json"))) == len(list(tmp_path.glob("*.npz"))) == 64
    assert not list(tmp_path.glob(".*"))
    told = json.loads(next(iter(tmp_path.glob("*.json"))).read_text())
    assert told["figures"] in [{key: row[key] for key in (*METRICS, "error")} for row in serial]


def test_a_killed_process_takes_no_run_with_it(serial: List[Dict[str, Any]], tmp_path: Path) -> None:
    made = runs.Logged(tmp_path, GRID["height"][5])
    assert rows(tl.sweep(made, GRID, SECONDS, METRICS)) == serial
    assert (tmp_path / "dead").exists()


def test_a_run_that_always_kills_is_reported_and_no_other(serial: List[Dict[str, Any]], tmp_path: Path) -> None:
    made = runs.Logged(tmp_path, GRID["height"][2], always=True)
    heights = GRID["height"][:12]
    table = rows(tl.sweep(made, {"height": heights, "columns": [4]}, SECONDS, METRICS))
    wrong = [row for row in table if row["error"]]
    assert [row["height"] for row in wrong] == [heights[2]] and "lost 4 times" in wrong[0]["error"]
    assert [row for row in serial if row["columns"] == 4 and row["height"] in heights and row["height"] != heights[2]] == [
        {name: row[name] for name in serial[0]} for row in table if not row["error"]
    ]


def test_whoever_interrupts_does_not_wait_for_the_rest(tmp_path: Path) -> None:
    made = runs.Logged(tmp_path)

    def interrupt(done: int, total: int) -> None:
        if done == 4:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        tl.sweep(made, GRID, SECONDS, METRICS, progress=interrupt)
    begun = len(list(tmp_path.iterdir()))
    assert 4 <= begun <= 4 + 2 * (os.cpu_count() or 1), "those that had begun are finished"


def test_what_is_done_is_not_done_again(serial: List[Dict[str, Any]], tmp_path: Path) -> None:
    made, folder = runs.Logged(tmp_path), tmp_path / "results"

    class Interrupted(Exception):
        """As a user would."""

    def interrupt(done: int, total: int) -> None:
        if done == 20:
            raise Interrupted

    with pytest.raises(Interrupted):
        tl.sweep(made, GRID, SECONDS, METRICS, executor="serial", folder=folder, progress=interrupt)
    assert len(list(folder.glob("*.json"))) == 20
    assert rows(tl.sweep(made, GRID, SECONDS, METRICS, executor="serial", folder=folder)) == serial
    counts = {made.begun(row["height"], row["columns"]) for row in serial}
    assert counts == {1}, "each run began once"
    again = rows(tl.sweep(made, GRID, SECONDS, METRICS, executor="serial", folder=folder))
    assert again == serial and {made.begun(row["height"], row["columns"]) for row in serial} == {1}


def test_a_run_that_fails_is_reported_and_tried_again(tmp_path: Path) -> None:
    for _ in range(2):
        table = rows(tl.sweep("tower", [{"n": 2}, {"n": -1}], 0.1, executor="serial", folder=tmp_path))
        assert table[0]["error"] == "" and "InvalidValueError: n:" in table[1]["error"]
        assert len(list(tmp_path.glob("*.json"))) == 1


def test_an_executor_that_breaks_is_reported(tmp_path: Path) -> None:
    made = runs.Logged(tmp_path, GRID["height"][0])
    import multiprocessing

    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
        table = rows(tl.sweep(made, GRID, SECONDS, METRICS, executor=pool, folder=tmp_path / "results"))
    assert any("broken" in row["error"] for row in table)


def test_two_dask_workers_of_which_one_is_killed(serial: List[Dict[str, Any]], tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed")
    import dask

    tests = str(Path(__file__).parent)
    options = {"distributed.nanny.pre-spawn-environ": {"PYTHONPATH": tests}}
    made, folder = runs.Logged(tmp_path), tmp_path / "results"
    with dask.config.set(options), distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, silence_logs=50
    ) as cluster, distributed.Client(cluster) as client:
        client.run(tl.set_threads, 1)
        victim = next(iter(client.run(os.getpid).values()))

        def kill(done: int, total: int) -> None:
            if done >= 32 and not killed.is_set():
                killed.set()
                os.kill(victim, signal.SIGKILL)

        killed = threading.Event()
        table = rows(tl.sweep(made, GRID, SECONDS, METRICS, executor=client.get_executor(), folder=folder, progress=kill))
    assert killed.is_set()
    assert table == serial
    assert len(list(folder.glob("*.json"))) == 64
    counts = {made.begun(row["height"], row["columns"]) for row in serial}
    assert counts <= {1, 2}, "what the killed worker had or held is done once more, the rest once"


def test_two_ray_workers_of_which_one_is_killed(serial: List[Dict[str, Any]], tmp_path: Path) -> None:
    ray = pytest.importorskip("ray")
    made = runs.Logged(tmp_path, GRID["height"][8])
    environment = {"env_vars": {"PYTHONPATH": str(Path(__file__).parent)}}
    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False, runtime_env=environment)
    try:
        # Without Ray's own retries: a lost run comes back to the sweep, which gives it out again.
        for retries in (0, 3):
            (tmp_path / "dead").unlink(missing_ok=True)
            folder = tmp_path / f"results-{retries}"
            table = rows(tl.sweep(made, GRID, SECONDS, METRICS, executor=tl.RayExecutor(retries), folder=folder))
            assert (tmp_path / "dead").exists(), "a worker was killed"
            assert table == serial
            assert len(list(folder.glob("*.json"))) == 64
        failing = [{"n": 2}, {"n": -1}]
        here, there = (rows(tl.sweep("tower", failing, 0.1, executor=at)) for at in ("serial", tl.RayExecutor()))
        assert [row["error"] for row in here] == [row["error"] for row in there], "it is said as it is here"
        pids = list(tl.RayExecutor().map(runs.process, range(20)))
        assert len(set(pids)) == 2 and os.getpid() not in pids
    finally:
        ray.shutdown()
