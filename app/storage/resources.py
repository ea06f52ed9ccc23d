"""The one place that knows where the files of ``resources/`` lie."""

from __future__ import annotations

from pathlib import Path

_PACKAGE = Path(__file__).resolve().parent.parent
_PLACES = (_PACKAGE / "resources", _PACKAGE.parent / "resources")


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
        When the installation lacks it; the message names what was looked for and where.
    """
    for place in _PLACES:
        path = place.joinpath(*parts)
        if path.exists():
            return path
    wanted = "/".join(("resources", *parts))
    places = " and ".join(str(place) for place in _PLACES)
    raise FileNotFoundError(f"{wanted} is missing from this installation (looked in {places})")


def has_resource(*parts: str) -> bool:
    """Whether there is a file or folder that ships with the program, named as for `resource`."""
    return any(place.joinpath(*parts).exists() for place in _PLACES)


def is_resource(path: Path) -> bool:
    """Whether `path` leads to a file that ships with the program; a link to one counts."""
    try:
        real = path.resolve()
    except (OSError, RuntimeError, ValueError):  # a link that leads back to itself, a name that cannot be
        return False
    return any(real.is_relative_to(place) for place in _PLACES)
