'''Actions: declared on their handlers, read by menus, toolbar, palette, keys and tests.

- ``declaration``: the decorators `action`, `switch` and `action_for_each`, and the record `Action`.
- ``menus``: the menus with their sections, and the bars (toolbar, context menus, rows of buttons).
- ``state``: the facts by which actions are enabled, checked and named, as one value.
- ``needs``: conditions of actions, as words and as a predicate of these facts.
- ``keymap``: the keys of all actions, and the mnemonics of menus.
- ``qactions``: the QActions of a window, made from the declarations.

To add an action: decorate a method of a command set in the feature that the action belongs to::

    @action("newSeed", "New Seed", OVERLAYS_ERRORS, icon="seed", needs=CURVE_THROUGH_TWO)
    def _new_seed(self) -> None:
        """Draw new random errors."""

The first line of the docstring is the tooltip. The section (``menus``) decides the menu; in it,
actions stand in the order of `FEATURES`, of the command sets of a feature, and of the methods. `@also` adds
places in bars. `needs=` is a `Need`: words and a predicate of the `ActionState`; a fact that no field has
yet is a new field there and a line in `ActionFacts.read`. `checked=` makes a switch, and `@switch("field",
…)` one that turns a field of `WindowState` on and off. `when_opened=` asks the session when the menu opens,
for what costs too much to ask at each step. `keywords=` are further words for the command palette. A key
that another action has, or the canvas (`RESERVED` in ``keymap``), is an error at the start, which says
whose it is; F1 (Help ▸ Keys and Mouse) shows the keys in use.
`action_for_each` declares one action for each record of a registry. ``tests/gui/test_declared_actions.py``
has one of each; to test what an action does, copy ``tests/gui/test_invert_selection.py``.

An action changes the document by `session.change(text, edit)`. One that selects makes no step of the history:
it calls `session.selected.set_group(group)` with points of any edited curves, or `select_whole(curves)`, and
not `session.change`. It stands in ``features/points/commands``; which points it selects is computed by a pure
function in ``document/selection``, such as `all_points`.
'''
