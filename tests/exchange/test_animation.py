"""Motions as files: read back with Pillow, and what is left when something goes wrong."""

from __future__ import annotations

import builtins
import os

import numpy as np
import pytest
from PIL import Image, ImageSequence

from app.document import rule_edits
from app.document.derivatives import VelocityRule
from app.document.model import Document, make_curve
from app.exchange import drawing
from app.exchange.drawing.film import FILMS, Film, write_film
from app.exchange.drawing.styles import DARK
from app.exchange.errors import ExchangeError
from app.families import FAMILIES, HERMITE, QUINTIC_HERMITE
from app.storage.examples import first_sketch
from app.storage.files import StorageError
from app.tasks.progress import FINAL, Cancelled
from app.view_model.motion_settings import Pace, Repeat
from app.view_model.palette import ACCENT, PAPER, colour_on
from tests.programs import write_program

# Frames are painted with the application of the window where there is one; without, see tests/test_cli.py.
pytestmark = pytest.mark.usefixtures("qapp")

VIDEO = next(each for each in FILMS if each.ending == ".mp4")
SMALL = {"width": 80, "fps": 10, "seconds": 1.2}


def bytes_of(colour):
    return tuple(bytes.fromhex(colour[1:]))


def frames_of(path):
    with Image.open(path) as film:
        return [
            (np.asarray(each.convert("RGB"), dtype=int), each.info["duration"])
            for each in ImageSequence.Iterator(film)
        ]


@pytest.mark.parametrize("ending", [".gif", ".apng", ".png"])
@pytest.mark.parametrize("repeat", list(Repeat))
def test_a_film_has_its_frames_size_durations_and_loop(tmp_path, ending, repeat):
    path, shares = tmp_path / f"film{ending}", []
    film = Film(**SMALL, repeat=repeat)
    write_film(first_sketch(), path, film, report=lambda share, _word: shares.append(share))
    frames = frames_of(path)
    assert len(frames) == film.frames == 12
    assert [duration for _, duration in frames] == [100] * 12
    assert {pixels.shape for pixels, _ in frames} == {frames[0][0].shape}
    assert frames[0][0].shape[1] == 80
    assert shares[:-1] == pytest.approx(np.arange(1, 13) / 12)
    assert shares[-1] == FINAL
    with Image.open(path) as read:
        forever = repeat is not Repeat.ONCE
        assert read.info.get("loop") == (0 if forever else None if ending == ".gif" else 1)


@pytest.mark.parametrize("fps", [3, 7, 24, 30, 50])
def test_durations_that_a_format_cannot_hold_are_spread(tmp_path, fps):
    film = Film(width=32, fps=fps, seconds=1)
    write_film(first_sketch(), tmp_path / "film.gif", film)
    durations = [duration for _, duration in frames_of(tmp_path / "film.gif")]
    assert len(durations) == fps
    assert sum(durations) == 1000
    assert max(durations) - min(durations) <= 10


def test_the_dot_follows_the_curve(tmp_path):
    line = Document((make_curve([(0.0, 0.0), (4.0, 0.0)]),))
    film = Film(width=200, fps=10, seconds=1, repeat=Repeat.ONCE, style=DARK, points=False)
    write_film(line, tmp_path / "film.apng", film)
    frames = [pixels for pixels, _ in frames_of(tmp_path / "film.apng")]
    blue = [np.argwhere(np.abs(pixels - bytes_of(ACCENT["dark"])).sum(axis=2) < 30) for pixels in frames]
    places = np.array([each[:, 1].mean() for each in blue])
    # Equal steps to the right, and the paper of the dark style in the corner.
    assert np.diff(places) == pytest.approx(np.diff(places).mean(), abs=3)
    assert np.diff(places).mean() > 10
    assert frames[0][0, 0].tolist() == [0x15, 0x18, 0x1C]


def test_a_loop_is_seamless(tmp_path):
    write_film(first_sketch(), tmp_path / "film.apng", Film(width=120, fps=20, seconds=2))
    frames = [pixels for pixels, _ in frames_of(tmp_path / "film.apng")]
    steps = [np.abs(a - b).mean() for a, b in zip(frames, [*frames[1:], frames[0]], strict=True)]
    # The dot jumps from end to beginning; but for that, the seam is a step like others.
    assert steps[-1] < 3 * np.median(steps)


def test_cubic_and_quintic_run_side_by_side(tmp_path):
    document = rule_edits.set_rule(first_sketch(), 0, VelocityRule.CATMULL_ROM)
    film = Film(width=320, fps=4, seconds=1, compared=frozenset((HERMITE, QUINTIC_HERMITE)), pace=Pace.LENGTH)
    write_film(document, tmp_path / "film.apng", film)
    pixels = frames_of(tmp_path / "film.apng")[1][0]
    for colour in (colour_on(PAPER["light"], code) for code in ("#d55e00", "#009e73")):
        assert (np.abs(pixels - bytes_of(colour)).sum(axis=2) < 30).any()


def stops_after(times):
    """A report that is told so many times, and then takes the order back."""
    told = []

    def report(share, _word):
        told.append(share)
        if len(told) > times:
            raise Cancelled

    return report


@pytest.mark.parametrize("ending", [".gif", ".apng"])
def test_a_cancelled_film_leaves_the_old_file(tmp_path, ending):
    path = tmp_path / f"film{ending}"
    path.write_bytes(b"old")
    with pytest.raises(Cancelled):
        write_film(first_sketch(), path, Film(**SMALL), report=stops_after(5))
    assert path.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [path]


def test_a_film_that_cannot_be_written_leaves_no_file(tmp_path):
    with pytest.raises(StorageError, match="does not exist"):
        write_film(first_sketch(), tmp_path / "no" / "film.gif", Film(**SMALL))
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("fields", "words"),
    [
        ({"width": 4}, "16 to 1920 pixels"),
        ({"fps": 60}, "1 to 50 frames"),
        ({"seconds": 100.0}, "1200 frames"),
        ({"width": 1920, "seconds": 40.0}, "too large"),
    ],
)
def test_oversized_films_are_refused_before_the_work(tmp_path, fields, words):
    with pytest.raises(ExchangeError, match=words):
        write_film(first_sketch(), tmp_path / "film.gif", Film(**fields))
    assert list(tmp_path.iterdir()) == []


def test_without_a_curve_there_is_no_motion(tmp_path):
    begun = Document((make_curve([(1.0, 1.0)]),))
    with pytest.raises(ExchangeError, match="at least two points"):
        write_film(begun, tmp_path / "film.gif", Film(**SMALL))
    with pytest.raises(ExchangeError, match="known file extension"):
        write_film(first_sketch(), tmp_path / "film.webp", Film(**SMALL))


def test_without_pillow_the_refusal_names_the_extra(tmp_path, monkeypatch, forget):
    forget(drawing, "pillow")
    real = builtins.__import__

    def without(name, *arguments, **keywords):
        if name == "PIL":
            raise ImportError(name)
        return real(name, *arguments, **keywords)

    monkeypatch.setattr(builtins, "__import__", without)
    with pytest.raises(ExchangeError, match=r"curvebench\[animation\]"):
        write_film(first_sketch(), tmp_path / "film.gif", Film(**SMALL))


FFMPEG = """
import pathlib, sys
words = sys.argv[1:]
size = words[words.index("-s") + 1]
if {fails}:
    print("Unknown encoder", file=sys.stderr)
    sys.exit(3)
if {hangs}:
    import signal
    pathlib.Path(sys.argv[0] + ".pid").write_text(str(__import__("os").getpid()))
    signal.pause()
data = sys.stdin.buffer.read()
pathlib.Path(words[-1]).write_text(f"{{size}} {{len(data)}} {{words[words.index('-r') + 1]}}")
"""


@pytest.fixture
def ffmpeg(tmp_path, monkeypatch):
    """A program of this name that writes what it was told, or fails."""

    def install(*, fails=False, hangs=False):
        folder = tmp_path / "bin"
        folder.mkdir()
        write_program(folder / "ffmpeg", FFMPEG.format(fails=fails, hangs=hangs))
        monkeypatch.setenv("PATH", str(folder))

    return install


@pytest.mark.skipif(os.name == "nt", reason="a script is no program there")
def test_ffmpeg_is_fed_with_frames(tmp_path, ffmpeg):
    ffmpeg()
    write_film(first_sketch(), tmp_path / "film.mp4", Film(**SMALL))
    size, count, rate = (tmp_path / "film.mp4").read_text().split()
    width, height = map(int, size.split("x"))
    assert width == 80
    assert height % 2 == 0
    assert int(count) == 12 * width * height * 4
    assert rate == "10"


@pytest.mark.skipif(os.name == "nt", reason="a script is no program there")
def test_a_failing_or_cancelled_ffmpeg_leaves_no_file(tmp_path, ffmpeg):
    ffmpeg(fails=True)
    with pytest.raises(ExchangeError, match=r"code 3\. Unknown encoder"):
        write_film(first_sketch(), tmp_path / "film.mp4", Film(**SMALL))
    with pytest.raises((Cancelled, ExchangeError)):
        write_film(first_sketch(), tmp_path / "film.mp4", Film(**SMALL), report=stops_after(3))
    assert list(tmp_path.iterdir()) == [tmp_path / "bin"]


@pytest.mark.skipif(os.name == "nt", reason="a script is no program there")
@pytest.mark.parametrize("width", [1000, 64], ids=["while it is fed", "at the end"])
def test_stopping_ends_an_ffmpeg_that_does_nothing(tmp_path, ffmpeg, width):
    """Stop was heard between two frames only: the thread hung in the pipe, or waited for the end."""
    ffmpeg(hangs=True)
    note = tmp_path / "bin" / "ffmpeg.pid"
    at_the_end = []

    def hangs(share, _word):
        at_the_end.extend([share] * (share == 1))
        # The last frame says 1 too.
        if note.exists() and (width > 64 or len(at_the_end) > 2):
            raise Cancelled

    film = Film(width=width, fps=1, seconds=2)
    with pytest.raises(Cancelled):
        write_film(first_sketch(), tmp_path / "film.mp4", film, report=hangs)
    with pytest.raises(ProcessLookupError):
        os.kill(int(note.read_text()), 0)


def test_without_ffmpeg_a_film_is_refused(tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    assert VIDEO.missing()
    with pytest.raises(ExchangeError, match="not on the PATH"):
        write_film(first_sketch(), tmp_path / "film.mp4", Film(**SMALL))


@pytest.mark.skipif(bool(VIDEO.missing()), reason="ffmpeg is not on the PATH")
def test_the_real_ffmpeg_makes_a_film(tmp_path):
    write_film(first_sketch(), tmp_path / "film.mp4", Film(**SMALL))
    assert (tmp_path / "film.mp4").read_bytes()[4:8] == b"ftyp"


@pytest.mark.parametrize("family", FAMILIES)
def test_every_family_runs(tmp_path, family):
    points = np.random.default_rng(7).normal(size=(7, 2)).tolist()
    write_film(Document((make_curve(points, family=family),)), tmp_path / "film.gif", Film(**SMALL))
    assert len(frames_of(tmp_path / "film.gif")) == 12
