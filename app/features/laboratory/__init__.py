"""The stability laboratory: the same curve computed with few digits, by several methods.

- ``commands``: computes beside the window.  ``error_plot``: the errors, over t.
- ``panel``, ``method_table``, ``digits_table``: few digits.  ``cost_panel``, ``log_plot``: costs.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
