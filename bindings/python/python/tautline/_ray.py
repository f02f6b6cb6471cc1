"""Ray as an executor."""

from __future__ import annotations

from concurrent.futures import Executor, Future
from typing import Any, Callable


class RayExecutor(Executor):
    """Ray as a ``concurrent.futures.Executor``, for ``sweep``. ``ray.init()`` decides where calls are made.

    A call whose worker is lost ends with an exception of Ray; one that raises ends with what it raised. Cancelling a future
    cancels its call if that has not begun.

    Args:
        retries: How often Ray itself makes a call again whose worker was lost.
    """

    def __init__(self, retries: int = 3) -> None:
        self._retries = retries

    def submit(self, function: Callable[..., Any], /, *args: Any, **keywords: Any) -> "Future[Any]":
        import ray

        reference = ray.remote(max_retries=self._retries)(function).remote(*args, **keywords)
        outcome: "Future[Any]" = Future()
        outcome.add_done_callback(lambda ended: ray.cancel(reference) if ended.cancelled() else None)
        reference.future().add_done_callback(lambda ended: _hand_on(ended, outcome))
        return outcome


def _hand_on(ended: "Future[Any]", outcome: "Future[Any]") -> None:
    if not outcome.set_running_or_notify_cancel():
        return
    error = ended.exception()
    if error is None:
        outcome.set_result(ended.result())
    else:
        # Ray wraps what a call raised, together with the worker's traceback.
        outcome.set_exception(getattr(error, "cause", None) or error)
