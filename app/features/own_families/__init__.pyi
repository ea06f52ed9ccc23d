# Modules that are imported when they are first used.
from . import template as template
from . import trial as trial
