"""Actions: declared on their handlers, read by menus, toolbar, palette, keys and tests.

- ``declaration``: the decorators `action` and `action_for_each`, and what they say of an action.
- ``sections``: the menus, and the sections in which actions stand.
- ``action_bars``: where else they stand: toolbar, context menus, buttons.
- ``state``: the facts that actions are enabled, checked and named by.
- ``needs``: what must be there before an action can be used, in words and as a predicate of these facts.
- ``derived``: values of these predicates, computed again only where a fact that they read has changed.
- ``keymap``: which keys do what.
  ``mnemonics``: the letters of menus.  ``clipboard_watch``: the clipboard.
- ``key_gate``: keys that can be refused while their buttons act.
- ``qactions``: the QActions of a window, made from the declarations.
"""
