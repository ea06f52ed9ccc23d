"""A drag computes the document from the press: the same pointer gives the same document, in any order."""

from __future__ import annotations

import pytest
from msgspec.structs import replace

from app.document.model import Axis, Document, Guide, ReferenceImage, make_curve
from app.families import FAMILIES, HERMITE
from app.session import Session
from app.tools.box import Grip, TransformKind
from app.tools.canvas.add import ADD
from app.tools.canvas.box_curves import ELLIPSE, RECTANGLE
from app.tools.canvas.select import SELECT
from app.tools.guides import press_on_guide, press_on_ruler
from app.tools.parameters import RAIL
from app.tools.pointer import Hit, Part, Pointer
from app.tools.reference_image import MOVE_IMAGE
from app.tools.tool import CanvasQueries, Drag
from app.tools.toolbox import Toolbox
from app.tools.transform import press_on_grip, transform_by_key

POINTS = [(0.0, 0.0), (1.0, 2.0), (3.0, 2.0), (4.0, 0.0)]
AT = (1.0, 2.0)


def pointer(x, y, **held):
    return Pointer((x, y), (500 + 100 * x, 500 - 100 * y), scale=100.0, **held)


PLACES = (
    pointer(1.5, 2.25),
    pointer(1.5, 2.25, shift=True),
    pointer(2.5, 1.0, ctrl=True),
    pointer(0.5, 3.0, alt=True),
    pointer(-0.5, -1.0, shift=True, alt=True),
    pointer(2.5, 1.0),
)


class OneHit(CanvasQueries):
    """A plot with one thing on it."""

    def __init__(self, hit):
        self._hit = hit

    def hit(self, pointer, parts):
        return self._hit


def session_of(family):
    session = Session()
    image = ReferenceImage("image.png", 0.0, 0.0, 4.0, 2.0)
    curves = (make_curve(POINTS, family=family), make_curve([(0, -1), (2, -2), (4, -1)], name="Base"))
    document = Document(curves, guides=(Guide(Axis.X, 1.0),), image=image)
    session.files.replace(document, None)
    session.selected.set_points([0, 1, 2])
    return session


def pressed(session, record, hit, **held):
    """The gesture that a press of the tool on something begins."""
    tools = Toolbox(session, record)
    tools.canvas = OneHit(hit)
    event = replace(tools.event, pointer=pointer(*AT, **held))
    return tools.tool.press(event.with_hit())


def made(session, make):
    return make(replace(Toolbox(session, SELECT).event, pointer=pointer(*AT)))


CURVE = Hit(Part.CURVE, 1, AT, t=0.4)
POINT = Hit(Part.POINT, 1, AT)
CORNER = Hit(Part.IMAGE_CORNER, 0, AT, knot=2)
HANDLE = Hit(Part.HANDLE, 1, (1.25, 2.0), order=1)
DRAGS = {
    "points": lambda session: pressed(session, SELECT, POINT),
    "handle": lambda session: pressed(session, SELECT, HANDLE),
    "velocity": lambda session: pressed(session, SELECT, POINT, alt=True),
    "bend": lambda session: pressed(session, SELECT, CURVE),
    "curve": lambda session: pressed(session, SELECT, Hit(Part.OTHER_CURVE, 1, AT)),
    "guide": lambda session: made(session, lambda event: press_on_guide(event, 0)),
    "new guide": lambda session: made(session, lambda event: press_on_ruler(event, Axis.Y)),
    "scaling grip": lambda session: made(session, lambda event: press_on_grip(event, Grip(1, 0))),
    "turning grip": lambda session: made(
        session, lambda event: press_on_grip(event, Grip(1, 1, TransformKind.ROTATE))
    ),
    **{
        kind.name.lower(): lambda session, kind=kind: made(
            session, lambda event: transform_by_key(event, kind)
        )
        for kind in TransformKind
    },
    "new point": lambda session: pressed(session, ADD, None),
    "inserted point": lambda session: pressed(session, ADD, CURVE),
    "rectangle": lambda session: pressed(session, RECTANGLE, None),
    "ellipse": lambda session: pressed(session, ELLIPSE, None),
    "image": lambda session: pressed(session, MOVE_IMAGE, Hit(Part.IMAGE, 0, AT)),
    "corner of the image": lambda session: pressed(
        session, MOVE_IMAGE, Hit(Part.IMAGE_CORNER, 0, AT, knot=2)
    ),
    "tick": lambda session: pressed(session, RAIL, Hit(Part.TICK, 1, (0.3, 0.0), knot=1)),
}


@pytest.mark.parametrize("family", [HERMITE, FAMILIES[0]], ids=["hermite", "first"])
@pytest.mark.parametrize("name", DRAGS)
def test_a_drag_gives_the_same_document_for_the_same_pointer_in_any_order(name, family):
    if name in ("handle", "velocity") and not family.derivatives:
        pytest.skip("a family without handles")
    session = session_of(family)
    drag = DRAGS[name](session)
    assert isinstance(drag, Drag)
    before = session.document
    first = [(drag.document_at(at), drag.undo_text(at)) for at in PLACES]
    again = [(drag.document_at(at), drag.undo_text(at)) for at in reversed(PLACES)]
    assert first == again[::-1]
    assert any(document != before for document, _ in first)
    assert session.document is before
