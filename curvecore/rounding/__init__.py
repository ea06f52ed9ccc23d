"""Curves computed in decimal arithmetic of few digits, and exact values to compare with.

- ``evaluation``: curves with k digits: start here.  ``decimal_methods``: the methods, operation by operation.
- ``data``: data of a curve, rounded to so many decimals or digits.
- ``exact``: curves without rounding, in integers, and the digits lost.
- ``operations``: the cost of each method.
"""
