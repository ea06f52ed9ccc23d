"""Edits of the plane that a document is drawn in: unit, grid, guides and reference image."""

from __future__ import annotations

import math

from msgspec.structs import replace

from .limits import AlreadySoError, EditError, checked, checked_vector
from .model import Axis, Document, Guide, Paper, ReferenceImage, Vector
from .words import decimal_sum, number


def set_unit(document: Document, unit: str) -> Document:
    """Set the name of the unit; the numbers stay the same."""
    return replace(document, unit=unit)


def set_grid_spacing(document: Document, spacing: float) -> Document:
    """Set the distance of grid lines; 0 adapts it to the zoom."""
    return replace(document, grid_spacing=checked(spacing, "The spacing"))


def set_paper(document: Document, paper: Paper) -> Document:
    """Set the paper of the canvas and of exported pictures."""
    return replace(document, paper=paper)


# Guides

_DIGITS = 15


def guide_label(guide: Guide, unit: str = "") -> str:
    """Return the position of a guide: "x = 20 mm"."""
    position = number(guide.position, _DIGITS)
    return f"{guide.axis.value} = {position} {unit}".rstrip()


def add_guide(document: Document, axis: Axis, position: float) -> Document:
    """Add a guide, unless there is one at that position."""
    guide = Guide(axis, _checked(axis, position))
    if guide in document.guides:
        raise AlreadySoError(f"There is already a guide at {guide_label(guide)}.")
    return replace(document, guides=(*document.guides, guide))


def move_guide(document: Document, index: int, position: float) -> Document:
    """Move a guide along its axis."""
    guide = _guide(document, index)
    return _with_guide(document, index, replace(guide, position=_checked(guide.axis, position)))


def remove_guide(document: Document, index: int) -> Document:
    """Remove a guide."""
    _guide(document, index)
    return _with_guide(document, index)


def clear_guides(document: Document) -> Document:
    """Remove all guides."""
    if not document.guides:
        raise EditError("There are no guides to remove.")
    return replace(document, guides=())


def _checked(axis: Axis, position: float) -> float:
    return checked(position, f"The {axis.value} of a guide")


def _with_guide(document: Document, index: int, *other: Guide) -> Document:
    return replace(document, guides=(*document.guides[:index], *other, *document.guides[index + 1 :]))


def _guide(document: Document, index: int) -> Guide:
    if not 0 <= index < len(document.guides):
        raise EditError("This guide no longer exists.")
    return document.guides[index]


# Reference image

_LEAST_SIZE = 1e-9


def set_image(document: Document, image: ReferenceImage | None) -> Document:
    """Set or remove the reference image."""
    return replace(document, image=image)


def _image(document: Document) -> ReferenceImage:
    if document.image is None:
        raise EditError("There is no reference image. Add one first.")
    return document.image


def place_image(document: Document, corner: Vector | None = None, width: float | None = None) -> Document:
    """Set the lower left corner and the width of the reference image; None keeps either, the aspect stays."""
    image = _image(document)
    width = checked(image.width if width is None else width, "The width of the image")
    height = checked(width * (image.height / image.width), "The height of the image")
    if not min(width, height) >= _LEAST_SIZE:
        raise EditError("The width and the height of the image must be greater than 0.")
    x, y = checked_vector((image.x, image.y) if corner is None else corner, "the image")
    return replace(document, image=replace(image, x=x, y=y, width=width, height=height))


def move_image(document: Document, by: Vector) -> Document:
    """Move the reference image by the vector `by`."""
    image = _image(document)
    return place_image(document, (image.x + by[0], image.y + by[1]))


def step_image(document: Document, by: Vector) -> Document:
    """Move the reference image by a decimal step, as `decimal_translation` does."""
    image = _image(document)
    return place_image(document, (decimal_sum(image.x, by[0]), decimal_sum(image.y, by[1])))


def scale_image(document: Document, corner: Vector, factor: float) -> Document:
    """Scale the reference image by `factor` about a corner, (0, 0) for the lower left one."""
    image = _image(document)
    x = image.x + corner[0] * image.width * (1 - factor)
    y = image.y + corner[1] * image.height * (1 - factor)
    return place_image(document, (x, y), image.width * factor)


def set_image_opacity(document: Document, opacity: float) -> Document:
    """Set the opacity of the reference image, 0 to 1."""
    if not 0 <= opacity <= 1:
        raise EditError("The opacity must lie between 0 and 1.")
    return replace(document, image=replace(_image(document), opacity=float(opacity)))


def set_image_locked(document: Document, locked: bool) -> Document:
    """Lock or unlock the reference image."""
    return replace(document, image=replace(_image(document), locked=locked))


def set_image_file(document: Document, path: str, aspect: float) -> Document:
    """Show another image file at the same position; `aspect` is its width over its height."""
    image = _image(document)
    if not 0.0 < aspect < math.inf:
        raise EditError("The width and the height of the image must be greater than 0.")
    new = replace(document, image=replace(image, path=path, height=image.width / aspect))
    return place_image(new)
