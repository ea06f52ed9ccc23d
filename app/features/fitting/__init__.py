"""Curves of few points near many: how near the pencil comes, and fewer points for curves.

- ``commands``: the actions, and what they keep in step.
- ``panel``: the form of a fit.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
