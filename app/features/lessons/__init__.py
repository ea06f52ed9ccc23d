"""Lessons: what makes a curve go where it goes, step by step.

- ``commands``: opens their documents, goes from step to step, and sees whether a goal is met.
- ``panel``: the gallery, and the text of a step.

What is read of the lessons themselves is in `app/lessons.py`.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
