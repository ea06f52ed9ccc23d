"""Text as curves: words are typed on the canvas, and the outlines of their letters become shapes.

- ``commands``: the field, the preview and the step of the history.  ``field``: what is typed into;
  ``words_edit``: its letters, each with its look.  ``letter_paint``: colours for them.
- ``setting_row``: alignment, and spaces between letters and lines.
- ``outline_commands``, ``outlined``: texts of opened drawings made into outlines.
- ``wording``: texts of drawings, which stay texts, written and edited.
- ``letters``: outlines as curves of the document.  ``rewriting``: those of a text that is edited again.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
