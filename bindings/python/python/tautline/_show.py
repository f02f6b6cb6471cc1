"""What a notebook shows of a world or a recording."""

from __future__ import annotations

import base64
import html as _html
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ._engine import Recording

_WIDTH, _HEIGHT = 640, 480


def html(recording: "Recording") -> str:
    """A page that plays it, or a picture where there is one frame: in the notebook itself, so that it needs no other file
    and no network."""
    is_still = recording.frame_count <= 1
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / ("shown.png" if is_still else "shown.html")
        recording._write(path, size=(_WIDTH, _HEIGHT))
        shown = path.read_bytes()
    size = f'width="{_WIDTH}" height="{_HEIGHT}"'
    name = _html.escape(recording.name, quote=True)
    if is_still:
        return f'<img alt="{name}" {size} src="data:image/png;base64,{base64.b64encode(shown).decode("ascii")}">'
    page = _html.escape(shown.decode("utf-8"), quote=True)
    # What is in the page runs, but cannot reach the notebook around it.
    return f'<iframe title="{name}" {size} style="border: 0" sandbox="allow-scripts" srcdoc="{page}"></iframe>'
