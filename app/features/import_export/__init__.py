"""Import and export of other formats.

- ``commands``: import.  ``import_series``: several files in turn, and their curves in the document.
  ``import_drawing_dialog``, ``import_table_dialog``: the content of a file, shown before.
- ``export_commands``: export, and pictures on the clipboard.  ``export_dialog``: a format and its options.
- ``work_dialog``: base and parts of the dialogs.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
