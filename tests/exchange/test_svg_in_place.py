"""SVG files of other programs with changes in them: what was not touched stays as it was, to the byte."""

import difflib
from pathlib import Path

import numpy as np
import pytest
from msgspec.structs import astuple, replace

from app.document.empty_layer import EmptyLayer
from app.document.form_edits import formed_anew
from app.document.forms import Rectangle
from app.document.gradient import Gradient, Stop
from app.document.model import Axis, Guide, Page, make_curve
from app.document.several_curves import stepped, whole_curves
from app.document.shapes import tidy_shapes, whole_shapes
from app.document.transforms import rotation, transform_points
from app.exchange.drawing.drawing import drawing_of
from app.exchange.formats.pictures import read
from app.exchange.options import DEFAULT, Options
from app.exchange.rescaled import in_unit
from app.exchange.svg.in_place.rewriting import rewritten
from app.exchange.svg.in_place.source import Source
from app.exchange.svg.writer import svg_of
from app.exchange.writing import with_changes
from app.tasks.progress import silent
from app.view_model.geometry.extents import extent_of
from app.view_model.shapes.formed import formed, with_form

DATA = Path(__file__).parents[1] / "data"
BADGE = (DATA / "overwrite" / "badge.svg").read_bytes()
FILES = sorted((DATA / "svg").glob("*.svg"))
LINE = replace(make_curve([(5, 5), (35, 35)], name="Line"))
SHADE = Gradient((Stop(0.0, "#ff0000"), Stop(1.0, "#00ff00")), start=(20, 30), end=(40, 30), side=(20, 50))


@pytest.fixture(scope="module")
def badge():
    """A file of Inkscape with layers, a clip path, a filter, text, a gradient, guides and a clone."""
    return read(BADGE, None).document


def differences(old, new):
    """The lines that go, and those that come, without the blanks around them."""
    lines = difflib.unified_diff(old.decode().splitlines(), new.decode().splitlines(), n=0, lineterm="")
    return [
        f"{line[0]}{line[1:].strip()}" for line in lines if line[:3] not in ("---", "+++") and line[0] in "+-"
    ]


def kept(data, document, begun=None):
    """The file with the changes, which is the document again, and written once more stays as it is."""
    written = rewritten(data, document, begun)
    assert written is not None
    back = read(written.data, None).document
    assert [curve.groups for curve in back.curves] == [curve.groups for curve in document.curves]
    looks = [[(curve.visible, curve.locked) for curve in each.curves] for each in (back, document)]
    assert looks[0] == looks[1]
    assert extents(back) == pytest.approx(extents(document), abs=1e-6 * np.abs(extents(document)).max())
    assert rewritten(written.data, document, document).data == written.data
    return written.data


def extents(document):
    shapes = drawing_of(document, with_hidden=True).all_shapes
    return np.array([extent_of(outline.control_points) for shape in shapes for outline in shape])


def moved(document, places, by):
    free = replace(document, curves=tuple(replace(curve, locked=False) for curve in document.curves))
    new = stepped(free, whole_curves(free, places), by).curves
    locks = [curve.locked for curve in document.curves]
    return replace(
        document, curves=tuple(replace(curve, locked=lock) for curve, lock in zip(new, locks, strict=True))
    )


def changed(document, place, **fields):
    """The document with other values of a curve; of its style where it has no such field."""
    curve = document.curves[place]
    own = {name: value for name, value in fields.items() if hasattr(curve, name)}
    style = curve.style.with_fields({name: value for name, value in fields.items() if name not in own})
    return tidy_shapes(document.with_curve(place, replace(curve, style=style, **own)))


def with_curves(document, curves, **fields):
    return tidy_shapes(replace(document, curves=tuple(curves), **fields))


RECT, WORDS, ELLIPSE, WAVE, CLIPPED, P1, P2, CLONE, HIDDEN = range(9)

EDITS = {
    "a path is moved": (
        lambda d: moved(d, [WAVE], (5, 2.5)),
        [
            '-d="m 20,60 c 5,-10 15,-10 20,0"',
            '+d="M 25 57.5 C 30 47.5 40 47.5 45 57.5"',
        ],
    ),
    "a rect with a gradient is moved": (
        lambda d: moved(d, [RECT], (5, 2.5)),
        ['-y="10" />', '+y="10"', '+transform="translate(5,-2.5)" />'],
    ),
    "what is clipped is moved": (
        lambda d: moved(d, [CLIPPED], (5, 2.5)),
        ['-clip-path="url(#clip1)" />', '+clip-path="url(#clip1)"', '+transform="translate(5,-2.5)" />'],
    ),
    "a turned ellipse is moved": (
        lambda d: moved(d, [ELLIPSE], (5, 2.5)),
        ['-cx="60"', '-cy="50"', '+cx="64.48991832"', '+cy="46.66973973"'],
    ),
    "a group is moved": (
        lambda d: moved(d, [P1, P2], (3, 4)),
        ['-inkscape:label="Pair">', '+inkscape:label="Pair"', '+transform="translate(3,-4)">'],
    ),
    "a clone is moved": (lambda d: moved(d, [CLONE], (3, 4)), ['-x="0"', '-y="0"', '+x="3"', '+y="-4"']),
    "a rect gets a colour": (
        lambda d: changed(d, RECT, fill="#112233"),
        [
            '-style="fill:url(#lg2);stroke:#000000;stroke-width:0.5"',
            '+style="fill:#112233;stroke:#000000;stroke-width:0.5"',
        ],
    ),
    "a line gets dashes": (
        lambda d: changed(d, WAVE, width=2.0, dash=(2.0, 1.0)),
        [
            '-style="fill:none;stroke:#ff8800;stroke-width:1;stroke-linecap:round"',
            '+style="fill:none;stroke:#ff8800;stroke-width:2;stroke-linecap:round;stroke-dasharray:4,2"',
        ],
    ),
    "an ellipse gets a gradient": (
        lambda d: d.with_curve(
            WAVE, replace(d.curves[WAVE], style=d.curves[WAVE].style.with_gradient("fill", SHADE))
        ),
        [
            '+<linearGradient id="gradient" gradientUnits="userSpaceOnUse" x1="18" y1="47" x2="38" y2="47">',
            '+<stop offset="0" stop-color="#ff0000"/>',
            '+<stop offset="1" stop-color="#00ff00"/>',
            "+</linearGradient>",
            '-style="fill:none;stroke:#ff8800;stroke-width:1;stroke-linecap:round"',
            '+style="fill:url(#gradient);stroke:#ff8800;stroke-width:1;stroke-linecap:round"',
        ],
    ),
    "a path is hidden": (
        lambda d: changed(d, WAVE, visible=False),
        [
            '-style="fill:none;stroke:#ff8800;stroke-width:1;stroke-linecap:round"',
            '+style="fill:none;stroke:#ff8800;stroke-width:1;stroke-linecap:round;display:none"',
        ],
    ),
    "a hidden layer is shown": (
        lambda d: changed(d, HIDDEN, visible=True),
        ['-style="display:none">', '+style="display:inline">'],
    ),
    "a locked layer is unlocked": (
        lambda d: changed(changed(d, RECT, locked=False), WORDS, locked=False),
        ['-id="layer1"', '-sodipodi:insensitive="true">', '+id="layer1">'],
    ),
    "a path is renamed": (
        lambda d: changed(d, WAVE, name="Wave & <x>"),
        [
            '-sodipodi:nodetypes="cc" />',
            '+sodipodi:nodetypes="cc"',
            '+inkscape:label="Wave &amp; &lt;x&gt;" />',
        ],
    ),
    "a layer is renamed": (
        lambda d: with_curves(
            d,
            [replace(c, groups=tuple("Top" if g == "Front" else g for g in c.groups)) for c in d.curves],
            layers=tuple("Top" if each == "Front" else each for each in d.layers),
        ),
        ['-inkscape:label="Front"', '+inkscape:label="Top"'],
    ),
    "what a clone is of is deleted": (
        lambda d: with_curves(d, [each for each in d.curves if each is not d.curves[P2]]),
        [
            *("+<path", '+d="M 11,5 H 15 V 9 H 11 Z"', '+id="p2"', '+style="fill:#654321" />'),
            *("-<path", '-d="M 11,5 H 15 V 9 H 11 Z"', '-id="p2"', '-style="fill:#654321" />'),
        ],
    ),
    "a path is drawn in a layer of its own": (
        lambda d: with_curves(d, [*d.curves, replace(LINE, groups=("New",))], layers=(*d.layers, "New")),
        [
            '+<g id="New" inkscape:groupmode="layer" inkscape:label="New">',
            '+<path id="Line" d="M 5 75 L 20 60 L 35 45" fill="none" stroke="#1f2328" stroke-width="0.3" '
            'stroke-linecap="round" stroke-linejoin="round"/>',
            "+</g>",
        ],
    ),
    "a layer without a curve is hidden": (
        lambda d: replace(d, empty_layers=tuple(replace(each, visible=False) for each in d.empty_layers)),
        ['-id="layer2" />', '+id="layer2"', '+style="display:none" />'],
    ),
    "a layer without a curve goes": (
        lambda d: replace(d, layers=tuple(each for each in d.layers if each != "Empty"), empty_layers=()),
        ['-inkscape:label="Empty"', '-inkscape:groupmode="layer"', '-id="layer2" />', "-<g"],
    ),
    "a layer without a curve is made": (
        lambda d: replace(
            d, layers=(*d.layers, "New"), empty_layers=(*d.empty_layers, EmptyLayer("New", locked=True))
        ),
        ['+<g id="New" inkscape:groupmode="layer" inkscape:label="New" sodipodi:insensitive="true"/>'],
    ),
    "two are grouped": (
        lambda d: changed(changed(d, ELLIPSE, groups=("Front", "Two")), WAVE, groups=("Front", "Two")),
        ["-<ellipse", '+<g id="Two" inkscape:label="Two">', "+<ellipse", "-<path", "+<path", "+</g>"],
    ),
    "a group is dissolved": (
        lambda d: changed(changed(d, P1, groups=("Front",)), P2, groups=("Front",)),
        ["-<g", '-id="grp"', '-inkscape:label="Pair">', "-<path", "+<path", "-<path", "+<path", "-</g>"],
    ),
    "guides are others": (
        lambda d: replace(d, guides=(*d.guides[1:], Guide(Axis.Y, 12.5))),
        [
            *('-position="20,40"', '-orientation="1,0"', '-id="guide1"', '-inkscape:locked="false" />'),
            *("-<sodipodi:guide", '+<sodipodi:guide position="0,12.5" orientation="0,1"/>'),
        ],
    ),
    "a guide is moved and turned": (
        lambda d: replace(d, guides=(Guide(Axis.X, 25.0, 30.0, 10.0), *d.guides[1:])),
        [
            *('-position="20,40"', '-orientation="1,0"'),
            *('+position="25,10"', '+orientation="-0.8660254037844387,-0.5"'),
        ],
    ),
    "a guide is locked": (
        lambda d: replace(d, guides=(replace(d.guides[0], locked=True), *d.guides[1:])),
        ['-inkscape:locked="false" />', '+inkscape:locked="true" />'],
    ),
    "the page is wider": (
        lambda d: replace(d, page=Page(0.0, 0.0, 120.0, 80.0)),
        ['-width="100mm"', '+width="120mm"', '-viewBox="0 0 100 80"', '+viewBox="0 0 120 80"'],
    ),
}


@pytest.mark.parametrize(("edit", "lines"), EDITS.values(), ids=EDITS)
def test_a_change_is_all_that_changes(badge, edit, lines):
    """Rects and ellipses became paths; texts, clip paths, filters, metadata and empty layers were gone."""
    assert differences(BADGE, kept(BADGE, edit(badge), badge)) == lines


def test_what_else_is_in_the_file_counts_by_its_format(badge):
    """DXF has nothing that could be kept so far."""
    assert with_changes(BADGE, "a.svg", badge, badge, silent).data == BADGE
    assert with_changes(BADGE, "a.dxf", badge, badge, silent) is None


def test_order_is_that_of_the_document(badge):
    """What lies between stays where it is: the empty layer."""
    places = [RECT, WORDS, WAVE, CLIPPED, P1, P2, CLONE, ELLIPSE, HIDDEN]
    raised = kept(BADGE, with_curves(badge, [badge.curves[each] for each in places]), badge)
    went, came = differences(BADGE, raised)[:8], differences(BADGE, raised)[8:]
    assert went == [f"-{line[1:]}" for line in came]
    assert "-<ellipse" in went
    layers = [HIDDEN, ELLIPSE, WAVE, CLIPPED, P1, P2, CLONE, RECT, WORDS]
    swapped = kept(BADGE, with_curves(badge, [badge.curves[each] for each in layers]), badge)
    assert sorted(swapped.splitlines()) == sorted(BADGE.splitlines())


def test_a_shape_in_another_layer_is_where_it_was(badge):
    """The layer that it comes to is moved, and nothing there is locked."""
    curves = list(badge.curves)
    curves.insert(WAVE + 1, replace(curves.pop(RECT), groups=("Front",)))
    found = kept(BADGE, with_curves(badge, curves), badge).decode()
    rect = found[found.index('id="rect1"') :].partition("/>")[0]
    assert found.index('inkscape:label="Front"') < found.index('id="rect1"')
    assert 'transform="translate(-2,-3)"' in rect
    assert 'sodipodi:insensitive="true"' in rect


def test_a_clone_stays_one_whose_original_goes_elsewhere(badge):
    """It became a path."""
    found = differences(BADGE, kept(BADGE, moved(badge, [P2], (5, 2.5)), badge))
    assert found[2:] == ['-x="0"', '-y="0"', '+x="-5"', '+y="2.5"']
    # Both moved: the file says so of the original alone.
    assert len(differences(BADGE, kept(BADGE, moved(badge, [P2, CLONE], (5, 2.5)), badge))) == 2
    turned = transform_points(badge, P2, range(4), rotation(30, (40.0, 40.0)))
    found = differences(BADGE, kept(BADGE, turned, badge))
    assert found[2] == '-transform="translate(10,0)"'
    assert found[3].startswith('+transform="matrix(0.866')


def test_a_clone_of_a_clone_stays_one(badge):
    end = b'</g>\n  <g\n     inkscape:label="Hid'
    data = BADGE.replace(end, b'<use xlink:href="#use1" id="use2" transform="translate(0,10)" />' + end)
    document = read(data, None).document
    for places in ([P2], [CLONE], [P2, CLONE]):
        assert kept(data, moved(document, places, (5, 2.5)), document).count(b"<use") == 2


@pytest.mark.parametrize(
    ("edit", "why"),
    [
        (lambda d: bent(d, P2), "its original was changed and it was not"),
        (lambda d: bent(d, CLONE), "its own points were moved"),
        (lambda d: changed(d, CLONE, fill="#112233"), "it looks otherwise than its original"),
        (lambda d: changed(d, P2, fill="#112233"), "its original was changed and it was not"),
    ],
)
def test_a_clone_that_cannot_stay_one_is_told(badge, edit, why):
    """The file was said to be exact, and that was all."""
    kept(BADGE, edit(badge), badge)
    written = rewritten(BADGE, edit(badge), badge)
    assert written.changes == (f"The clone “use1” became a path, because {why}.",)
    assert rewritten(BADGE, moved(badge, [CLONE], (3, 4)), badge).changes == ()


def bent(document, place):
    curve = document.curves[place]
    first, *others = curve.points
    return document.with_curve(place, replace(curve, points=(replace(first, x=first.x - 1.0), *others)))


def test_a_shape_that_is_bent_becomes_a_path_in_its_element(badge):
    rect = badge.curves[RECT]
    bent = replace(rect, points=(replace(rect.points[0], x=11.0), *rect.points[1:]))
    assert differences(BADGE, kept(BADGE, badge.with_curve(RECT, bent), badge)) == [
        "-<rect",
        "+<path",
        '-width="30"',
        '-height="20"',
        '-x="10"',
        '-y="10" />',
        '+d="M 11 10 C 21 10 30 10 40 10 L 40 30 L 10 30 '
        'C 10 23.333333333333332 11 16.666666666666668 11 10 Z" />',
    ]


def test_what_was_not_taken_in_is_left_alone(badge):
    """Of a file some groups may be taken; the others were lost when it was written back."""
    begun = with_curves(badge, [badge.curves[WAVE], badge.curves[P1]])
    document = moved(with_curves(badge, [badge.curves[P1]]), [0], (1, 0))
    found = rewritten(BADGE, document, begun).data
    assert [line for line in differences(BADGE, found) if "id=" in line] == ['-id="wave"']
    assert b'id="rect1"' in found


def test_a_document_in_another_unit_is_the_same_file(badge):
    assert kept_bytes(BADGE, in_unit(badge, "in"), badge) == BADGE


def kept_bytes(data, document, begun):
    return rewritten(data, document, begun).data


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_files_of_all_programs_are_kept(path):
    data = path.read_bytes()
    document = read(data, None).document
    assert kept_bytes(data, document, document) == data
    last = whole_shapes(document, [len(document.curves) - 1])
    turned = moved(document, last, (0.5, 0.25)).curves[::-1]
    for new in (
        moved(document, range(len(document.curves)), (1, 1)),
        with_curves(document, [*(replace(curve, groups=()) for curve in turned), LINE], layers=()),
    ):
        kept(data, new, document)


def test_the_source_is_the_same_to_the_byte():
    odd = (
        "<?xml version='1.0' encoding='latin-1'?>\r\n"
        '<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" "a>b">\r\n'
        '<!-- <g a="> -->\r\n'
        '<s:svg xmlns:s="http://www.w3.org/2000/svg" width="9"  height = \'9\' viewBox="0 0 9 9">'
        "<s:style><![CDATA[ g > path { fill: red } ]]></s:style><?php echo '<a>' ?>"
        '<s:text a="&quot;>&#228;">\xe4&lt; <s:tspan/></s:text>\r\n'
        '<s:path d="M1 1\n2 5" ></s:path>\r\n</s:svg>\r\n'
    ).encode("latin-1")
    assert Source(odd).data == odd
    document = read(odd, None).document
    found = kept(odd, replace(document, curves=(*moved(document, [1], (1, 0)).curves, LINE)), document)
    assert b'<s:path d="M 2 1 L 3 5" ></s:path>' in found
    assert found.count(b"<s:path ") == 2
    assert b"\xe4&lt; <s:tspan/>" in found


def test_a_picture_that_hangs_on_its_curves_is_written_anew(badge):
    """It has the size of its curves, or discs at their points."""
    for document, options in ((replace(badge, page=None), DEFAULT), (badge, Options(points=True))):
        data = svg_of(document, options).data
        assert rewritten(data, read(data, None).document) is None
    data = svg_of(badge).data
    document = read(data, None).document
    assert rewritten(data, document, document).data == data


FORMS = b"""<svg xmlns="http://www.w3.org/2000/svg" width="200" height="120" viewBox="0 0 200 120">
  <!-- Mine. -->
  <g transform="translate(10 0)">
    <rect id="box" x="10" y="20" width="60" height="30" rx="8" fill="#dd0000"/>
    <rect id="turned" x="90" y="20" width="60" height="30" transform="rotate(30 120 35)" fill="#00aa00"/>
  </g>
  <circle id="dot" cx="40" cy="90" r="20" fill="#0000dd"/>
</svg>
"""


def with_number(document, place, name, value):
    now = formed(document.curves[place])
    return with_form(document, place, now.form.with_number(name, value), now.by)


def test_a_rectangle_stays_one_with_another_radius_and_size():
    document = read(FORMS, None).document
    changed = with_number(with_number(document, 0, "rx", 12.0), 0, "width", 70.0)
    assert differences(FORMS, kept(FORMS, changed, document)) == [
        '-<rect id="box" x="10" y="20" width="60" height="30" rx="8" fill="#dd0000"/>',
        '+<rect id="box" x="10" y="20" width="70" height="30" rx="12" fill="#dd0000" ry="12"/>',
    ]
    sharp = kept(FORMS, with_number(document, 0, "rx", 0.0), document)
    assert b'<rect id="box" x="10" y="20" width="60" height="30" fill="#dd0000"/>' in sharp


def test_a_turned_rectangle_and_a_circle_stay_what_they_are():
    document = read(FORMS, None).document
    changed = with_number(with_number(document, 1, "height", 40.0), 2, "width", 60.0)
    written = kept(FORMS, changed, document)
    again = read(written, None).document
    for one, other in zip(again.curves, changed.curves, strict=True):
        assert type(one.form) is type(other.form)
        assert astuple(formed(one).form) == pytest.approx(astuple(formed(other).form))
    assert b'<ellipse id="dot" cx="40" cy="90" fill="#0000dd" rx="30" ry="20"/>' in written
    assert b'<rect id="turned" ' in written
    assert written.count(b"<path") == 0
    # A point of it elsewhere: it is a path.
    points = document.curves[0].points
    bent = replace(document.curves[0], points=(replace(points[0], x=0.0), *points[1:]))
    assert b'<path id="box" ' in kept(FORMS, document.with_curve(0, bent), document)


def test_a_new_rectangle_comes_in_as_one():
    document = read(FORMS, None).document
    new = formed_anew(replace(LINE, name="New"), Rectangle(20.0, 60.0, 30.0, 10.0, 2.0, 2.0))
    written = kept(FORMS, replace(document, curves=(*document.curves, new)), document)
    assert b'<rect id="New" x="20" y="50" width="30" height="10" rx="2" ry="2"' in written
