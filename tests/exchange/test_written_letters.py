"""Letters in PDF files: words that are found, in pictures as of outlines; poppler is the judge."""

import shutil
import subprocess

import numpy as np
import pytest
from PySide6.QtGui import QImage

from app.exchange.drawing.image import pdf_file
from app.exchange.options import TEXT_AS_OUTLINES, Options
from app.exchange.svg.reader import read_svg

pytestmark = [
    pytest.mark.usefixtures("qapp"),
    pytest.mark.skipif(shutil.which("pdftotext") is None, reason="poppler is not installed"),
]

HEAD = (
    '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" width="180mm" '
    'height="60mm" viewBox="0 0 180 60" font-family="DejaVu Sans" font-size="12"><defs>'
    '<linearGradient id="g"><stop stop-color="red"/><stop offset="1" stop-color="blue"/></linearGradient>'
    '<clipPath id="c"><rect x="10" y="5" width="70" height="50"/></clipPath>'
    '<path id="p" d="M20 50C60 20 120 20 160 50"/></defs>'
)
TEXTS = {
    "plain": '<text x="9" y="30">Plain words</text>',
    "ligatures": '<text x="9" y="30">Office of efficient fluff</text>',
    "styles": '<text x="9" y="30">An <tspan font-weight="bold">old</tspan> '
    '<tspan font-style="italic">one</tspan></text>',
    "spaced": '<text x="9" y="30" letter-spacing=".7" text-decoration="underline" '
    'opacity=".5">Words apart</text>',
    "gradient": '<text x="9" y="30" fill="url(#g)">Gradient words</text>',
    "clipped": '<text x="9" y="30" clip-path="url(#c)">Clipped words</text>',
    "stroked": '<text x="9" y="30" fill="#ffa" stroke="#333" stroke-width=".4">Stroked words</text>',
    "outlined": '<text x="9" y="30" fill="none" stroke="#333" stroke-width=".4">Outlined words</text>',
    "turned": '<text transform="rotate(9) scale(1.2 .8)" x="9" y="30">Rotated words</text>',
    "accents": '<text x="9" y="30">Größe naïve Ελληνικά</text>',
}
WORDS = {
    "plain": "Plain words",
    "ligatures": "Office of efficient fluff",
    "styles": "An old one",
    "spaced": "Words apart",
    "gradient": "Gradient words",
    "clipped": "Clipped words",
    "stroked": "Stroked words",
    "outlined": "Outlined words",
    "turned": "Rotated words",
    "accents": "Größe naïve Ελληνικά",
}


def pdf(body, folder, *, outlines=False):
    """A PDF file of what is in an SVG."""
    document = read_svg(f"{HEAD}{body}</svg>".encode()).document
    path = folder / f"{outlines}.pdf"
    path.write_bytes(pdf_file(document, Options(unit="mm", own={TEXT_AS_OUTLINES.name: outlines})).data)
    return path


def words(path):
    """What poppler finds written."""
    found = subprocess.run(["pdftotext", "-raw", path, "-"], check=True, timeout=60, capture_output=True)
    return " ".join(found.stdout.decode().split())


def ink(path):
    """How dark poppler's picture of a page is, at 300 dpi."""
    subprocess.run(
        ["pdftoppm", "-r", "300", "-gray", "-png", path, path.with_suffix("")], check=True, timeout=60
    )
    (picture,) = path.parent.glob(f"{path.stem}-*.png")
    image = QImage(str(picture)).convertToFormat(QImage.Format.Format_Grayscale8)
    rows = np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), image.bytesPerLine())
    return 255.0 - rows[:, : image.width()].astype(float)


@pytest.mark.parametrize("name", TEXTS)
def test_words_are_found_in_a_pdf_and_it_looks_as_one_of_outlines(name, tmp_path):
    """They were outlines alone: none was found."""
    written, drawn = pdf(TEXTS[name], tmp_path), pdf(TEXTS[name], tmp_path, outlines=True)
    assert (words(written), words(drawn)) == (WORDS[name], "")
    one, other = ink(written), ink(drawn)
    assert one.shape == other.shape
    assert other.max() > 50
    # Glyphs have edges of their own: nothing is darker by half than all that is beside it in the other.
    for here, there in ((one, other), (other, one)):
        spread = np.max([np.roll(there, (dx, dy), (0, 1)) for dx in (-1, 0, 1) for dy in (-1, 0, 1)], axis=0)
        assert (here - spread).max() < 128
    assert one.sum() == pytest.approx(other.sum(), rel=0.03)


def test_words_along_a_course_are_found_and_no_font_is_in_a_pdf_of_outlines(tmp_path):
    body = '<text><textPath xlink:href="#p">Along a course</textPath></text>'
    letters = words(pdf(body, tmp_path)).replace(" ", "")
    assert letters == "Alongacourse"
    assert b"/FontFile2" not in pdf(body, tmp_path, outlines=True).read_bytes()


def test_a_slant_that_the_font_has_not_stays_as_it_is_seen(tmp_path):
    """A PDF of Qt's has letters slanted otherwise than its outlines."""
    body = (
        '<text x="9" y="30" font-family="Z003, DejaVu Math TeX Gyre" font-style="italic">Slanted words</text>'
    )
    written, drawn = pdf(body, tmp_path), pdf(body, tmp_path, outlines=True)
    assert words(written) == "Slanted words"
    assert np.abs(ink(written) - ink(drawn)).mean() < 1.0
