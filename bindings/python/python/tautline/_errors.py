"""What is raised. Every exception says what was wrong and what would be right, and carries the field's path."""

from __future__ import annotations

from typing import List, Optional, Sequence, Tuple


class TautlineError(Exception):
    """Something was refused; everything is as it was before the call.

    Attributes:
        path: The field in question, such as ``mass`` or ``bodies[3].cloth.mass``; None where there is none.
        problems: Of a scene document every problem, as (path, message).
    """

    path: Optional[str]
    problems: List[Tuple[str, str]]

    def __init__(
        self, message: str, path: Optional[str] = None, problems: Sequence[Tuple[str, str]] = ()
    ) -> None:
        super().__init__(message, path, list(problems))
        self.path = path
        self.problems = list(problems)

    def __str__(self) -> str:
        return str(self.args[0])


class InvalidValueError(TautlineError, ValueError):
    """A value that is out of its range, of a wrong shape or kind."""


class MeshError(TautlineError, ValueError):
    """A mesh that cannot be used, with the place of its first defect."""


class SceneError(TautlineError, ValueError):
    """A scene document that is no scene; ``problems`` has everything that is wrong."""


class SnapshotError(TautlineError, ValueError):
    """Bytes that are not a snapshot this version can read."""


class StaleHandleError(TautlineError, LookupError):
    """A body, joint, attachment or grab that has been removed."""


def missing(what: str, extra: str) -> ImportError:
    """That a package is not installed, and which extra of this one brings it."""
    return ImportError(f'{what}: pip install "tautline[{extra}]"')
