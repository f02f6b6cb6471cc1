"""Scene documents from Python's and NumPy's values."""

from __future__ import annotations

import json
from typing import Any


def _plain(value: Any) -> Any:
    # NumPy's numbers and arrays.
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"a scene document cannot hold a {type(value).__name__}")


def dumps(document: Any) -> str:
    """The JSON of a document; arrays become lists."""
    return json.dumps(document, default=_plain)
