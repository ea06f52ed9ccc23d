"""What a drawing of another program shows beside its curves: texts and pictures, which are not edited here.

- ``commands``: them on the canvas, shown and hidden.
"""
