"""Processes of this machine as an executor."""

from __future__ import annotations

import multiprocessing
from concurrent.futures import BrokenExecutor, Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from queue import SimpleQueue
from typing import Any, Callable, Dict, Tuple

from ._engine import set_threads


class LocalProcesses(Executor):
    """So many processes, each a pool of its own: one that dies takes the call with it that it was at, and no other. Of a
    ``ProcessPoolExecutor`` all calls are lost together, and nobody knows which one is to blame.
    """

    def __init__(self, count: int) -> None:
        self._idle: "SimpleQueue[ProcessPoolExecutor]" = SimpleQueue()
        for _ in range(count):
            self._idle.put(_process())
        # Each waits for a process.
        self._threads = ThreadPoolExecutor(count)

    def submit(self, function: Callable[..., Any], /, *args: Any, **keywords: Any) -> "Future[Any]":
        return self._threads.submit(self._call, function, args, keywords)

    def _call(self, function: Callable[..., Any], args: Tuple[Any, ...], keywords: Dict[str, Any]) -> Any:
        process = self._idle.get()
        try:
            return process.submit(function, *args, **keywords).result()
        except BrokenExecutor:
            process = _process()
            raise
        finally:
            self._idle.put(process)

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        self._threads.shutdown(wait, cancel_futures=cancel_futures)
        while not self._idle.empty():
            self._idle.get().shutdown(wait)


def _process() -> ProcessPoolExecutor:
    """It starts when it is first needed."""
    # Not forked: a child would have none of the threads of this process. One thread each: there are many of them.
    context = multiprocessing.get_context("spawn")
    return ProcessPoolExecutor(1, context, initializer=set_threads, initargs=(1,))
