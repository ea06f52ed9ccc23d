"""The elements of one file: those that others refer to, and what each declares."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from .xml_tree import reference_of

_REFERENCE = re.compile(r"url\(\s*['\"]?#([^'\")]*)['\"]?\s*\)")


@dataclass(frozen=True)
class Elements:
    """The elements of one file.

    Attributes
    ----------
    by_id
        Those that are named.
    declared
        Returns what an element declares.
    """

    by_id: Mapping[str, ET.Element]
    declared: Callable[[ET.Element], dict[str, str]]

    @classmethod
    def within(cls, root: ET.Element, declared: Callable[[ET.Element], dict[str, str]]) -> Elements:
        """Return those of a tree."""
        return cls({name: element for element in root.iter() if (name := element.get("id"))}, declared)

    def used(self, element: ET.Element) -> ET.Element | None:
        """Return the element of the file whose place in it an element gives; None without one."""
        reference = reference_of(element)
        return self.by_id.get(reference[1:]) if reference.startswith("#") else None

    def referred(self, value: str) -> ET.Element | None:
        """Return the element that a property such as "url(#a)" refers to; None of any other."""
        found = _REFERENCE.fullmatch(value.strip())
        return self.by_id.get(found[1]) if found is not None else None
