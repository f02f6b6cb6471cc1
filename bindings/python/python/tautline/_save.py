"""Recordings to files."""

from __future__ import annotations

import os
import shutil
from pathlib import Path
from typing import TYPE_CHECKING, Optional, Tuple, Union

if TYPE_CHECKING:
    from ._engine import Recording

_USD = (".usd", ".usda", ".usdc")


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
    if path.suffix.lower() in _USD:
        from ._usd import write_usd

        write_usd(recording, path)
        return
    ffmpeg = _ffmpeg() if path.suffix.lower() == ".mp4" else None
    recording._write(path, size=size, frame=frame, frame_rate=frame_rate, ffmpeg=ffmpeg)


def _ffmpeg() -> str:
    """The program for films: the system's, or the one that the package ``imageio-ffmpeg`` brings."""
    found = shutil.which("ffmpeg")
    if found is None:
        try:
            import imageio_ffmpeg
        except ImportError as missing:
            message = 'films are written by ffmpeg: install it, or pip install "tautline[film]"'
            raise ImportError(message) from missing
        found = str(imageio_ffmpeg.get_ffmpeg_exe())
    return found
