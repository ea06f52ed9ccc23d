"""Start time of a process from ``ps``, on systems without ``/proc``."""

from __future__ import annotations

import subprocess


def started(pid: int) -> str | None:
    """Return the start time of process `pid`; None if there is no such process, empty if it is unknown."""
    try:
        done = subprocess.run(["ps", "-o", "lstart=", "-p", str(pid)], capture_output=True, check=False)
    except OSError:
        return ""
    if done.stderr:
        return ""  # This ps does not know the options.
    return " ".join(done.stdout.decode("ascii", "replace").split()) or None
