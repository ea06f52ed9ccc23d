"""Clones follow their originals: pure functions at the door that every change passes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Mapping, Sequence
from operator import attrgetter

from msgspec.structs import replace

from .clone import Clone
from .clone_maps import RULES, clone_by, is_image, map_between, map_of, mapped_points, rules_of, runs_as
from .clone_styles import style_followed
from .edits import EditError
from .model import Curve, Document
from .several_curves import Added, add_copies, named
from .shapes import with_values
from .steps import reshaped
from .transforms import Affine
from .words import names_of

_clone = attrgetter("clone")
_known: tuple[tuple[Curve, ...], bool] = ((), False)


# Making them


def add_clones(document: Document, curves: Collection[int], identity: Callable[[], str]) -> Added:
    """Add clones of curves, in their order, on them and as they look; see `add_copies`.

    `identity` makes one for a curve that had no clone before.
    """
    originals = list(document.curves)
    for place in curves:
        if not originals[place].identity:
            originals[place] = replace(originals[place], identity=identity())
    document = replace(document, curves=tuple(originals))
    added = add_copies(document, curves)
    new = list(added.document.curves)
    for original, place in zip(sorted(curves), added.places, strict=True):
        clone = Clone(document.curves[original].identity)
        new[place] = replace(new[place], identity="", text=None, clone=clone)
    return Added(replace(added.document, curves=tuple(new)), added.places)


def unlinked(document: Document, curves: Collection[int]) -> Document:
    """Return the document in which these curves are clones no more; they stay as they are."""
    new = (replace(each, clone=None) if at in curves else each for at, each in enumerate(document.curves))
    return replace(document, curves=tuple(new))


def original_of(document: Document, place: int) -> int:
    """Return the place of what a curve is a clone of; −1 for none."""
    clone = document.curves[place].clone
    if clone is None:
        return -1
    return next((at for at, each in enumerate(document.curves) if each.identity == clone.of), -1)


def words_of_clones(document: Document, places: Collection[int]) -> str:
    """Return of what curves are a clone, to follow their name; empty where they are none."""
    if not all(document.curves[place].clone is not None for place in places):
        return ""
    originals = {original_of(document, place) for place in places}
    return f", a clone of “{named(document, originals)}”" if originals and -1 not in originals else ""


def words_about_unlinked(before: Document, after: Document) -> str:
    """Return which clones of `before` are curves of their own now, as a sentence; empty for none."""
    if not _are_clones_in(before):
        return ""
    # Several may have one name: what shows a group has those of what is in it.
    were, are = (
        Counter(each.name for each in one.curves if each.clone is not None) for one in (before, after)
    )
    plain = Counter(each.name for each in after.curves if each.clone is None)
    plain.subtract(each.name for each in before.curves if each.clone is None)
    names = [f"“{name}”" for name, fewer in (were - are).items() for _ in range(min(fewer, plain[name]))]
    if not names:
        return ""
    return f"{names_of(names)} {'is no clone' if len(names) == 1 else 'are no clones'} any more."


# Following


def followed(document: Document, before: Document, shown: Document) -> Document:
    """Return the document whose clones run as their originals do.

    Those that the edit itself has changed since `before`, or since what is `shown`, stay as they are.
    """
    if not (_are_clones_in(before) or (reshaped(shown, document) is None and _has_clones(document))):
        return document
    return _Following(document, before, shown).followed()


def settled(document: Document, before: Document, shown: Document) -> Document:
    """Return the same for a step of the history: a clone that was moved has another map.

    One that runs otherwise than its original, or has lost that, is a clone no more.
    """
    if not (_are_clones_in(before) or (reshaped(shown, document) is None and _has_clones(document))):
        return document
    return _Following(document, before, shown).settled()


def _has_clones(document: Document) -> bool:
    return any(map(_clone, document.curves))


def _are_clones_in(before: Document) -> bool:
    """Whether there are clones in the last step of the history, which is asked at every move of a drag."""
    global _known  # noqa: PLW0603
    if _known[0] is not before.curves:
        _known = before.curves, _has_clones(before)
    return _known[1]


class _Following:
    """Clones of a document, their originals, and both as they were."""

    def __init__(self, document: Document, before: Document, shown: Document) -> None:
        self._document = document
        self._before = _by_identity(before.curves)
        self._now = _by_identity(document.curves, self._before)
        self._untouched: dict[int, tuple[Curve, Mapping[str, Curve]]] = {}
        for each, originals in ((shown, _by_identity(shown.curves)), (before, self._before)):
            clones = (curve for curve in each.curves if curve.clone is not None)
            self._untouched |= {id(curve.points): (curve, originals) for curve in clones}
        self._done: dict[int, Curve] = {}

    def followed(self) -> Document:
        """Return the document with what runs as an original does that has changed."""
        return self._with(lambda curve: self._following(curve, ()))

    def settled(self) -> Document:
        """Return it with the maps of clones that were moved, without those that are none any more."""
        document = self._with(lambda curve: self._own(self._following(curve, ())))
        if document is not self._document:
            self._document, self._done = document, {}
            self._now = _by_identity(document.curves, self._before)
        return self._with(self._settled)

    def _with(self, edit: Callable[[Curve], Curve]) -> Document:
        curves = tuple(
            edit(curve) if curve.clone is not None or curve.identity else curve
            for curve in self._document.curves
        )
        is_same = all(new is old for new, old in zip(curves, self._document.curves, strict=True))
        return self._document if is_same else replace(self._document, curves=curves)

    def _own(self, curve: Curve) -> Curve:
        """Return a curve without the identity of another one, of which it is a copy."""
        own = self._now.get(curve.identity)
        is_copy = own is not None and own.name != curve.name
        return replace(curve, identity="") if is_copy else curve

    def _following(self, curve: Curve, within: Sequence[str]) -> Curve:
        clone = curve.clone
        if clone is None or id(curve) in self._done:
            return self._done.get(id(curve), curve)
        found, known = self._now.get(clone.of), self._untouched.get(id(curve.points))
        if found is None or known is None or clone.of in within:
            return curve
        original, (was, originals) = self._following(found, (*within, clone.of)), known
        before = originals.get(clone.of)
        if before is None or _is_same_course(original, before) or rules_of(curve) != rules_of(was):
            return curve
        try:
            points = mapped_points(original, map_of(clone))
        except EditError:
            # Beyond all limits: it stays, and is a clone no more.
            return curve
        values = {name: getattr(original, name) for name in RULES}
        if original.style is not before.style:
            values["style"] = style_followed(curve.style, before.style, original.style, map_of(clone))
        if len(points) == len(before.points) == len(curve.points):
            # Where the person put it, and the same object, as long as its original is.
            trios = zip(points, original.points, before.points, curve.points, strict=True)
            points = tuple(own if now is then else point for point, now, then, own in trios)
        self._done[id(curve)] = new = replace(with_values(curve, values), points=points)
        return new

    def _settled(self, curve: Curve) -> Curve:
        clone = curve.clone
        if clone is None:
            return curve
        original = self._now.get(clone.of)
        if original is None or original is curve or rules_of(original) != rules_of(curve):
            return replace(curve, clone=None)
        by: Affine | None = map_of(clone)
        if not runs_as(original, curve.points, map_of(clone)):
            by = map_between(original, curve.points)
            clone = clone if by is None else clone_by(clone.of, by)
        if by is None or not is_image(original, by):
            return replace(curve, clone=None)
        return curve if clone == curve.clone else replace(curve, clone=clone)


def _by_identity(curves: Sequence[Curve], before: Mapping[str, Curve] | None = None) -> dict[str, Curve]:
    """Return the originals; of several of an identity the one that had it before, the others being copies."""
    found: dict[str, Curve] = {}
    for curve in curves:
        if not curve.identity:
            continue
        if curve.identity in found:
            was = before.get(curve.identity) if before else None
            if was is None or curve.name != was.name:
                continue
        found[curve.identity] = curve
    return found


def _is_same_course(one: Curve, other: Curve) -> bool:
    return one is other or (
        one.points is other.points and rules_of(one) == rules_of(other) and one.style is other.style
    )
