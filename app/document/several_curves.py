"""Edits of several curves at once, and of points of several curves that change together.

`curves` are indices of curves. An edit changes all of them or raises `EditError`.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Iterable, Sequence
from functools import partial
from itertools import chain, islice
from typing import Final, NamedTuple

from msgspec.structs import replace

from .curve_edits import map_curves, refuse_locked, remove_curve, unused_copy_name, without_curve
from .fields import fields_of
from .group_edits import as_contained, with_unused_group_names
from .groups import OUTSIDE, Container, expand_to_shapes, node_count_label, shape_of, tidy_shapes, whole_nodes
from .model import Curve, Document, Vector
from .point_edits import PointsChange, shift_points, translation
from .point_group import PointGroup, PointsEdit
from .style import INK, NO_PAINT, Style
from .transforms import Affine, decimal_translation, positions_mapped, transform_points
from .words import count_of


class AddedCurves(NamedTuple):
    """A document with copies of curves, and the indices of the copies in the order of the originals."""

    document: Document
    indices: tuple[int, ...]


def whole_curves(document: Document, curves: Collection[int]) -> PointGroup:
    """Return all points of some curves, as a group that is named as a whole."""
    indices = sorted(curves)
    return PointGroup(
        tuple((curve, frozenset(range(len(document.curves[curve].points)))) for curve in indices),
        is_whole=True,
        name=(name := common_name(document, indices)),
        several_label="" if name is not None else count_label(document, indices),
    )


def unlocked_curves(document: Document, curves: Collection[int]) -> frozenset[int]:
    """Return the unlocked ones of some curves; if all are locked, all of them, so that the edit refuses."""
    curves = frozenset(curves)
    return frozenset(index for index in curves if not document.curves[index].locked) or curves


def locked_remark(document: Document, curves: Collection[int]) -> str:
    """Return the remark "1 locked curve stays" about the locked ones of some curves; empty for none."""
    locked = frozenset(curves) - unlocked_curves(document, curves)
    if not locked:
        return ""
    nodes = whole_nodes(document.curves, expand_to_shapes(document, locked))
    return f"{node_count_label(nodes, 'locked ')} {'stays' if len(nodes) == 1 else 'stay'}"


def whole_unlocked_curves(document: Document, curves: Collection[int]) -> PointGroup:
    """Return all points of the `unlocked_curves` of some curves; its remark says which curves are locked."""
    unlocked = unlocked_curves(document, curves)
    return replace(whole_curves(document, unlocked), remark=locked_remark(document, curves))


# Edits


def move_group(document: Document, group: PointGroup, by: Vector) -> Document:
    """Move the points of a group; their derivatives stay."""
    return _whole_shifted(document, group, translation(by))


def step_group(document: Document, group: PointGroup, by: Vector) -> Document:
    """Move the points of a group by decimal steps; see `decimal_translation`."""
    return _whole_shifted(document, group, decimal_translation(by))


def transform_group(document: Document, group: PointGroup, by: Affine) -> Document:
    """Transform the points of a group and their explicit derivatives."""
    edit = partial(transform_points, by=by)
    return _changed_whole(document, group, positions_mapped(by), edit, _has_only_positions)


def set_appearance(
    document: Document,
    curves: Collection[int],
    *,
    visible: bool | None = None,
    locked: bool | None = None,
    colour: str | None = None,
) -> Document:
    """Show or hide curves, lock or unlock them, set their colour; None leaves each as it is."""
    flags = {"visible": visible, "locked": locked}
    changes = {name: value for name, value in flags.items() if value is not None}

    def edit(curve: Curve) -> Curve:
        style = curve.style if colour is None else curve.style.in_colour(colour)
        return replace(curve, **changes, style=style)

    return _map_shapes(document, curves, edit)


def show_all(document: Document) -> Document:
    """Show all curves."""
    return set_appearance(document, range(len(document.curves)), visible=True)


def unlock_all(document: Document) -> Document:
    """Unlock all curves."""
    return set_appearance(document, range(len(document.curves)), locked=False)


def remove_curves(document: Document, curves: Collection[int]) -> Document:
    """Remove curves; an empty curve takes the place of the last one."""
    before = document
    for curve in sorted(curves, reverse=True):
        document = remove_curve(document, curve)
    refuse_locked(before, document)
    return document


def extract_curves(document: Document, curves: Collection[int]) -> Document:
    """Return a document of some of the curves alone, without the reference image."""
    extracted = tuple(document.curves[index] for index in sorted(curves))
    return tidy_shapes(replace(document, curves=extracted, image=None))


def reorder_curves(document: Document, order: Sequence[int]) -> Document:
    """Return the document with its curves in another order, given by their present indices."""
    return replace(document, curves=tuple(document.curves[index] for index in order))


def index_of(document: Document, curve: Curve) -> int:
    """Return the index of a curve, found by identity: another one may be equal to it."""
    return next(index for index, other in enumerate(document.curves) if other is curve)


def active_after_removal(
    document: Document, curves: Collection[int], active: int, preferred: Collection[int] = ()
) -> int:
    """Return the index of the active curve after `curves` were removed.

    It is the nearest remaining curve of the `preferred` ones, or of the shape of the active one; if none
    remains, the curve at the index of the active one.
    """
    remaining = [index for index in preferred or shape_of(document, active) if index not in curves]
    nearest = min(remaining, key=lambda index: abs(index - active), default=active)
    before = sum(index not in curves for index in range(nearest))
    return max(0, min(before, len(document.curves) - len(curves) - 1))


def duplicate_curves(document: Document, curves: Collection[int]) -> AddedCurves:
    """Add copies of curves, in their order and style, visible and unlocked.

    Each copy is in the group of its original, in front of the last original there. Copies of whole shapes and
    groups are shapes and groups of their own; copies of a part of a shape are in front of it, not in it.
    """
    copied = dict[Container, tuple[int, list[int]]]()
    for node in whole_nodes(document.curves, curves):
        container, end = node.container, node.indices.stop
        if container.shape:
            container, end = container.parent, shape_of(document, node.indices.start).stop
        _, before = copied.get(container, (end, []))
        copied[container] = (end, [*before, *node.indices])
    new, indices = document, dict[int, int]()
    for container, (end, originals) in sorted(copied.items(), key=lambda entry: entry[1][0]):
        at = end + len(indices)
        copies = list(as_contained(document.curves, originals, container).values())
        new = add_curves(new, copies, at, container)
        indices |= zip(originals, range(at, at + len(originals)), strict=True)
    return AddedCurves(new, tuple(indices[curve] for curve in sorted(indices)))


def add_curves(
    document: Document, curves: Sequence[Curve], at: int, container: Container = OUTSIDE
) -> Document:
    """Add curves from another document at index `at`, visible and unlocked, under unused names.

    Of the shapes and groups that they are in, only the `container` keeps its name.
    """
    added = with_unused_group_names(
        with_unused_names(curves, {curve.name for curve in document.curves}), document, container
    )
    return replace(document, curves=(*document.curves[:at], *added, *document.curves[at:]))


def add_imported(document: Document, new: Document) -> tuple[Document, int]:
    """Return the document with the curves of another one in front, and the index of the first of them.

    A blank document is replaced, with its unit and guides. The reference image of the other document is added
    where there is none yet.
    """
    is_replaced = is_blank(document)
    base, image = without_curve(document, 0) if is_replaced else document, document.image or new.image
    index, added = len(base.curves), with_unused_group_names(new.curves, base)
    document = replace(base, curves=(*base.curves, *added), image=image)
    if not is_replaced:
        return document, index
    return replace(document, unit=new.unit or document.unit, guides=new.guides or document.guides), 0


def ignored_on_import(document: Document, new: Document) -> list[str]:
    """Return the parts of the other document that `add_imported` ignores, such as "its grid"."""
    ignored = ["its reference image"] if new.image and document.image else []
    if is_blank(document):
        return ignored
    if new.unit not in ("", document.unit):
        ignored.append(f"its unit {new.unit}")
    if new.grid_spacing not in (0.0, document.grid_spacing):
        ignored.append("its grid")
    guides = set(new.guides) - set(document.guides)
    return [*ignored, *([count_of(len(guides), "guide")] if guides else [])]


def is_blank(document: Document) -> bool:
    """Return whether a document equals that of File > New: one curve without points."""
    return len(document.curves) == 1 and not document.curves[0].points


def with_unused_names(curves: Sequence[Curve], used_names: Collection[str]) -> list[Curve]:
    """Return the curves, visible and unlocked, under unused names: "Leaf", "Leaf copy", "Leaf copy 2"."""
    used, result = set(used_names), []
    for curve in curves:
        name = unused_copy_name(curve.name, used)
        used.add(name)
        result.append(replace(curve, name=name, visible=True, locked=False))
    return result


def name_or_count(document: Document, curves: Collection[int]) -> str:
    """Return the `common_name` of curves, or "3 curves"."""
    name = common_name(document, curves)
    return count_label(document, curves) if name is None else name


def count_label(document: Document, curves: Collection[int]) -> str:
    """Return "3 curves", or "1 shape and 2 curves" where whole shapes or groups are among them."""
    if any(document.curves[index].shape or document.curves[index].groups for index in curves):
        return node_count_label(whole_nodes(document.curves, curves))
    return count_of(len(curves), "curve")


def common_name(document: Document, curves: Collection[int]) -> str | None:
    """Return the name of the one curve, shape or group that `curves` make up; None where they are several."""
    if len(curves) == 1:
        return document.curves[next(iter(curves))].name
    first = document.curves[min(curves, default=0)]
    if not curves or not (first.shape or first.groups):
        return None
    nodes = whole_nodes(document.curves, curves)
    return nodes[0].name if len(nodes) == 1 else None


def _whole_shifted(document: Document, group: PointGroup, shift: PointsChange) -> Document:
    """Move the points of a group, all in the same way; see `shift_points`."""
    return _changed_whole(document, group, shift, partial(shift_points, shift=shift), lambda _: True)


def _has_only_positions(curve: Curve) -> bool:
    """Return whether nothing but positions changes when all points of a curve are moved."""
    return not (curve.has_derivatives or (curve.closed and curve.is_manual))


def _changed_whole(
    document: Document,
    group: PointGroup,
    change: PointsChange,
    edit: PointsEdit,
    is_simple: Callable[[Curve], bool],
) -> Document:
    """Change whole simple curves at once, and edit the others one by one."""
    group.refuse_locked(document)
    curves, rest, whole = list(document.curves), list[tuple[int, frozenset[int]]](), list[int]()
    for part in group.parts:
        curve = curves[part[0]]
        if len(part[1]) == len(curve.points) and is_simple(curve):
            whole.append(part[0])
        else:
            rest.append(part)
    if whole:
        new = iter(change([*chain.from_iterable([curves[index].points for index in whole])]))
        for index in whole:
            curve = curves[index]
            curves[index] = replace(curve, points=tuple(islice(new, len(curve.points))))
        document = replace(document, curves=tuple(curves))
    return replace(group, parts=tuple(rest)).apply_to_each(document, edit) if rest else document


# Stroke and fill

STYLE_WORDS: Final = {field.name: field.label for field in fields_of(Style)}
"""Labels of the fields of a style, as steps of the history name them: "Stroke width of Leaf"."""


def set_style(document: Document, curves: Collection[int], **fields: object) -> Document:
    """Set some fields of the styles of curves."""
    return _map_shapes(document, curves, lambda curve: replace(curve, style=replace(curve.style, **fields)))


def colours_of(curves: Iterable[Curve]) -> list[str]:
    """Return the colours of the fills and strokes of curves, the most frequent first."""
    counts = Counter[str]()
    for curve in curves:
        counts.update([curve.style.fill, curve.style.stroke])
    return [paint for paint, _ in counts.most_common() if paint not in (INK, NO_PAINT)]


def swap_paints(document: Document, curves: Collection[int]) -> Document:
    """Exchange the paints of fill and stroke of curves."""
    return _map_shapes(document, curves, lambda curve: replace(curve, style=curve.style.swapped))


def _map_shapes(document: Document, curves: Collection[int], edit: Callable[[Curve], Curve]) -> Document:
    """Edit each of these curves and of the others of their shapes."""
    return map_curves(document, expand_to_shapes(document, curves), edit)


def common_values(styles: Iterable[Style]) -> dict[str, object]:
    """Return the values that all of the styles have in common, by their fields; empty for no styles."""
    styles = list(styles)
    if not styles:
        return {}
    first, *others = styles
    values = {name: getattr(first, name) for name in Style.__struct_fields__}
    return {name: value for name, value in values.items() if all(getattr(s, name) == value for s in others)}
