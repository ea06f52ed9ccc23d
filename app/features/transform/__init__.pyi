# Modules that are imported when they are first used.
from . import copies_field as copies_field
from . import panel as panel
