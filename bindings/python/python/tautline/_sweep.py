"""Many runs of one scene: a grid of parameters, on processes of this machine or on a cluster."""

from __future__ import annotations

import hashlib
import itertools
import json
import math
import os
import re
import tempfile
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Callable, Dict, Iterable, List, Mapping, Optional, Sequence, Tuple, Union

from ._documents import dumps
from ._engine import Recording, Scene, World, __version__
from ._errors import InvalidValueError
from ._local import LocalProcesses
from ._progress import Progress, reporter
from ._save import FORMATS

Metric = Callable[[World, Recording], object]
Make = Callable[..., Union[Scene, World]]
Row = Dict[str, Any]

_METRICS: Dict[str, Metric] = {
    "state_hash": lambda world, recording: world.state_hash,
    "kinetic_energy": lambda world, recording: world.kinetic_energy,
    "potential_energy": lambda world, recording: world.potential_energy,
    "max_strain": lambda world, recording: world.strain[0],
    "max_penetration": lambda world, recording: world.penetration[0],
    "engine_seconds": lambda world, recording: recording.engine_seconds,
}
_DEFAULT = ("state_hash", "kinetic_energy", "max_strain", "max_penetration")
_RETRIES = 3
# Formats of one file each.
_SAVED = tuple(extension for extension in FORMATS if extension not in (".obj", ".pc2", ".ply"))


@dataclass(frozen=True)
class _Job:
    """A run, as it is sent to a worker."""

    scene: Union[str, Make]
    parameters: Row
    seconds: Optional[float]
    metrics: Mapping[str, Union[str, Metric]]
    save: Optional[str]

    def key(self) -> str:
        """The same for the same run, in any process: what its file is called. Functions are told apart by their names, and
        another version of the engine may give other bits."""
        scene = self.scene if isinstance(self.scene, str) else _name(self.scene)
        metrics = {name: metric if isinstance(metric, str) else _name(metric) for name, metric in self.metrics.items()}
        told = [__version__, scene, self.parameters, self.seconds, metrics, self.save]
        return hashlib.sha256(json.dumps(told, sort_keys=True).encode()).hexdigest()[:16]


def _name(function: Callable[..., Any]) -> str:
    named = function if hasattr(function, "__qualname__") else type(function)
    return f"{named.__module__}.{named.__qualname__}"


def _run(job: _Job) -> Tuple[Row, Optional[bytes]]:
    """In a worker: the figures of a run, and its recording as the bytes of a file."""
    made = _make(job)
    world = made if isinstance(made, World) else made.build()
    recording = world.run(job.seconds, record=job.save is not None)
    figures: Row = {}
    for name, metric in job.metrics.items():
        measure = _METRICS[metric] if isinstance(metric, str) else metric
        value: Any = measure(world, recording)
        figures[name] = value.item() if hasattr(value, "item") else value
    if job.save is None:
        return figures, None
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"recording{job.save}"
        recording.save(path)
        return figures, path.read_bytes()


def _make(job: _Job) -> Union[Scene, World]:
    if not isinstance(job.scene, str):
        return job.scene(**job.parameters)
    if not job.scene.startswith("{"):
        return Scene.named(job.scene, **job.parameters)
    document = json.loads(job.scene)
    for path, value in job.parameters.items():
        _assign(document, path, value)
    return Scene(document)


def _assign(document: Any, path: str, value: object) -> None:
    """Sets a field of a document, such as ``bodies[1].rigid.mass``."""
    steps = [int(number) if number else name for name, number in re.findall(r"([^.\[\]]+)|\[(\d+)\]", path)]
    place = document
    try:
        for step in steps[:-1]:
            place = place.setdefault(step, {}) if isinstance(place, dict) else place[step]
        place[steps[-1]] = value
    except (IndexError, KeyError, TypeError) as error:
        raise InvalidValueError(f"{path}: there is no such field in the scene", path) from error


def sweep(
    scene: Union[str, Scene, Make],
    params: Union[Mapping[str, Iterable[object]], Sequence[Mapping[str, object]]],
    seconds: Optional[float] = None,
    metrics: Union[Sequence[str], Mapping[str, Union[str, Metric]], None] = None,
    *,
    executor: Union[Executor, str, None] = None,
    folder: Union[str, "os.PathLike[str]", None] = None,
    save: Optional[str] = None,
    repeats: Optional[int] = None,
    progress: Progress = None,
) -> Any:
    """Runs a scene with every combination of parameters, and returns a table of what came of it.

    Args:
        scene: The name of a named scene, whose parameters ``params`` sets; a ``Scene``, of which ``params`` sets fields by
            their paths, such as ``"bodies[1].rigid.mass"``; or a function of the parameters that returns a Scene or a World.
        params: A dict of lists: their grid; or a list of dicts: one run each.
        seconds: How long each run takes; what the scene says if absent.
        metrics: Names of ``state_hash``, ``kinetic_energy``, ``potential_energy``, ``max_strain``, ``max_penetration`` and
            ``engine_seconds``, or a dict of columns: names or functions of (world, recording).
        executor: Where runs are done: any ``concurrent.futures.Executor``, such as Dask's ``client.get_executor()`` or a
            ``RayExecutor``; ``"serial"``, in this process; absent, one process for each core, which takes functions of
            modules only.
        folder: Where each run leaves a file. Runs that have one are not run again: call again to go on.
        save: Also keep each run's recording there, in the format of this extension, such as ``".npz"``; of formats that are
            one file each.
        repeats: Run each combination so many times, with the parameter ``seed`` from 1 on.
        progress: True for a bar, or a function of (runs done, runs).

    Returns:
        A row for each run, in the order of the parameters: these, the metrics, and ``error``, which is empty where the run
        succeeded. A ``pandas.DataFrame`` if pandas is installed, else a list of dicts. A run whose worker was lost is tried
        again up to three times; one that failed is reported, leaves no file, and is tried again at the next call.
    """
    jobs = [_job(scene, row, seconds, metrics, save) for row in _rows(params, repeats)]
    if not (executor is None or executor == "serial" or isinstance(executor, Executor)):
        problem = f'expected a concurrent.futures.Executor, "serial" or None, not {executor!r}'
        raise InvalidValueError(f"executor: {problem}", "executor")
    if save is not None and save not in _SAVED:
        raise InvalidValueError(f"save: {save!r} is none of {', '.join(_SAVED)}", "save")
    if save is not None and folder is None:
        raise InvalidValueError("folder: recordings need one to be saved in", "folder")
    store = _Store(None if folder is None else Path(folder), save)
    report = reporter(progress)
    done = [store.read(job) for job in jobs]
    report(sum(row is not None for row in done), len(jobs))
    open_jobs = [(i, job) for i, job in enumerate(jobs) if done[i] is None]

    def finish(i: int, figures: Row, recording: Optional[bytes]) -> None:
        store.write(jobs[i], figures, recording)
        done[i] = figures
        report(sum(row is not None for row in done), len(jobs))

    _run_all(open_jobs, executor, finish)
    return _table([{**job.parameters, **(row or {})} for job, row in zip(jobs, done)])


def _rows(params: Any, repeats: Optional[int]) -> List[Row]:
    if isinstance(params, Mapping):
        for name, values in params.items():
            if isinstance(values, (str, bytes)) or not hasattr(values, "__iter__"):
                raise InvalidValueError(f"params: {name}: expected a list of values, not {values!r}", f"params.{name}")
        names = list(params)
        rows = [dict(zip(names, values)) for values in itertools.product(*params.values())]
    else:
        rows = [dict(row) for row in params]
    # Numbers of NumPy become Python's, so that a run is called the same whatever its numbers came from.
    rows = [{name: json.loads(dumps(value)) for name, value in row.items()} for row in rows]
    if repeats is None:
        return rows
    return [{**row, "seed": seed} for row in rows for seed in range(1, repeats + 1)]


def _job(scene: Any, parameters: Row, seconds: Optional[float], metrics: Any, save: Optional[str]) -> _Job:
    chosen = _DEFAULT if metrics is None else metrics
    columns = dict(chosen) if isinstance(chosen, Mapping) else {name: name for name in chosen}
    for name, metric in columns.items():
        if isinstance(metric, str) and metric not in _METRICS:
            raise InvalidValueError(f"metrics: there is no {metric!r}; there are: {', '.join(_METRICS)}", "metrics")
        if name in parameters:
            raise InvalidValueError(f"metrics: {name!r} is a parameter too", "metrics")
    source = scene.to_json() if isinstance(scene, Scene) else scene
    return _Job(source, parameters, seconds, columns, save)


class _Store:
    """A file for each finished run: there whole or not at all."""

    def __init__(self, folder: Optional[Path], save: Optional[str]) -> None:
        self._folder = folder
        self._save = save
        if folder is not None:
            folder.mkdir(parents=True, exist_ok=True)

    def read(self, job: _Job) -> Optional[Row]:
        if self._folder is None:
            return None
        path = self._folder / f"{job.key()}.json"
        if not path.exists():
            return None
        row: Row = json.loads(path.read_text(encoding="utf-8"))["figures"]
        return row

    def write(self, job: _Job, figures: Row, recording: Optional[bytes]) -> None:
        if self._folder is None or figures["error"]:
            return
        if recording is not None:
            self._put(f"{job.key()}{self._save}", recording)
        told = {"parameters": job.parameters, "seconds": job.seconds, "figures": figures}
        # Last: with it, the run counts as done.
        self._put(f"{job.key()}.json", json.dumps(told, indent=1).encode())

    def _put(self, name: str, content: bytes) -> None:
        assert self._folder is not None
        part = self._folder / f".{name}.part"
        part.write_bytes(content)
        os.replace(part, self._folder / name)


def _run_all(
    jobs: List[Tuple[int, _Job]],
    executor: Union[Executor, str, None],
    finish: Callable[[int, Row, Optional[bytes]], None],
) -> None:
    if isinstance(executor, str):
        for i, job in jobs:
            finish(i, *_outcome(lambda: _run(job)))
    elif executor is not None:
        _gather(jobs, executor, finish)
    elif jobs:
        with LocalProcesses(min(os.cpu_count() or 1, len(jobs))) as processes:
            _gather(jobs, processes, finish)


def _gather(
    jobs: List[Tuple[int, _Job]], executor: Executor, finish: Callable[[int, Row, Optional[bytes]], None]
) -> None:
    """Finishes jobs as they end; those of a lost worker are given to the executor again."""
    pending: Dict["Future[Tuple[Row, Optional[bytes]]]", Tuple[int, _Job]] = {}
    tries = dict.fromkeys((i for i, _ in jobs), 0)

    def submit(i: int, job: _Job) -> None:
        try:
            pending[executor.submit(_run, job)] = (i, job)
        except BrokenExecutor:
            finish(i, {"error": "the executor is broken: call again with a new one"}, None)

    for i, job in jobs:
        submit(i, job)
    try:
        while pending:
            ended, _ = wait(pending, return_when=FIRST_COMPLETED)
            for future in ended:
                i, job = pending.pop(future)
                error = future.exception()
                if error is None or not _is_lost(error):
                    finish(i, *_outcome(future.result))
                elif tries[i] >= _RETRIES:
                    finish(i, {"error": f"its worker was lost {_RETRIES + 1} times: {error}"}, None)
                else:
                    tries[i] += 1
                    submit(i, job)
    finally:
        # Whoever interrupts a sweep does not wait for the rest of it.
        for future in pending:
            future.cancel()


def _is_lost(error: BaseException) -> bool:
    """Whether the worker failed, not the run: of Dask and Ray by name, since they need not be installed."""
    names = {cls.__name__ for cls in type(error).__mro__}
    return isinstance(error, BrokenExecutor) or bool(
        names & {"KilledWorker", "WorkerCrashedError", "NodeDiedError", "ActorDiedError", "CancelledError"}
    )


def _outcome(result: Callable[[], Tuple[Row, Optional[bytes]]]) -> Tuple[Row, Optional[bytes]]:
    try:
        figures, recording = result()
    except Exception as error:
        return {"error": f"{type(error).__name__}: {error}"}, None
    for name, value in figures.items():
        if isinstance(value, float) and not math.isfinite(value):
            return {"error": f"{name}: {value} is not finite"}, None
    return {**figures, "error": ""}, recording


def _table(rows: List[Row]) -> Any:
    try:
        import pandas
    except ImportError:
        return rows
    return pandas.DataFrame(rows)
