"""Shape, smoothness and sensitivity of curves.

- ``geometry``, ``lengths``, ``quadrature``, ``nearest_point``, ``arc_pairs``, ``intersections``: shape.
- ``continuity``: jumps at the joints, and the class that follows.
- ``stability``, ``cardinal``, ``sensitivity``, ``ensembles``, ``condition``: how errors of the data grow.
"""
