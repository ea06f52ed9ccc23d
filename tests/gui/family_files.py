"""Files of families that tests have in use, which all windows of the process share."""

from __future__ import annotations

from app.families import FAMILIES
from app.families.family_file import forget_file
from app.features.own_families.files import family_files
from app.features.own_families.trial import PATIENCE


def stop_following_files() -> None:
    """Stop using all files."""
    files = family_files()
    files._waiting.clear()
    if files._trial_task is not None:
        files._trial_task.close()
    for watch in files._watches.values():
        watch.watch(None)
        watch.deleteLater()
    if files._watches:
        PATIENCE.of_no_window()
    files._watches.clear()
    files._contents.clear()
    files.problems.clear()
    files.running, files.offered = "", None
    files.changed.emit()


def forget_family_files() -> None:
    """Have none in use, and nothing said of any: every later window would say so, too."""
    stop_following_files()
    for path in tuple(FAMILIES.files):
        forget_file(FAMILIES, path)
