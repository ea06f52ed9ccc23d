"""The panels below the canvas. They draw a value and report what the person did.

- ``basis_pane``: the basis functions over t with a header.  ``basis_scene``: its layers.
  ``basis_panel``: the gestures on it.  ``basis_hits``: what lies under the pointer.  ``tick_edit``: a t typed
  at its tick.  ``basis_layers``, ``function_lines``, ``crest_names``: functions, t-rail, scrub line, painted.
- ``plot_panel``, ``plot_pane``, ``plot_canvas``, ``plot_layers``, ``value_scale``: plots over t.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
