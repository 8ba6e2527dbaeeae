# SPDX-License-Identifier: BSD-3-Clause
highest_level: int
