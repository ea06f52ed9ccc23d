# Modules that are imported when they are first used.
from . import cost as cost
from . import cures as cures
from . import ghosts as ghosts
from . import goals as goals
from . import hodograph as hodograph
from . import joints as joints
from . import laboratory as laboratory
from . import legend as legend
from . import picture as picture
from . import plot_lines as plot_lines
from . import plot_samples as plot_samples
from . import plotted as plotted
from . import wiggle as wiggle
