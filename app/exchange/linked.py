"""Pictures of a drawing whose files lie beside it: read from its own folder, and from nowhere else."""

from __future__ import annotations

from base64 import b64encode
from pathlib import Path
from urllib.parse import unquote

from msgspec.structs import replace

from ..document.content import MOST_DATA, MOST_PIXELS, Inner, Picture
from ..document.contents import corners_of, plane_of, shortened
from ..document.model import Curve, Document
from .picture_sizes import size_of

_LARGEST = MOST_DATA // 4 * 3
"""Bytes of all of them."""


def with_files(document: Document, folder: Path) -> Document:
    """Return the document with the pictures that lie in the folder of its drawing, or below."""
    reader = _Reader(folder)
    curves = tuple(map(reader.with_file, document.curves))
    is_same = all(new is old for new, old in zip(curves, document.curves, strict=True))
    return document if is_same else replace(document, curves=curves)


def words_about_missing(document: Document) -> tuple[str, ...]:
    """Return a sentence for each picture whose file is not there."""
    links = (
        each.form.link for each in document.curves if isinstance(each.form, Picture) and _is_missing(each)
    )
    return tuple(
        f"“{shortened(Path(link).name or link)}” is no PNG or JPEG picture of up to "
        f"{MOST_PIXELS // 1_000_000} megapixels in the folder of the drawing: a frame shows where it is."
        for link in dict.fromkeys(links)
    )


def _is_missing(curve: Curve) -> bool:
    return isinstance(curve.form, Picture) and bool(curve.form.link) and not curve.form.data


class _Reader:
    """Reads each file once, and of all no more than a document may hold."""

    def __init__(self, folder: Path) -> None:
        self._folder, self._left = folder, _LARGEST
        self._known: dict[str, bytes] = {}

    def with_file(self, curve: Curve) -> Curve:
        """Return the frame of a picture with what its file holds; any other curve as it is."""
        picture = curve.form
        if not isinstance(picture, Picture) or picture.data or not picture.link:
            return curve
        data = self._data(picture.link)
        size = size_of(data)
        if size is None:
            return curve
        part = picture.part if picture.stretched else _fitted(curve, picture, size)
        return replace(curve, form=replace(picture, data=b64encode(data).decode(), part=part))

    def _data(self, link: str) -> bytes:
        if link not in self._known:
            self._known[link] = data = self._read(link)
            self._left -= len(data)
        return self._known[link]

    def _read(self, link: str) -> bytes:
        name = unquote(link)
        # A colon begins another drive, or what is no file; a stroke another computer.
        if any(each in name for each in (":", "\0")) or name.startswith(("/", "\\")):
            return b""
        try:
            folder = self._folder.resolve(strict=True)
            path = (folder / name).resolve(strict=True)
            if not path.is_relative_to(folder) or not path.is_file() or path.stat().st_size > self._left:
                return b""
            return path.read_bytes()
        except (OSError, ValueError, RuntimeError):
            return b""


def _fitted(curve: Curve, picture: Picture, size: tuple[float, float]) -> Inner:
    """Return what a frame shows of a picture in the middle of its place, as large as it fits there.

    What the frame has shown so far is a part of that place.
    """
    plane = plane_of(picture, corners_of(curve))
    (a, b), (c, d) = plane.across, plane.down
    frame = (a * a + b * b) ** 0.5 / (c * c + d * d) ** 0.5
    ratio = frame / (size[0] / size[1])
    across, down = max(ratio, 1.0), max(1.0 / ratio, 1.0)
    left, top, right, bottom = picture.part
    return (
        0.5 + (left - 0.5) * across,
        0.5 + (top - 0.5) * down,
        0.5 + (right - 0.5) * across,
        0.5 + (bottom - 0.5) * down,
    )
