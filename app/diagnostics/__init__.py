"""Diagnostics: the log, slow frames, and reports of crashes.

- ``log``: levels of the log, and its last lines.  ``log_file``: the log as a rotating file.
- ``slow_frames``: frames that took long.
- ``crash_handler``: uncaught exceptions and the report about one.  ``crash_dialog``: the dialog with the
  report.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
