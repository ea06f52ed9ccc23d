"""Lessons: what makes a curve go where it goes, step by step.

- ``commands``: opens their documents, goes from step to step, and sees whether a goal is met.
- ``lesson``: what is read of them.  ``panel``: the gallery, and the text of a step.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
