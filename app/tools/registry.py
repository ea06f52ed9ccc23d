"""The registry of the tools that a person chooses for the canvas.

To add one: a file with a subclass of `Tool` and its `ToolRecord`, named here. The action with its key and
its place in menus and palette, and the way back by Escape, come from the record.
"""

from app.tools.add import ADD
from app.tools.measure import MEASURE
from app.tools.select import SELECT
from app.tools.tool import ToolRecord

TOOLS: list[ToolRecord] = [SELECT, ADD, MEASURE]
