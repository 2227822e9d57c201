# SPDX-License-Identifier: BSD-3-Clause
# tripoint_guards: options of what is shipped, which reads files of others. It ends before it uses a return address that a file has overrun, holds calls
# of the C library to the sizes of their buffers, which wants an optimiser, and touches each page of a great frame, so that no frame leaps over the page
# below the stack.
include(CheckCXXCompilerFlag)
set(tripoint_guards -fstack-protector-strong $<$<CONFIG:Release,RelWithDebInfo>:-U_FORTIFY_SOURCE$<SEMICOLON>-D_FORTIFY_SOURCE=3>)
# Calls and returns are marked for processors that check where a jump lands (x86). A program is checked as a whole: one object without marks, as the
# start-up code of Debian 12's C library is, switches it off, and so does src/effects, where a mark in each small function would cost a step up to 0.5 %, by a count of its calls.
foreach(guard -fstack-clash-protection -fcf-protection=full)
  string(MAKE_C_IDENTIFIER "TRIPOINT_HAS${guard}" has)
  check_cxx_compiler_flag(${guard} ${has})
  if(${has})
    list(APPEND tripoint_guards ${guard})
  endif()
endforeach()
