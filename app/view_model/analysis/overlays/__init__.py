"""Overlays over the curve, one or two a module: `OVERLAYS` finds the records by listing the package.

To add an overlay, add a module here; nothing else names it. The menu, the palette, the Analysis dock with
its switch and sliders, the legend and the canvas read the record::

    # app/view_model/analysis/overlays/dots.py
    import numpy as np

    from ...line_styles import LineStyle
    from ...settings import Count
    from ..overlay import Figure, Figures, Group, Overlay, OverlayInput, Shape

    DOT = LineStyle("accent")
    COUNT = Count("dotCount", "Number of dots", 20, limits=(2, 100))

    def _dots(data: OverlayInput) -> Figures:
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
        draw=_dots,
        settings=(COUNT,),
        legend=lambda _view, _settings: [(DOT, "Equal steps of t")],
    )

`Overlay` (``overlay``) explains the fields, ``app/view_model/settings.py`` the kinds of settings. The legend
has a row for each entry of `legend`, and for those of `finds` (figures that are there or not, such as
crossings) whose style is drawn. It compares styles by identity: an entry and its figures have the same
`LineStyle` object, a constant of the module. Without entries an overlay has no row.

A drawing that takes more than about 2 ms a frame says so with `settles`, and is computed beside the window.
The modules are imported at the start: call the core as `curvecore.curvature_of(…)` after `import curvecore`.

``tests/gui/test_own_overlay.py`` adds two. ``test_overlays.py`` in ``tests/gui`` and in ``tests/view_model``
tries every overlay that there is, ``tests/view_model/test_any_family.py`` with curves of every family.
"""
