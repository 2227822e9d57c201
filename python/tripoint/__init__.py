# SPDX-License-Identifier: BSD-3-Clause
"""tripoint in Python: run a case, read its fields as arrays, judge it, and draw the standard plots.

    import tripoint
    run = tripoint.run("rigid/ballistic", until="0.5 s")
    run["position"]                    # metres: frames x particles x 3
    results = tripoint.validate("rigid/ballistic", engines=["tripoint", "bullet"])
    results.gates                      # a list of dicts

The work is done by the program `tripoint`; every option here is one of its options. SI units everywhere.
"""

from ._program import ProgramError, program
from ._results import Results, compare, read_results, validate
from ._run import Run, read_run, run

__all__ = ["ProgramError", "Results", "Run", "compare", "program", "read_results", "read_run", "run", "validate"]
