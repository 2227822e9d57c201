# SPDX-License-Identifier: BSD-3-Clause
# build/share/tripoint/NAME: the program finds its data at ../share/tripoint, in a build tree as installed. The links are relative, so that a
# checkout that is moved or copied with its build finds its own data.
function(tripoint_share name folder)
  file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/share/tripoint)
  file(RELATIVE_PATH target ${CMAKE_BINARY_DIR}/share/tripoint ${folder})
  file(CREATE_LINK ${target} ${CMAKE_BINARY_DIR}/share/tripoint/${name} SYMBOLIC)
endfunction()

tripoint_share(cases ${PROJECT_SOURCE_DIR}/cases)
tripoint_share(materials ${PROJECT_SOURCE_DIR}/cases/materials)
tripoint_share(reports ${PROJECT_SOURCE_DIR}/reports)
