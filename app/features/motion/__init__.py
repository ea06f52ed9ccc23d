"""A motion along the curve: a dot that runs at its own pace, rivals of other rules, and films of it.

- ``commands``: its actions.  ``player``: the clock that drives it.
- ``stage``: its bar and its dots in the window, made when the first action is used.
- ``export``: films.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
