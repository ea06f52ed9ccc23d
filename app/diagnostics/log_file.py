"""Log as a rotating file."""

from __future__ import annotations

import logging
from contextlib import suppress
from logging.handlers import RotatingFileHandler
from pathlib import Path

from .log import FORMAT, NAME, last_lines

FILE_NAME = "log.txt"

_BYTES = 256 * 2**10
_OLDER_FILES = 3


class LogFile(RotatingFileHandler):
    """Log handler that writes the last lines, and all further ones until it is closed, to a file in a folder.

    Raises OSError if the file cannot be opened; later errors of the disk are ignored.
    """

    def __init__(self, folder: Path) -> None:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        super().__init__(folder / FILE_NAME, maxBytes=_BYTES, backupCount=_OLDER_FILES, encoding="utf-8")
        self.setFormatter(FORMAT)
        if self.stream is not None:
            with suppress(OSError):
                self.stream.writelines(f"{line}\n" for line in last_lines())
        logging.getLogger(NAME).addHandler(self)

    def handleError(self, record: logging.LogRecord) -> None:  # noqa: N802
        """Ignore an error of writing; called by logging."""

    def close(self) -> None:
        """Stop logging to the file, and close it."""
        logging.getLogger(NAME).removeHandler(self)
        with suppress(OSError):
            super().close()
