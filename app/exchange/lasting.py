"""What of a document a drawing for other programs does not keep: it would come back from there without."""

from __future__ import annotations

from pathlib import Path

from ..document.forms import Star
from ..document.model import Curve, Document
from ..document.words import count_of, enumerated
from ..storage.reasons import shown
from ..view_model.shapes.formed import formed
from .cubics_in import FAMILY
from .formats import FORMATS, format_of
from .svg.form_elements import element_of


def words_about_loss(document: Document, path: Path) -> str:
    """Return, as a sentence, what a file of another format would not keep; empty where that is nothing."""
    name = shown(path.name)
    if format_of(path, FORMATS.written).rewrite is None:
        return f"{name} would be written anew, with its curves alone."
    lost = [*_other_curves(document), *(["the picture to trace"] if document.image is not None else [])]
    return f"{name} cannot keep {enumerated(lost)}." if lost else ""


def words_about_plain(document: Document, path: Path) -> str:
    """Return, as a sentence, what is no more than paths in a file of another format; empty of nothing."""
    curves, is_svg = document.curves, format_of(path, FORMATS.written).rewrite is not None
    kinds = {
        "clones": not is_svg and any(curve.clone is not None for curve in curves),
        "texts": not is_svg and any(curve.text is not None for curve in curves),
        "skewed stars" if is_svg else "stars": any(_is_plain_star(curve, is_svg=is_svg) for curve in curves),
    }
    found = [kind for kind, is_there in kinds.items() if is_there]
    if not found:
        return ""
    name = shown(path.name)
    return f"In {name} {enumerated(found)} are plain paths; a Curvebench document keeps what they are."


def _is_plain_star(curve: Curve, *, is_svg: bool) -> bool:
    """Whether a curve is a star here, and none in a file."""
    now = formed(curve)
    return now is not None and isinstance(now.form, Star) and not (is_svg and element_of(now))


def _other_curves(document: Document) -> list[str]:
    """Return what curves come back as others of the same shape."""
    others = [curve for curve in document.curves if curve.points and curve.family != FAMILY]
    if not others:
        return []
    what = f"“{others[0].seen_name}”" if len(others) == 1 else count_of(len(others), "curve")
    kinds = {curve.family.title for curve in others}
    return [f"{what} as {kinds.pop()}" if len(kinds) == 1 else f"the families of {what}"]
