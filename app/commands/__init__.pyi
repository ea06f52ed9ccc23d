# Modules that are imported when they are first used.
from . import motion_stage as motion_stage
