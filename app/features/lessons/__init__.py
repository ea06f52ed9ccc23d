"""Lessons: why a curve goes where it goes, step by step.

To add a lesson: make a folder `NN_name` in `resources/lessons` with

- `lesson.md`: the first heading is the title, the paragraph below it the summary in the list of lessons.
  Every second-level heading begins a step, with a comment of fields that semicolons separate::

      <!-- curve: Careless; show: overlayBand; set: epsilon 0.02; goal: lebesgue < 5; keep: points, family -->

  `curve` names the curve to edit, `show` the actions to switch on, `set` the settings of the analysis
  (`lesson.SETTINGS`), `goal` what that curve must meet, `keep` what must stay as it is meanwhile
  (`view_model/analysis/goals.py` has both tables). A link to `action:NAME` triggers that action.
- `document.curve.json`: the document of the lesson, as the program saves it.
- `lesson.py`, where there is something to compute. `MEASURES` and `KEPT` add to the tables of goals.
  The other functions are for the tests: `claims(lesson)` yields quotes of the text with the values of their
  numbers, and every number of the text needs one; `reach_goal_N(editor)` does what step N asks for, by real
  events, and `do_step_N(editor)` what it asks for apart from a goal. Their docstrings quote the text.
  `05_sensitivity` is an example.

Nothing else has to be touched: the folders are found by listing them. The Python of a lesson runs only where
the lesson comes with the program; a lesson from anywhere else is text and a document.

- ``lesson``: the text, read into steps.  ``commands``: opens documents, goes from step to step, checks goals.
- ``panel``: the list of lessons, and the text of a step.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
