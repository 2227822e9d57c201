# SPDX-License-Identifier: BSD-3-Clause
# Writes the commit that is built into OUT, and touches it only when it changed. Outside a clone it is "unknown".
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=12 OUTPUT_VARIABLE commit RESULT_VARIABLE failed
  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(failed)
  set(commit unknown)
endif()
file(CONFIGURE OUTPUT ${OUT} CONTENT "#define TRIPOINT_COMMIT \"${commit}\"\n")
