# SPDX-License-Identifier: BSD-3-Clause
# build/share/tripoint/{cases,reports,materials}: the program finds its data at ../share/tripoint, in a build tree as installed.
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/share/tripoint)
foreach(folder cases reports)
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/${folder} ${CMAKE_BINARY_DIR}/share/tripoint/${folder} SYMBOLIC)
endforeach()
file(CREATE_LINK ${PROJECT_SOURCE_DIR}/cases/materials ${CMAKE_BINARY_DIR}/share/tripoint/materials SYMBOLIC)
