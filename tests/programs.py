"""Executable files that are Python code."""

from __future__ import annotations

import sys
from pathlib import Path


def write_program(path: Path, code: str) -> None:
    """Write code as a program that this Python runs, which may lie in a folder with a space in its name.

    A first line `#!PYTHON` ends at its first space. Here a shell reads the second line, to Python a text.
    """
    head = f"""#!/bin/sh
'''exec' "{sys.executable}" "$0" "$@"
'''
"""
    path.write_text(head + code, encoding="utf-8")
    path.chmod(0o755)
