"""Curves computed in decimal arithmetic of few digits, and the truth to compare with.

- ``evaluation``: curves with k digits.  ``decimal_methods``: its methods, operation by operation.
  ``data``: what they are computed from.  ``exact_values``: the truth, and the digits lost.
- ``operations``: their cost.  ``rounded_data``: data rounded to so many decimals or digits.
- ``exact``: polynomials through data, in integers.
"""
