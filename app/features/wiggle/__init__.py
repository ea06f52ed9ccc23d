"""A wiggle explained: which points pull the curve at the scrub line, and possible cures.

- ``commands``: explains the curve at the scrub line, tries cures; the tool by which a click puts the line.
- ``panel``: the explanation, the weights of the points as bars, and the cures.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
