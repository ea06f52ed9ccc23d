"""What is known of a layer in which there is no curve."""

from __future__ import annotations

from .value import Value


class EmptyLayer(Value, frozen=True):
    """A layer in which there is no curve.

    Attributes
    ----------
    name
        Its name, which `Document.layers` has, too.
    inside
        Name of the layer that it is in, or empty.
    visible, locked
        Whether what is drawn is seen, and whether it is safe from that.
    """

    name: str
    inside: str = ""
    visible: bool = True
    locked: bool = False
