"""The curve families of the program, which menus, tables, exports and the command line read here. No Qt.

- ``family``: `Family`, the record of a curve class with its words; `FamilySettings`, the settings of a
  family; `FamilySettingValues`, those that are not at their defaults.
- ``registry``: `FAMILIES`: the families of the core, then those of installed packages and of files.
- ``family_file``: families from a file of Python, checked before they are used, the calls of its
  functions, and their limit of time.

To add a family to the program, add a file to ``curvecore.families``; its docstring says how. An installed
package names its curve class as an entry point of the group ``curvebench.families``, a person names a file
with ``--families`` or Use Family File (``family_file`` says what it holds). The program lists families
nowhere else; the README does, the map of `curvecore.families` and, for imports, ``curvecore/__init__.pyi``.
"""

from curvecore import FamilySetting
from curvecore.families.setting import SettingValue

from .family import NO_SETTINGS, Family, FamilySettingValues, may_be_name
from .registry import (
    FAMILIES,
    HERMITE,
    LAGRANGE,
    QUINTIC_HERMITE,
    Families,
    titles,
    titles_with_derivatives,
)

__all__ = [
    "FAMILIES",
    "HERMITE",
    "LAGRANGE",
    "NO_SETTINGS",
    "QUINTIC_HERMITE",
    "Families",
    "Family",
    "FamilySetting",
    "FamilySettingValues",
    "SettingValue",
    "may_be_name",
    "titles",
    "titles_with_derivatives",
]
