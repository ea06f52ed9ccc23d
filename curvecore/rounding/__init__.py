"""Curves computed in decimal arithmetic of few digits, and the truth to compare with.

- ``evaluation``: curves with k digits.  ``decimal_methods``: its methods, operation by operation.
- ``operations``: their cost.  ``rounded_data``: data rounded to so many decimals or digits.
- ``exact``: polynomials through data, in integers.
"""
