"""Documents turned into arrays to draw. No Qt; of app only ``families`` and ``exchange`` call curvecore, too.

- ``curve_view``: a document's curve as a core curve, its polyline, its handles, or why it cannot be made.
  ``views_ahead``: those of many, made beside the window.
- ``basis_view``: the basis functions sampled for the basis panel, and the weights at one parameter.
- ``jets``, ``handles``: what was set and what the rules estimate; where a person drags it.
- ``cardinals``, ``growth``: what each point does, with its estimates; how errors of points grow.
- ``parameter_slopes``: what a parameter does, with the estimates that follow it.
- ``cardinal_view``: cardinal functions sampled for the basis panel.
- ``bend``, ``bend_together``: the curve pulled somewhere.  ``nearest``: its point nearest to a place.
- ``reshape``, ``split_join``, ``smoothness``: other points for the same curve, two of one, corners;
  ``measure``: how far it moved all the same.
- ``point_columns``: the columns of the point table.
- ``refusals``: why there is no curve, in the program's words.
- ``arc_lengths``: how long it is, to a relative accuracy.
- ``straight``: segments made straight, the rest of the curve kept.
- ``pasting``: points carried from one curve to another.
- ``motion``, ``motion_settings``: from time to parameter; how the dot runs.
  ``motion_picture``, ``arrow``: what is drawn and said of a motion.
- ``line_styles``, ``palette``: how lines and marks look; the colours of points.
- ``goals``: what a lesson asks for.
- ``point_arrays``, ``flattener``: what one view hands on to the next, so that only what changed is computed.
- ``analysis``: why the curve goes where it goes.
- ``records``: registries that read their records off the modules of a package.
- ``closing``: curves closed and opened, with the shape kept.  ``appending``: points appended by the pen;
  ``pen_preview``: the curve before it is.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
