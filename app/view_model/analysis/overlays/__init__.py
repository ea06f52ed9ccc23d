"""Overlays over the curve, one or two a module: `OVERLAYS` finds the records by listing the package.

To add an overlay, add a module here; nothing else names it. The menu, the palette, the Analysis dock with
its switch and sliders, the legend and the canvas read the record::

    # app/view_model/analysis/overlays/dots.py
    import numpy as np

    from ...line_styles import LineStyle
    from ..overlay import Count, Figure, Figures, Group, Overlay, OverlayInput, Shape

    DOT = LineStyle("accent")
    COUNT = Count("dotCount", "Number of dots", 20, limits=(2, 100))

    def dots(data: OverlayInput) -> Figures:
        curve = data.view.curve
        if curve is None:
            return Figures()
        t = np.linspace(*curve.domain, data.value(COUNT) + 1)
        return Figures([Figure(DOT, Shape.MARKS, curve.evaluate(t))])

    DOTS = Overlay(
        name="dots",
        text="Dots at Equal t",
        tip="Draw dots at equal steps of t: far apart where the curve is fast",
        group=Group.SHAPE,
        rank=55,
        draw=dots,
        settings=(COUNT,),
    )

`Overlay` (``overlay``) explains the fields. A drawing that takes more than about 2 ms a frame says so with
`settles`, and is computed beside the window. The modules are imported at the start: call the core as
`curvecore.curvature_of(…)` after `import curvecore`. ``tests/gui/test_own_overlay.py`` adds two.
"""
