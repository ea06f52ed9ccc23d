"""Panels of no one feature.

- ``parametrization_bar``: the rule for the t_i and its α.
"""
