"""Pillow, an extra, imported when a film is written."""

from PIL import Image

__all__ = ["Image"]
