# Modules that are imported when they are first used.
from . import fields as fields
from . import panel as panel
