# SPDX-License-Identifier: BSD-3-Clause
"""Files for other programs: a module a format. Numbers are copied, none is computed but a row's own name."""
