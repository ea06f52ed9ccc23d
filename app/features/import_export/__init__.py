"""Import and export of other formats.

- ``commands``: what comes in.  ``import_series``: several files, one after the other.
  ``intake``: curves of one in the document.
- ``export_commands``: what goes out.  ``copy_commands``: pictures on the clipboard.
- ``export_dialog``, ``export_form``, ``export_fields``: a format and its options.
- ``import_drawing_dialog``, ``import_table_dialog``, ``table_preview``: the content of a file, shown before.
- ``work_dialog``: what the dialogs share.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
