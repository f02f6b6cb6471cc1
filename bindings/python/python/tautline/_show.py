"""What a notebook shows of a world or a recording."""

from __future__ import annotations

import base64
import html as _html
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ._engine import Recording

_SIZE = (480, 360)
_FRAME_RATE = 20.0


def html(recording: "Recording") -> str:
    """An animation, or a picture where there is one frame: in the page itself, so that it needs no file and no network."""
    extension = "gif" if recording.frame_count > 1 else "png"
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"picture.{extension}"
        recording._write(path, size=_SIZE, frame_rate=_FRAME_RATE)
        data = base64.b64encode(path.read_bytes()).decode("ascii")
    width, height = _SIZE
    name = _html.escape(recording.name, quote=True)
    return f'<img alt="{name}" width="{width}" height="{height}" src="data:image/{extension};base64,{data}">'
