"""Printing on paper, at true size.

- ``commands``: the action and the system's dialog.
- ``paper``: the printer's paper for a document, and the document painted on it.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
