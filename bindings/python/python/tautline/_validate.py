"""Cases with a known answer."""

from __future__ import annotations

import json
from typing import Any, Dict, List, Optional, Sequence

from ._engine import validate_json


def validate(cases: Optional[Sequence[int]] = None) -> List[Dict[str, Any]]:
    """Compares the solver with closed forms, as ``tautline validate`` does.

    Args:
        cases: Their numbers; all of them if absent, which takes minutes.

    Returns:
        For each case a dict with ``id``, ``name``, ``formula``, ``pass``, and ``parts``: what was measured and demanded.
    """
    outcomes: List[Dict[str, Any]] = json.loads(validate_json(None if cases is None else list(cases)))
    return outcomes
