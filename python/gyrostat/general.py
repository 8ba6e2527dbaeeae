# SPDX-License-Identifier: BSD-3-Clause
"""One body with any wheels under any torques, over arrays: the functions of families/general."""

from gyrostat.families.general import functions
from gyrostat.families.general.functions import *  # noqa: F403
from gyrostat.families.general.rewrite import as_general, recognised, segments_of
from gyrostat.families.general.scene import arguments

__doc__ = functions.__doc__
__all__ = ["arguments", "as_general", "recognised", "segments_of"]
__all__ += functions.__all__
