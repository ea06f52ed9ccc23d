"""Texts: words are typed on the canvas; in sketches the outlines of their letters become shapes.

- ``commands``: the preview and the step of the history.  ``field``: what is asked beside the text;
  ``font_box``: its fonts, ``fonts_before``: those offered first.  ``first_size``: that of the first one.
  ``words_edit``: the letters, each with its look; ``words_on_page``: keys, clicks and the caret where they
  are drawn; ``caret``: where it stands in what is typed.  ``remarks``: what is said of that.
- ``letter_paint``: colours for them.  ``letter_button``: their looks.  ``raised``: above and below the line.
  ``weight_box``: weights that their font has.  ``size_box``: their size.
- ``setting_row``: alignment, and spaces between letters and lines.
- ``type_commands``, ``type_bar``: font and size of all texts that are chosen.
- ``replace_commands``, ``replace_bar``, ``replacing``: words of texts replaced by others.
- ``outline_commands``, ``outlined``: texts of opened drawings made into outlines.
- ``along_commands``, ``along``: texts of drawings put on paths, and taken off.
- ``wording``: texts of drawings, which stay texts, written and edited.  ``flowing``, ``flow_commands``:
  those whose words fill a frame.
- ``letters``: outlines as curves of the document.  ``rewriting``: those of a text that is edited again.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
