"""Edits of the picture to trace: pure functions like those of `edits`."""

from __future__ import annotations

import math

from msgspec.structs import replace

from .decimals import decimal_sum
from .limits import EditError, checked, checked_vector
from .model import Document, ReferenceImage, Vector

_LEAST_SIZE = 1e-9


def set_image(document: Document, image: ReferenceImage | None) -> Document:
    """Trace this picture, or none."""
    return replace(document, image=image)


def _image(document: Document) -> ReferenceImage:
    if document.image is None:
        raise EditError("There is no reference image.")
    return document.image


def place_image(document: Document, corner: Vector | None = None, width: float | None = None) -> Document:
    """Put the picture's lower left corner at `corner` and make it `width` wide; its aspect stays.

    What is not given stays, too.
    """
    image = _image(document)
    width = checked(image.width if width is None else width, "The width of the image")
    height = checked(width * (image.height / image.width), "The height of the image")
    if not min(width, height) >= _LEAST_SIZE:
        raise EditError("The image must be wider and higher than nothing.")
    x, y = checked_vector((image.x, image.y) if corner is None else corner, "the image")
    return replace(document, image=replace(image, x=x, y=y, width=width, height=height))


def move_image(document: Document, by: Vector) -> Document:
    """Move the picture by the vector `by`."""
    image = _image(document)
    return place_image(document, (image.x + by[0], image.y + by[1]))


def step_image(document: Document, by: Vector) -> Document:
    """Move the picture by a decimal step, as `stepping` does."""
    image = _image(document)
    return place_image(document, (decimal_sum(image.x, by[0]), decimal_sum(image.y, by[1])))


def scale_image(document: Document, corner: Vector, factor: float) -> Document:
    """Scale the picture by `factor` about one of its corners, given in shares: (0, 0) is the lower left."""
    image = _image(document)
    x = image.x + corner[0] * image.width * (1 - factor)
    y = image.y + corner[1] * image.height * (1 - factor)
    return place_image(document, (x, y), image.width * factor)


def set_image_opacity(document: Document, opacity: float) -> Document:
    """Fade the picture."""
    if not 0 <= opacity <= 1:
        raise EditError("The opacity must lie between 0 and 1.")
    return replace(document, image=replace(_image(document), opacity=float(opacity)))


def set_image_locked(document: Document, locked: bool) -> Document:
    """Keep the picture safe from being moved, or free it."""
    return replace(document, image=replace(_image(document), locked=locked))


def set_image_file(document: Document, path: str, aspect: float) -> Document:
    """Show another file at the same place; `aspect` is its width over its height."""
    image = _image(document)
    if not 0.0 < aspect < math.inf:
        raise EditError("The image must be wider and higher than nothing.")
    found = replace(document, image=replace(image, path=path, height=image.width / aspect))
    return place_image(found)
