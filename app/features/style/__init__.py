"""Style: stroke and fill of all selected curves, copied and pasted.

- ``commands``: the panel in the window, the colours it offers, Swap Fill and Stroke, Copy and Paste Style.
- ``panel``: the form.  ``fields``: its fields of a colour, a dash pattern and a percentage.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
