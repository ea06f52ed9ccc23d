"""Choose what looks the same as what is chosen, and what is not chosen in place of what is."""

from __future__ import annotations

from ...actions.declaration import Action, action, action_for_each, also
from ...actions.needs import CHOSEN, SOME_CURVE
from ...actions.sections import EDIT_SAME, EDIT_SELECT
from ...actions.strips import CANVAS_MENU
from ...document.point_group import some_points
from ...document.same_looks import SAME_LOOKS, SameLook, curves_alike
from ...document.selection import NONE_FREE, free_curves
from ...document.several_curves import counted
from ...document.shapes import whole_shapes
from ...workbench.context import WindowContext


class ChoosingCommands:
    """Selections that follow from the one there is; of curves, those that are seen and not locked."""

    def __init__(self, context: WindowContext) -> None:
        self._session = context.session

    @action(
        "invertSelection",
        "Invert Selection",
        EDIT_SELECT,
        "!",
        "select-inverse",
        needs=SOME_CURVE,
        keywords="opposite others rest unselected",
    )
    @also(CANVAS_MENU(14))
    def _invert(self) -> None:
        """Choose what is seen and free and not chosen now; of curves that are edited, the other points."""
        session, selected = self._session, self._session.selected
        curves = session.document.curves
        if selected.is_editing:
            selected.set_group(
                some_points(
                    (at, frozenset(range(len(curves[at].points))) - selected.group.of(at))
                    for at in selected.edited
                )
            )
        elif free := free_curves(session.document):
            selected.choose(free - selected.chosen)
        else:
            session.refuse(NONE_FREE)

    @action_for_each(
        SAME_LOOKS,
        lambda each: Action(
            f"selectSame{each.name[0].upper()}{each.name[1:]}",
            each.title,
            EDIT_SAME,
            icon=f"select-same-{each.name.lower()}",
            tip=f"Choose all that is seen and free and has the same {each.tip}",
            full_name=f"Select All with the Same {each.title}",
            needs=CHOSEN,
            keywords="similar alike colour color style matching",
        ),
    )
    def _choose_same(self, look: SameLook) -> None:
        session, document = self._session, self._session.document
        alike = curves_alike(document, session.selected.marked, look)
        free = whole_shapes(document, alike & free_curves(document))
        if not free:
            session.refuse(f"All with {look.words} is hidden or locked; the list shows and unlocks it.")
            return
        session.selected.choose(free)
        left = "" if alike <= free else "; what is hidden or locked is not"
        session.say(f"{counted(document, free)} with {look.words} chosen{left}.")


COMMAND_SETS = (ChoosingCommands,)
