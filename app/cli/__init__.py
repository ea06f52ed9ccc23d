"""The command line: the editor, and commands that need no window.

- ``command_line``: which command it is.  ``output``: results, refusals and progress.
  ``documents``, ``families``: documents and curve families in the files that it names.
- ``commands``: the parsers of the commands without a window.  ``options``: their options.
  ``rendering``, ``converting`` and ``info``: their work.
- ``start``: the editor's start.  ``lessons``: the same with a lesson.
  ``display``: whether there is a screen for it.  ``application``: Qt's application.
  ``windows``: the windows, and what surrounds them until the end.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
