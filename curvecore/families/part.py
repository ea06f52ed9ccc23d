"""Groups of methods that `ParametricCurve` is put together from."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

if TYPE_CHECKING:
    from curvecore.families.curve import ParametricCurve


class CurvePart:
    """Base of the parts of `ParametricCurve` that call its other methods."""

    __slots__ = ()

    @property
    def _this(self) -> ParametricCurve:
        return cast("ParametricCurve", self)
