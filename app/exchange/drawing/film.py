"""Films of a motion along a curve: GIF and APNG by Pillow (the extra ``animation``), MP4 by ffmpeg.

A `Film` says what is shown, how large and how long; `write_film` writes it.
"""

from __future__ import annotations

import contextlib
import io
import os
import select
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

from msgspec.structs import replace

from ...document.model import Document
from ...document.style import Style
from ...families import Family
from ...storage.files import write
from ...tasks.progress import FINAL, Report, silent
from ...view_model.curve.curve_view import view_of
from ...view_model.motion import ACTIVE, Course, Role, rivals_of, round_duration
from ...view_model.motion_settings import Pace, Repeat
from .. import drawing
from ..errors import ExchangeError
from ..formats import FileKind, format_of
from .styles import LIGHT, PictureStyle

if TYPE_CHECKING:
    from PIL import Image

    from .motion_frames import FrameMaker


@dataclass(frozen=True)
class Film:
    """Content, size and length of a film.

    Attributes
    ----------
    curve
        The index of the curve in its document.
    width
        Width in pixels; made even. The height follows from the drawing.
    fps
        Frames a second.
    seconds
        Duration of the film: one round of the motion.
    compared
        The families whose curves run side by side with the curve itself.
    points
        Whether to draw the points.
    """

    curve: int = 0
    width: int = 640
    fps: int = 25
    seconds: float = 4.0
    repeat: Repeat = Repeat.LOOP
    pace: Pace = Pace.PARAMETER
    compared: frozenset[Family] = frozenset()
    style: PictureStyle = LIGHT
    points: bool = True

    @property
    def frames(self) -> int:
        """Number of frames, at least two."""
        return max(2, round(self.fps * self.seconds))

    def courses(self, document: Document) -> dict[Role, Course]:
        """Return the ways of the dots."""
        view = view_of(document.curves[self.curve])
        if not view.is_current or view.curve is None:
            raise ExchangeError(f"There is no curve to move along. {view.problem}")
        courses = {ACTIVE: Course(view.curve, self.pace)}
        for role, rival in rivals_of(view, self.compared).items():
            assert rival.curve is not None
            courses[role] = Course(rival.curve, self.pace)
        return courses

    def drawn(self, document: Document) -> Document:
        """Return the document with all curves that are seen: those that are compared are among them."""
        source = document.curves[self.curve]
        others = [
            replace(rival.source, style=Style(stroke=role.colour))
            for role, rival in rivals_of(view_of(source), self.compared).items()
            if rival.source is not source
        ]
        return Document((*others, *document.curves)) if others else document

    def durations(self, unit: int) -> list[int]:
        """Return the duration of each frame, in milliseconds that are multiples of `unit`.

        Rounded so that no frame is ever off by more than half a unit.
        """
        ends = [round(1000 * (i + 1) / self.fps / unit) * unit for i in range(self.frames)]
        return [end - start for start, end in zip([0, *ends], ends, strict=False)]


# Writers


LARGEST_WIDTH = 1920
MOST_FRAMES = 1200
FASTEST = 50
"""Frames a second; players show a GIF with shorter frames slowly."""

_LOOK_S = 0.1
"""Seconds between two questions whether anybody still waits for a program that does nothing."""


def first_round(document: Document, repeat: Repeat) -> float:
    """Return the seconds that one round along the first curve takes at its own speed."""
    return round_duration(Film().courses(document)[ACTIVE].duration, repeat)


def _missing_for_video() -> str:
    return "" if shutil.which("ffmpeg") else "MP4 needs ffmpeg, which is not on the PATH"


def write_film(
    document: Document, path: str | os.PathLike[str], film: Film, *, report: Report = silent
) -> None:
    """Write a motion in the format that the ending of `path` names.

    Parameters
    ----------
    report
        Told after every frame which share of them is done.

    Raises
    ------
    ExchangeError
        If there is no curve, the film would be too large, or what writes it is missing.
    StorageError
        If the file cannot be written; an old one stays as it was.
    Cancelled
        If `report` raised it; an old file stays as it was.
    """
    form = format_of(path, FILMS)
    _refuse_size(film)
    # Qt is slow to import: a wrong name is refused before.

    with drawing.image.application():
        maker = drawing.motion_frames.FrameMaker(document, film)
        if film.frames * maker.width * maker.height > form.most_pixels or maker.height > 2 * LARGEST_WIDTH:
            raise ExchangeError("The film is too large. Make it smaller or shorter, or use fewer frames.")
        data = form.write(maker, film, report)
    report(FINAL, "Writing")
    write(path, data)


def _refuse_size(film: Film) -> None:
    if not 16 <= film.width <= LARGEST_WIDTH:
        raise ExchangeError(f"A film must be 16 to {LARGEST_WIDTH} pixels wide.")
    if not 1 <= film.fps <= FASTEST:
        raise ExchangeError(f"A film must have 1 to {FASTEST} frames per second.")
    if not film.seconds * film.fps <= MOST_FRAMES:
        raise ExchangeError(
            f"A film can have at most {MOST_FRAMES} frames. Shorten it, or use fewer per second."
        )


def _with_progress_of_frames(maker: FrameMaker, count: int, report: Report) -> Iterator[bytes]:
    for number, frame in enumerate(maker.frames(), start=1):
        yield frame
        report(number / count, "Drawing")


def _gif(maker: FrameMaker, film: Film, report: Report) -> bytes:
    # Without the entry the film plays once.
    loop = {} if film.repeat is Repeat.ONCE else {"loop": 0}
    images = _in_one_palette(_images(maker, film, report))
    return _saved_by_pillow(images, format="GIF", duration=film.durations(10), **loop)


def _apng(maker: FrameMaker, film: Film, report: Report) -> bytes:
    loop = 1 if film.repeat is Repeat.ONCE else 0
    return _saved_by_pillow(_images(maker, film, report), format="PNG", duration=film.durations(1), loop=loop)


def _images(maker: FrameMaker, film: Film, report: Report) -> Iterator[Image.Image]:
    try:
        new = drawing.pillow.Image.frombytes
    except ImportError:
        raise ExchangeError(
            "GIF and APNG need Pillow, which is not installed: pip install 'curvebench[animation]'."
        ) from None
    size = (maker.width, maker.height)
    frames = _with_progress_of_frames(maker, film.frames, report)
    return (new("RGB", size, frame, "raw", "RGBX") for frame in frames)


def _saved_by_pillow(images: Iterator[Image.Image], **options: Any) -> bytes:  # noqa: ANN401 - Pillow's
    first, *rest = images
    buffer = io.BytesIO()
    first.save(buffer, save_all=True, append_images=rest, **options)
    return buffer.getvalue()


def _in_one_palette(images: Iterator[Image.Image]) -> Iterator[Image.Image]:
    """Reduce all images to the colours of the first, so that nothing flickers."""
    palette = None
    for image in images:
        if palette is None:
            palette = image.quantize(256, drawing.pillow.Image.Quantize.MEDIANCUT)
        yield image.quantize(palette=palette, dither=drawing.pillow.Image.Dither.NONE)


def _video(maker: FrameMaker, film: Film, report: Report) -> bytes:
    program = shutil.which("ffmpeg")
    if program is None:
        raise ExchangeError("MP4 needs ffmpeg, which is not on the PATH. Choose GIF or APNG.")
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder) / "film.mp4"
        size = f"{maker.width}x{maker.height}"
        source = ["-f", "rawvideo", "-pix_fmt", "rgb0", "-s", size, "-r", str(film.fps), "-i", "-"]
        encoding = ["-an", "-pix_fmt", "yuv420p", "-movflags", "+faststart", str(target)]
        _feed(
            [program, "-loglevel", "error", "-y", *source, *encoding],
            _with_progress_of_frames(maker, film.frames, report),
            film.frames,
            report,
        )
        try:
            return target.read_bytes()
        except FileNotFoundError:
            raise ExchangeError("ffmpeg produced no film.") from None


def _feed(command: list[str], frames: Iterator[bytes], count: int, report: Report) -> None:
    """Run a program that reads frames; end it where anything goes wrong, or `report` raises."""
    with tempfile.TemporaryFile() as output:
        try:
            process = subprocess.Popen(
                command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=output, bufsize=0
            )
        except OSError as reason:
            raise ExchangeError(f"ffmpeg cannot be started ({reason.strerror}).") from reason
        assert process.stdin is not None
        try:
            # Where the pipe breaks, the program ended early, and its exit code says why.
            with contextlib.suppress(BrokenPipeError), process.stdin as pipe:
                if os.name == "posix":  # on other systems a write blocks
                    os.set_blocking(pipe.fileno(), False)
                for number, frame in enumerate(frames):
                    _send(frame, pipe, number / count, report)
            code = _code_of(process, report)
        except BaseException:
            process.kill()
            process.wait()
            raise
        if code:
            output.seek(0)
            words = output.read(2000).decode("utf-8", "replace").strip().splitlines()
            raise ExchangeError(f"ffmpeg exited with code {code}. {words[-1] if words else ''}".strip())


def _send(frame: bytes, pipe: IO[bytes], share: float, report: Report) -> None:
    """Write to a pipe that does not block; ask in between whether anybody still waits for it.

    A program that stops reading would else hold the thread, where nothing could be raised in it.
    """
    left = memoryview(frame)
    while left:
        sent = pipe.write(left)
        if sent is None:
            if not select.select([], [pipe], [], _LOOK_S)[1]:
                report(share, "Drawing")
        else:
            left = left[sent:]


def _code_of(process: subprocess.Popen[bytes], report: Report) -> int:
    """Wait for the end of a program as long as anybody waits for it, and return its exit code."""
    while True:
        with contextlib.suppress(subprocess.TimeoutExpired):
            return process.wait(_LOOK_S)
        report(1.0, "Drawing")


@dataclass(frozen=True)
class FilmFormat(FileKind):
    """A format of films.

    Attributes
    ----------
    most_pixels
        Limit of all frames together: Pillow keeps them until the file is written, with 1 or 3 bytes a pixel.
    write
        Returns the content of a file.
    missing
        Returns what has to be there to write it and is not; empty where nothing is missing.
    """

    most_pixels: float
    write: Callable[[FrameMaker, Film, Report], bytes]
    missing: Callable[[], str] = lambda: ""


FILMS = (
    FilmFormat((".gif",), "GIF", 4e8, _gif),
    FilmFormat((".apng", ".png"), "APNG", 1.3e8, _apng),
    FilmFormat((".mp4",), "MP4", 4e9, _video, _missing_for_video),
)
"""The formats of films."""
