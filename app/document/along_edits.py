"""Texts of a document that lie along its curves."""

from __future__ import annotations

from msgspec.structs import replace

from .along_path import Along, course_shifted
from .content import Lettering
from .model import Curve, Document, Vector


def along_of(curve: Curve) -> Along | None:
    """Return the course that a curve, which is the frame of a text, lies along; None of any other."""
    return curve.form.along if isinstance(curve.form, Lettering) else None


def path_of(curve: Curve) -> str:
    """Return the identity of the curve that a text lies along; empty for none."""
    along = along_of(curve)
    return along.of if along is not None else ""


def with_along(curve: Curve, along: Along | None) -> Curve:
    """Return a text along another course; its frame is as it was."""
    assert isinstance(curve.form, Lettering)
    return replace(curve, form=replace(curve.form, along=along))


def put_on(curve: Curve, identity: str) -> Curve:
    """Return a text whose course is taken from a curve of another identity, or is its own."""
    along = along_of(curve)
    return curve if along is None else with_along(curve, replace(along, of=identity))


def with_course_shifted(curve: Curve, by: Vector) -> Curve:
    """Return a text in a plane that was shifted with all that is in it; any other curve as it is."""
    along = along_of(curve)
    return curve if along is None else with_along(curve, course_shifted(along, by))


def place_of(document: Document, identity: str) -> int:
    """Return the place of the first curve of an identity; −1 for none."""
    return next((at for at, each in enumerate(document.curves) if identity and each.identity == identity), -1)
