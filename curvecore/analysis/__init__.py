"""Shape, smoothness and sensitivity of curves.

- ``curvature``, ``bounding_boxes``, ``lengths``, ``nearest_point``, ``nearest_on_arc``, ``intersections``:
  shape.
- ``continuity``: jumps at the joints, and the class that follows.
- ``basis_checks``: what is wrong with basis functions: their sum, their values at the parameters.
- ``stability``, ``cardinal``, ``sensitivity``, ``condition``: how errors of the data grow.
"""
