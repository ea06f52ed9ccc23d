"""A motion along the curve: a dot that runs at its own pace, rivals of other rules, and films of it.

- ``commands``: its actions.  ``stage``: what it needs in the window, made when the first of them is used.
- ``player``: the clock that drives it.  ``bar``: its controls.
- ``export``, ``dialog``: films.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
