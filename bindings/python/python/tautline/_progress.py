"""How far something is."""

from __future__ import annotations

from typing import Callable, Optional, Union

from ._errors import missing

Reporter = Callable[[int, int], object]
Progress = Union[bool, Reporter, None]


def _silent(done: int, total: int) -> None:
    """Tells nobody."""


class _Bar:
    """A bar of tqdm, made when the first part is done."""

    def __init__(self) -> None:
        self._bar: Optional[object] = None
        self._done = 0

    def __call__(self, done: int, total: int) -> None:
        try:
            from tqdm.auto import tqdm
        except ImportError as absent:
            raise missing("bars are drawn by tqdm", "progress") from absent
        if self._bar is None:
            self._bar = tqdm(total=total)
        bar: tqdm = self._bar
        bar.update(done - self._done)
        self._done = done
        if done >= total:
            bar.close()


def reporter(progress: Progress) -> Reporter:
    """From what a caller gave: True is a bar of tqdm, a callable is told (done, total)."""
    if progress is True:
        return _Bar()
    return progress if callable(progress) else _silent
