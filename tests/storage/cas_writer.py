"""Raises a number in a document again and again, beside others who do the same, and prints how often.

Usage: python cas_writer.py FILE SIGNAL ROUNDS
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

from app.document.model import Document, make_curve
from app.storage import system
from app.storage.files import ChangedOnDiskError, document_in, read_content, save
from tests.waiting import LIMIT


def main(path: Path, signal: Path, rounds: int) -> None:
    while not signal.exists():
        time.sleep(0.001)
    system._PATIENCE = LIMIT  # as long as another saves, on a busy machine
    saved = 0
    for _ in range(rounds):
        content = read_content(path)
        document = document_in(content.data, path).document
        number = document.curves[0].points[0].x
        # Long enough that a half written file would show.
        points = [(number + 1.0, 0.0)] + [(float(index), 1.0) for index in range(200)]
        try:
            save(path, Document((make_curve(points),)), expected=content.stamp)
        except ChangedOnDiskError:
            continue
        saved += 1
    print(saved)


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]), int(sys.argv[3]))
