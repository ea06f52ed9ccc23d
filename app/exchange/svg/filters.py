"""Filters of a file, as far as they are one Gaussian blur."""

from __future__ import annotations

import math
import re
import xml.etree.ElementTree as ET
from collections.abc import Mapping

from curvecore.arrays import FloatArray

from ...document.model import MAX_MAGNITUDE
from .elements import Elements
from .flaw import Flaw
from .matrices import is_uneven, mean_scale
from .xml_tree import tag_of

_CHANGED = Flaw("a filter changes it", "it comes in without")
_UNEVEN = Flaw("its transform makes the blur uneven", "it is as blurred all around")
_TOGETHER = Flaw("it is blurred as a whole", "each of its shapes is")
_IN_LIGHT = Flaw("its blur mixes colours as light", "it mixes them as they are written")

_NUMBERS = re.compile(r"[\s,]+")


def without_noise(deviation: float) -> float:
    """Return a product without the noise of its last digits."""
    return float(f"{deviation:.12g}")


class Filters:
    """The filters of one file."""

    def __init__(self, elements: Elements) -> None:
        self._elements = elements

    def blur(self, declared: Mapping[str, str]) -> float | None:
        """Return the deviation of the blur that a `filter` is, 0 of none; None of any other filter."""
        value = declared.get("filter", "none")
        if value == "none":
            return 0.0
        primitive = self._primitive(value)
        if primitive is None:
            return None
        try:
            numbers = [float(each) for each in _NUMBERS.split(primitive.get("stdDeviation", "0").strip())]
        except ValueError:
            return None
        is_one = len(numbers) in (1, 2) and min(numbers) == max(numbers) and 0 <= numbers[0] <= MAX_MAGNITUDE
        return numbers[0] if is_one else None

    def blurred(self, around: float, declared: Mapping[str, str], matrix: FloatArray) -> float:
        """Return the deviation in the plane, to which a matrix leads, of what is in two blurs or fewer."""
        return math.hypot(around, (self.blur(declared) or 0.0) * mean_scale(matrix))

    def flaws(self, declared: Mapping[str, str], matrix: FloatArray, *, is_many: bool) -> list[Flaw]:
        """Return what of a `filter` does not come in; of an element that holds many shapes, or only one."""
        blur = self.blur(declared)
        if blur is None:
            return [_CHANGED]
        if not blur:
            return []
        found = [_UNEVEN] if is_uneven(matrix) else []
        found += [_IN_LIGHT] if self._mixes_light(declared) else []
        return [*found, _TOGETHER] if is_many else found

    def _mixes_light(self, declared: Mapping[str, str]) -> bool:
        """Whether a blur mixes colours in linear light, as SVG has it where nobody says otherwise."""
        primitive = self._primitive(declared.get("filter", "none"))
        if primitive is None:
            return False
        around = self._elements.declared(self._elements.referred(declared["filter"]) or primitive)
        name = "color-interpolation-filters"
        return {**around, **self._elements.declared(primitive)}.get(name, "linearRGB") != "sRGB"

    def _primitive(self, value: str) -> ET.Element | None:
        """Return the one primitive of a filter that is a blur; None of any other."""
        element = self._elements.referred(value)
        if element is None or element.get("primitiveUnits", "userSpaceOnUse") != "userSpaceOnUse":
            return None
        parts = [each for each in element if tag_of(each).startswith("fe")]
        if len(parts) != 1 or tag_of(parts[0]) != "feGaussianBlur":
            return None
        primitive = parts[0]
        return primitive if primitive.get("in", "SourceGraphic") == "SourceGraphic" else None
