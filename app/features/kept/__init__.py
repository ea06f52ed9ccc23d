"""What a drawing of another program shows beside its curves: texts and pictures, only to be moved.

- ``commands``: them on the canvas, shown and hidden.
"""
