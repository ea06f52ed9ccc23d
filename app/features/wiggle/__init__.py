"""A wiggle explained: who pulls the curve at a place, and what would calm it.

- ``commands``: explains the place of the scrub line, and tries cures.
- ``panel``: the explanation.  ``weight_bars``: the share of each point, as bars.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
