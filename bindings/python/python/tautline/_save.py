"""Recordings to files."""

from __future__ import annotations

import os
import shutil
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Optional, Tuple, Union

from ._errors import InvalidValueError, missing

if TYPE_CHECKING:
    from ._engine import Recording

_USD = (".usd", ".usda", ".usdc")
FORMATS = (".gif", ".glb", ".html", ".mp4", ".npz", ".obj", ".pc2", ".ply", ".png", *_USD)


def save(
    recording: "Recording",
    path: Union[str, "os.PathLike[str]"],
    *,
    size: Optional[Tuple[int, int]] = None,
    frame: Optional[int] = None,
    frame_rate: float = 30.0,
) -> None:
    """Writes a recording in the format that the extension of ``path`` names.

    Args:
        recording: What to write.
        path: ``.gif``, ``.mp4``, ``.png``: pictures; ``.glb``, ``.usd``, ``.usda``, ``.usdc``: scenes with motion;
            ``.html``: a page that plays it, in itself;
            ``.pc2``: a point cache, with its mesh as ``.obj`` beside it; ``.obj``, ``.ply``: a mesh for each frame;
            ``.npz``: arrays.
        size: Width and height of pictures, in pixels; (640, 480) if absent.
        frame: Of a ``.png``; the last if absent.
        frame_rate: The most pictures a second in a ``.gif``, 1 to 50.
    """
    path = Path(path)
    check(path)
    if path.suffix.lower() in _USD:
        from ._usd import write_usd

        write_usd(recording, path)
        return
    ffmpeg = _ffmpeg() if path.suffix.lower() == ".mp4" else None
    recording._write(path, size=size, frame=frame, frame_rate=frame_rate, ffmpeg=ffmpeg)


def check(path: Path) -> None:
    """That there is a format of this extension, and what writes it: before hours of work that could not be saved."""
    extension = path.suffix.lower()
    if extension not in FORMATS:
        problem = f"no known format; the extension must be one of {', '.join(FORMATS)}"
        raise InvalidValueError(f"{path}: {problem}", "path")
    if extension in _USD and find_spec("pxr") is None:
        raise missing('USD is written by the package "usd-core", which is not installed', "usd")
    if extension == ".mp4":
        _ffmpeg()


def _ffmpeg() -> str:
    """The program for films: the system's, or the one that the package ``imageio-ffmpeg`` brings."""
    found = shutil.which("ffmpeg")
    if found is None:
        try:
            import imageio_ffmpeg
        except ImportError as absent:
            raise missing("films are written by ffmpeg, which is not installed", "film") from absent
        found = str(imageio_ffmpeg.get_ffmpeg_exe())
    return found
