"""What texts know the curves by along which they lie."""

from __future__ import annotations

from typing import Annotated

from .fields import printed

_LONGEST_IDENTITY = 64

Identity = Annotated[
    str, printed(_LONGEST_IDENTITY, f"be a text of at most {_LONGEST_IDENTITY} characters on one line")
]
"""What others know a curve by, whatever it is called."""
