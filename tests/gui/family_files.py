"""Files of families that tests have in use, which all windows of the process share."""

from __future__ import annotations

from app.families import FAMILIES
from app.families.family_file import forget_file
from app.features.own_families.files import family_files


def forget_family_files() -> None:
    """Have none in use, and nothing said of any: every later window would say so, too."""
    family_files().forget_all()
    for path in tuple(FAMILIES.files):
        forget_file(FAMILIES, path)
