"""Press, move and release turned into edits. No Qt: a tool is tested with plain `Pointer` records.

- ``tool``: the base class of the tools, the context of an event, and the registry of those in ``canvas``:
  which a person chooses.  ``tool_settings``: settings.  ``toolbox``: those of one plot, and which is in use.
- ``explain``, ``move_image``: tools of the canvas that belong to features.  ``transform_tool``: the one of a
  transform that a key begins.  ``rail``: those over t.
- ``pointer``: position, keys, and what lies under the pointer.
- ``drag_machine``: the state machine all drags share: threshold, preview, commit, cancel.
- ``drags``, ``bend_drag``, ``pen_drags``, ``rail_drags``: what each drag makes of the document.  ``parts``:
  presses on points and handles.  ``closing``: a click on the first point, which closes the curve.
- ``transform``, ``transform_box``: move, scale and rotate; the box with grips.  ``typed_amount``: the number,
  or the two, typed meanwhile.  ``target``: what these act on: selected points, or curves.
- ``curve_picker``: other curves, selected and dragged.  ``marquee``: points in a rubber band.
- ``snapping``: what a point snaps to.  ``snappers``: which of it for which gesture.
- ``marks``: what a gesture shows over the drawing.
- ``hints``: what a press would do, in words.
"""
