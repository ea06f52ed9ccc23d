"""Curve families in files that the command line names."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from ..families import FAMILIES, family_file
from .output import RefusalError


@contextmanager
def families_of_files(paths: Sequence[str]) -> Iterator[None]:
    """Add the families of files while a command runs; refuse the command where one is wrong."""
    try:
        with family_file.families_of_files(FAMILIES, paths):
            yield
    except family_file.FamilyFileError as problem:
        raise RefusalError(str(problem)) from None
