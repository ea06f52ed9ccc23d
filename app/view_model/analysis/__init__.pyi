# Modules that are imported when they are first used.
from . import ghost_views as ghost_views
from . import goals as goals
from . import hodograph as hodograph
from . import joints as joints
from . import laboratory as laboratory
from . import legend as legend
from . import picture as picture
from . import plot as plot
from . import plot_samples as plot_samples
from . import wiggle as wiggle
