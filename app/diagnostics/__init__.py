"""Diagnostics: the log and reports of crashes.

- ``log``: the log's levels, and its last lines.  ``log_file``: the log as a rotating file.
- ``slow_frames``: frames that took long.
- ``crash_handler``: exceptions that nobody caught.  ``crash_report``: what is told about one.
"""
