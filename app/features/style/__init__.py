"""Style: stroke and fill of all selected curves, copied and pasted.

- ``commands``: the panel in the window, the colours it offers, and Swap Fill and Stroke.
- ``clipboard_commands``: Copy Style and Paste Style.
- ``panel``: the form.  ``paint_field``: a colour, clicked, typed or chosen.  ``percent_field``: a share.
  ``dash_field``: presets of dashes, and a list of one's own.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
