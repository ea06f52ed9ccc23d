"""Shapes combined by the areas they cover: union, difference, intersection, exclusion, division."""

from __future__ import annotations

from functools import partial

from ...actions.declaration import Action, action, action_for_each, also_for_each
from ...actions.needs import Need
from ...actions.sections import CURVE_OFFSETS, CURVE_PATHS
from ...actions.strips import CURVE_LIST_MENU, CURVE_MENU, OBJECT_BAR
from ...view_model.shapes.cutting import cut_apart
from ...view_model.shapes.regions import (
    PATH_OPERATIONS,
    PathOperation,
    combined_by,
)
from ...view_model.shapes.stroke_shapes import strokes_as_shapes
from ...workbench.context import WindowContext
from .chosen_shapes import A_SHAPE, SEVERAL_SHAPES
from .shape_work import ShapeWork

_IN_BAR = 4
"""The first of the operations have a button in the toolbar, for which a window of 1280 pixels has room."""

_SHOWN_PX = 2.0
"""Pixels of a line whose width follows the zoom."""


def _enough(operation: PathOperation) -> Need:
    return A_SHAPE if operation.least < 2 else SEVERAL_SHAPES


class PathCommands:
    """Boolean operations on the chosen shapes."""

    def __init__(self, context: WindowContext) -> None:
        self._session, self._canvas = context.session, context.central.canvas
        self._work = ShapeWork(context)

    @action_for_each(
        PATH_OPERATIONS,
        lambda operation: Action(
            operation.name,
            operation.title,
            CURVE_PATHS,
            operation.key,
            operation.icon,
            tip=operation.tip,
            full_name=f"{operation.title} of Shapes",
            drawing_key=operation.drawing_key,
            needs=_enough(operation),
            keywords=operation.keywords,
        ),
    )
    @also_for_each(
        lambda operation: (
            *(CURVE_MENU(44), CURVE_LIST_MENU(55)),
            *(OBJECT_BAR(10),) * (operation in PATH_OPERATIONS[:_IN_BAR]),
        )
    )
    def _combine(self, operation: PathOperation) -> None:
        self._work.compute(operation.title, partial(combined_by, operation))

    @action(
        "cutPath",
        "Cut Path",
        CURVE_PATHS,
        "Ctrl+Alt+/",
        "path-cut",
        needs=SEVERAL_SHAPES,
        keywords="knife scissors split slice boolean open line",
    )
    def _cut(self) -> None:
        """Cut the line of the hindmost path into parts where those in front cross it; these go."""
        self._work.compute("Cut path", cut_apart)

    @action(
        "strokeToPath",
        "Stroke to Path",
        CURVE_OFFSETS,
        "Ctrl+Shift+O",
        "stroke-to-path",
        full_name="Strokes to Paths",
        drawing_key="Ctrl+Alt+C, Ctrl+Shift+O",
        needs=A_SHAPE,
        keywords="outline stroke expand line to shape object",
    )
    def _outline_strokes(self) -> None:
        """Make shapes of the lines of the chosen shapes, with their corners, ends and dashes."""
        page = self._session.document.page
        # What a page shows prints so; else as it is seen now.
        usual = page.usual_width if page is not None else _SHOWN_PX * self._canvas.camera.pixel_size
        self._work.compute("Stroke to path", partial(strokes_as_shapes, usual=usual))
