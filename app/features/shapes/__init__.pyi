# Modules that are imported when they are first used.
from . import distances as distances
from . import field as field
