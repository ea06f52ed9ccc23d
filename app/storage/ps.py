"""Start time of a process, as ``ps`` tells it: on systems without ``/proc``."""

from __future__ import annotations

import subprocess


def started(pid: int) -> str | None:
    """Return when process `pid` began; None if there is none, empty if the system does not say."""
    try:
        done = subprocess.run(["ps", "-o", "lstart=", "-p", str(pid)], capture_output=True, check=False)
    except OSError:
        return ""
    if done.stderr:
        return ""  # A ps that does not know what it was asked.
    return " ".join(done.stdout.decode("ascii", "replace").split()) or None
