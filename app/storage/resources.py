"""Files and folders in ``resources/``, which ship with the program."""

from __future__ import annotations

from pathlib import Path

_PACKAGE = Path(__file__).resolve().parent.parent
_FOLDERS = (_PACKAGE / "resources", _PACKAGE.parent / "resources")


def resource(*parts: str) -> Path:
    """
    Find a file or folder that ships with the program.

    An installed wheel carries the resources inside the package, a checkout beside it.

    Parameters
    ----------
    *parts : str
        Path below ``resources``, one name per argument: ``resource("icons", "open.svg")``.
        No argument gives the folder itself.

    Returns
    -------
    pathlib.Path
        An existing path.

    Raises
    ------
    FileNotFoundError
        If the installation lacks it; the message names the file and the folders.
    """
    for folder in _FOLDERS:
        path = folder.joinpath(*parts)
        if path.exists():
            return path
    wanted = "/".join(("resources", *parts))
    folders = " and ".join(str(folder) for folder in _FOLDERS)
    raise FileNotFoundError(f"{wanted} is missing from this installation (looked in {folders})")


def has_resource(*parts: str) -> bool:
    """Return whether a file or folder exists in ``resources``; the arguments are those of `resource`."""
    return any(folder.joinpath(*parts).exists() for folder in _FOLDERS)


def is_resource(path: Path) -> bool:
    """Return whether `path` leads to a file that ships with the program, also through a link."""
    try:
        real = path.resolve()
    except (OSError, RuntimeError, ValueError):  # a link to itself, or an impossible name
        return False
    return any(real.is_relative_to(folder) for folder in _FOLDERS)
