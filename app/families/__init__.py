"""The curve families that there are: the one place that lists them. No Qt.

Whatever offers, names, stores or draws a family reads it here: menus, toolbar, table, ghosts, exports,
command line and tests.

- ``family``: `Family`, the record, made from a curve class.  ``family_words``: what it is called.
- ``settings``: `FamilySettings`, those of a family; `ChosenSettings`, those that are not at their defaults.
- ``registry``: `FAMILIES`, those of the program and then those of installed packages and of files.
- ``family_file``: families that a person wrote in a file of Python, checked before they are used.
  ``file_calls``: calls of its functions.  ``time_limit``: an end for what runs in it.
"""

from curvecore import FamilySetting
from curvecore.families.setting import SettingValue

from .family import Family, may_be_name
from .registry import (
    FAMILIES,
    HERMITE,
    LAGRANGE,
    QUINTIC_HERMITE,
    Families,
    titles,
    titles_with_derivatives,
)
from .settings import NO_SETTINGS, ChosenSettings

__all__ = [
    "FAMILIES",
    "HERMITE",
    "LAGRANGE",
    "NO_SETTINGS",
    "QUINTIC_HERMITE",
    "ChosenSettings",
    "Families",
    "Family",
    "FamilySetting",
    "SettingValue",
    "may_be_name",
    "titles",
    "titles_with_derivatives",
]
