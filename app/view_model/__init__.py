"""Documents turned into arrays to draw. No Qt; with ``exchange`` the only place in app that calls curvecore.

- ``curve_view``: a document's curve as a core curve, its polyline, its handles, or why it cannot be made.
- ``basis_view``: the basis functions sampled for the basis panel, and the weights at one parameter.
- ``reshape``, ``split_join``: other points for the same curve; ``measure``: how far it moved all the same.
- ``motion``: from time to parameter.  ``motion_picture``, ``arrow``: what is drawn and said of a motion.
- ``node_arrays``, ``flattener``: what one view hands on to the next, so that only what changed is computed.
"""
