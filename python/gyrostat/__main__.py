# SPDX-License-Identifier: BSD-3-Clause
"""python -m gyrostat"""

import sys

from gyrostat.cli import main

sys.exit(main())
