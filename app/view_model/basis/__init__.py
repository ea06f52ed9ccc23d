"""Basis and cardinal functions of a curve, and what they say about it.

- ``basis_view``, ``cardinal_view``: basis and cardinal functions sampled for the basis panel.
- ``basis_findings``: what is wrong with the functions and what is to be known, in sentences.
- ``growth``: the growth of errors of points.
- ``parameter_slopes``: the effect of a parameter, estimates included.
"""
