"""Saves in one child process after another, each killed one step later than the one before it.

A step is a call of the operating system that may change a file: `sys.setprofile` tells of each just before
it happens. Prints, as JSON, what each child left behind.

Usage: python kill_at_every_step.py FOLDER
"""

from __future__ import annotations

import gc
import json
import os
import signal
import sys
from collections.abc import Callable
from pathlib import Path

from app.document.model import Document, make_curve
from app.storage.files import TEMPORARY_PREFIX, remove_stale_files
from app.storage.format import encode
from app.storage.migration import MIGRATIONS
from app.storage.open_file import OpenFile

OLD, NEW = (Document((make_curve([(x, 0.0)] * 4),)) for x in (1.0, 2.0))
WRITTEN = encode(NEW)
SYSTEM = {"posix", "nt", "_io", "io", "fcntl"}
# To be killed before one of these leaves the same as before the next call.
ASKING = {"fspath", "_path_normpath", "lstat", "stat", "access", "getpid", "geteuid", "urandom"}


def be_killed_before(steps: int) -> Callable[[object, str, object], None]:
    """Return a profiler that kills this process before the step number `steps`, counted from 0."""
    left = steps

    def step(_frame: object, event: str, called: object) -> None:
        nonlocal left
        if event != "c_call" or called.__name__ in ASKING:
            return
        owner = type(getattr(called, "__self__", None)).__module__
        if owner in SYSTEM or getattr(called, "__module__", "") in SYSTEM:
            left -= 1
            if left < 0:
                os.kill(os.getpid(), signal.SIGKILL)

    return step


def save_until(path: Path, steps: int, *, while_opening: bool) -> None:
    """Open, save and close; be killed before the step number `steps`."""
    step = be_killed_before(steps)
    if while_opening:
        sys.setprofile(step)
    file = OpenFile.open(path).file
    sys.setprofile(step)
    OpenFile.saved(path, NEW, file)
    file.close()
    sys.setprofile(None)


def run(folder: Path, old: bytes, *, while_opening: bool) -> list[dict[str, object]]:
    """Return what is left after each number of steps, until a child comes to the end."""
    path = folder / "drawing.curve.json"
    results = []
    for steps in range(100_000):
        path.write_bytes(old)
        child = os.fork()
        if child == 0:
            save_until(path, steps, while_opening=while_opening)
            os._exit(0)
        _, status = os.waitpid(child, 0)
        content = path.read_bytes()
        temporary = [each.name for each in folder.glob(f"{TEMPORARY_PREFIX}*")]
        swept = remove_stale_files(folder, older_than=-1.0)
        others = sorted(each.name for each in folder.iterdir() if each != path)
        backups = [each for each in others if each.endswith(".bak")]
        results.append(
            {
                "killed": os.WIFSIGNALED(status),
                "holds": "old" if content == old else "new" if content == WRITTEN else "neither",
                "temporary": len(temporary),
                "swept": swept,
                "others": others,
                "whole_backups": all((folder / each).read_bytes() == old for each in backups),
            }
        )
        if os.WIFEXITED(status):
            assert os.WEXITSTATUS(status) == 0
            break
        # The lock stays: the next child has to see that its owner is dead.
        for each in backups:
            (folder / each).unlink()
    return results


if __name__ == "__main__":
    target = Path(sys.argv[1])
    # What is imported when it is first wanted, each child would import again, in steps of no interest.
    warm = target / "warm.curve.json"
    warm.write_bytes(encode(OLD))
    OpenFile.saved(warm, NEW, OpenFile.open(warm).file).close()
    warm.unlink()
    # Nor shall each copy what it looks through for garbage.
    gc.disable()
    gc.freeze()
    # What a killed process has written is there whether or not it is on the disk; this is a step as well.
    os.fsync = os.fstat
    MIGRATIONS[0] = lambda values: values
    older = encode(OLD).replace(b'"version": 4', b'"version": 0')
    results = {
        "present": run(target, encode(OLD), while_opening=True),
        "older": run(target, older, while_opening=False),
    }
    print(json.dumps(results))
