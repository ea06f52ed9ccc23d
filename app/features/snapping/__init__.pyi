# Modules that are imported when they are first used.
from . import guide_field as guide_field
