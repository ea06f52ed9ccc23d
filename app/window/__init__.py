"""The window: builds, docks and connects its parts; and the actions on the program itself.

- ``main_window``: the window with its layout.  ``connect``: its command sets, and rendering of the session.
- ``menus``, ``toolbar``: actions on the screen.  ``messages``: the line on the canvas.
- ``drops``: files that are dragged over the window.  ``given_files``: files by their use.
- ``window_commands``: command palette, preferences, keys and keyboard focus.
- ``command_palette``, ``fuzzy``: search for an action.  ``preferences_dialog``: settings and shortcuts.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
