"""Help: the manual, all keys and gestures, and the version.

To add a page to the manual: write `resources/manual/NN_name.md`. Its first line is its title, text in
*italics* quotes the window (tests look for every action, menu and key), and a link names the file of another
page.

- ``commands``: the Help menu.  ``manual``: the window of the manual.
- ``shortcut_sheet``: all keys and gestures on one sheet over the window.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
