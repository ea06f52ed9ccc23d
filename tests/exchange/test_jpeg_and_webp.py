"""JPEG and WebP: the same picture as a PNG but for what they lose, read by another program."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace
from PIL import Image

from app.cli import main
from app.exchange.errors import ExchangeError
from app.exchange.options import Options
from app.exchange.writing import export
from app.storage.files import load, save

pytestmark = pytest.mark.usefixtures("qapp")


def colours(path):
    with Image.open(path) as image:
        return np.asarray(image.convert("RGB"), dtype=float), image.format, image.mode, image.info


@pytest.mark.parametrize(("ending", "kind"), [(".jpg", "JPEG"), (".jpeg", "JPEG"), (".webp", "WEBP")])
def test_it_shows_what_a_png_shows(example, tmp_path, ending, kind):
    export(example, tmp_path / "a.png", Options(width=400))
    export(example, tmp_path / f"a{ending}", Options(width=400))
    (expected, *_), (found, name, _, _) = colours(tmp_path / "a.png"), colours(tmp_path / f"a{ending}")
    assert name == kind
    assert found.shape == expected.shape
    # Eight bits, and what a quality of 90 loses at thin lines.
    assert np.abs(found - expected).mean() < 2.5


def test_a_jpeg_has_paper_and_whoever_wants_none_is_told(example, tmp_path):
    """A JPEG has no transparency: what is clear in a PNG was black in pictures of other programs."""
    written = export(example, tmp_path / "a.jpg", Options(width=200, transparent=True))
    assert "A JPEG cannot be seen through: it has paper." in written.remarks
    found, _, mode, _ = colours(tmp_path / "a.jpg")
    assert mode == "RGB"
    assert found[0, 0].min() >= 250
    export(example, tmp_path / "a.webp", Options(width=200, transparent=True))
    with Image.open(tmp_path / "a.webp") as image:
        assert image.mode == "RGBA"
        assert image.getpixel((0, 0))[3] == 0


def test_a_jpeg_says_how_dense_its_pixels_are(example, tmp_path):
    export(replace(example, unit="in"), tmp_path / "a.jpg", Options(dpi=150, unit="in"))
    _, _, _, info = colours(tmp_path / "a.jpg")
    assert tuple(round(each) for each in info["dpi"]) == (150, 150)


@pytest.mark.parametrize("ending", [".jpg", ".webp"])
def test_more_quality_is_a_larger_file(example, tmp_path, ending):
    source = tmp_path / "a.curve.json"
    save(source, example)
    sizes = []
    for quality in ("10", "60", "100"):
        target = tmp_path / f"a{quality}{ending}"
        assert main(["render", str(source), "-o", str(target), "--width", "300", "--quality", quality]) == 0
        again = tmp_path / f"b{quality}{ending}"
        assert main(["convert", str(source), str(again), "--width", "300", "--quality", quality]) == 0
        assert target.read_bytes() == again.read_bytes()
        sizes.append(target.stat().st_size)
    assert sizes == sorted(set(sizes))
    assert load(source) == example


def test_a_webp_larger_than_its_format_has_is_refused(example, tmp_path):
    with pytest.raises(ExchangeError, match="1 to 16383"):
        export(example, tmp_path / "a.webp", Options(width=16384))
