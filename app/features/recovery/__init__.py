"""Recovery of unsaved work.

- ``autosave``: snapshots of unsaved work, and of work that was left for a lesson or an example.
- ``commands``: offers the snapshots of the last run, and restores them.
- ``bar``: the bar over the canvas that offers them.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
