# Modules that are imported when they are first used.
from . import field as field
