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

The first line of the docstring is the tooltip. The section (``menus``) decides the menu; `@also` adds
places in bars. `needs=` is a `Need`: words and a predicate of the `ActionState`; a fact that no field has
yet is a new field there and a line in `ActionFacts.read`. `checked=` makes a switch, and `@switch("field",
…)` one that turns a field of `WindowState` on and off. `when_opened=` asks the session when the menu opens,
for what costs too much to ask at each step. `keywords=` are further words for the command palette. A key
that another action has, or the canvas (`RESERVED` in ``keymap``), is an error at the start.
`action_for_each` declares one action for each record of a registry. ``tests/gui/test_declared_actions.py``
has one of each.
'''
