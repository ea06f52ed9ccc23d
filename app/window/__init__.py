"""The window: builds, docks and connects; and what works on the program itself.

- ``main_window``: the window.  ``connect``: its command sets.  ``window_layout``: its place and size.
- ``rendering``: what it shows of a session.
- ``menus``, ``context_menus``, ``toolbar``: actions on the screen.
- ``messages``: what the line on the canvas says.
- ``drops``: files that are dragged over the window.  ``given``: files by what is done with them.
- ``program_commands``: command palette, preferences and shortcuts.  ``focus_commands``: from panel to panel.
  ``command_palette``, ``fuzzy``: type what you want.  ``shortcut_editor``: the keys.
  ``preferences_dialog``: the settings, read from their descriptors.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
