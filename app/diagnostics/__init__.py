"""Diagnostics: the log and reports of crashes.

- ``log``: the log's levels, and its last lines.  ``log_file``: the log as a rotating file.
- ``slow_frames``: frames that took long.
- ``crash_handler``: exceptions that nobody caught.  ``crash_report``: what is told about one.
"""

from typing import TYPE_CHECKING

from app.lazy import lazy_submodules

if TYPE_CHECKING:
    from app.diagnostics import log_file as log_file
else:
    __getattr__ = lazy_submodules(__name__)
