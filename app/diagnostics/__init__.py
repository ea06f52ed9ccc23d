"""Diagnostics: the log and reports of crashes.

- ``log``: the log's levels, and its last lines.  ``log_file``: the log as a rotating file.
- ``slow_frames``: frames that took long.
- ``crash_handler``: exceptions that nobody caught.  ``crash_report``: what is told about one.
  ``crash_dialog``: that, on the screen.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
