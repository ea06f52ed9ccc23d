"""Plots over t, one or several a module: `PLOTS` finds the records by listing the package.

To add a plot, add a module here with a `Plot` (``plot`` explains the fields); nothing else names it::

    # app/view_model/analysis/plots/height.py
    from ..plot import Plot

    HEIGHT = Plot(
        name="height",
        text="Height",
        tip="Plot y over t",
        title="Height y",
        symbol="y",
        rank=90,
        orders=(0,),
        values=lambda sampled: sampled.derivatives[0][:, 1],
    )

`values` is called for the visible t, and for the t of the scrub line alone: each value depends only on the
curve and on its own t. An integral along the curve begins at the start of the domain. `orders` names the
derivatives that come with the samples, 0 the positions. ``tests/gui/test_own_overlay.py`` adds one.
"""
