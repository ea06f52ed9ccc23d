# Modules that are imported when they are first used.
from . import application as application
from . import commands as commands
from . import converting as converting
from . import families as families
from . import info as info
from . import lessons as lessons
from . import rendering as rendering
from . import start as start
from . import windows as windows
from .command_line import main as main
