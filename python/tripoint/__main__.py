# SPDX-License-Identifier: BSD-3-Clause
from ._program import main

main()
