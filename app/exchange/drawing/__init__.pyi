# Modules that are imported when they are first used.
from . import annotations as annotations
from . import image as image
from . import motion_frames as motion_frames
from . import pillow as pillow
