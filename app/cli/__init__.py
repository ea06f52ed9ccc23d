"""The command line: the editor, and commands that need no window.

- ``command_line``: what was typed, and which command it is.  ``refusals``: what cannot be done, in one line.
  ``documents``: those that it names.
- ``families``: those of files that were named.  ``commands``: which command it is; ``rendering``,
  ``converting``, ``printed_facts`` and ``lessons`` are what each takes.  ``options``: their options.
  ``progress``: how far work has come, on a terminal.
- ``start``: the editor's start.  ``windows``: its first windows.  ``application``: Qt's application.
  ``lifecycle``: what surrounds them until the end.  ``display``: whether there is a screen for them.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
