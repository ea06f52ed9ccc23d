# Modules that are imported when they are first used.
from . import legend as legend
from . import motion_layer as motion_layer
