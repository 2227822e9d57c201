# SPDX-License-Identifier: BSD-3-Clause
# `cmake --install build --prefix DIR`: the program, its engines and its data, as in the build tree but without links to the checkout; find_package(tripoint)
# for other projects; and by CPack a Debian package of the program. Included last: all targets are there.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/tripoint)
install(TARGETS tripoint EXPORT tripoint RUNTIME DESTINATION bin COMPONENT program)
install(TARGETS engine-tripoint engine-exact engine-bullet engine-lammps RUNTIME DESTINATION libexec/tripoint COMPONENT program)
install(TARGETS mesh-field LIBRARY DESTINATION lib/tripoint COMPONENT program)
install(DIRECTORY ${CMAKE_BINARY_DIR}/libexec/tripoint/ DESTINATION libexec/tripoint COMPONENT program USE_SOURCE_PERMISSIONS
  FILES_MATCHING PATTERN "engine-*" PATTERN selftest EXCLUDE PATTERN engine-tripoint EXCLUDE PATTERN engine-exact EXCLUDE PATTERN engine-bullet EXCLUDE PATTERN engine-lammps EXCLUDE
  PATTERN engine-tripoint-mpi EXCLUDE)  # made for the wheel in the checkout
foreach(room cases reports)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${room} DESTINATION share/tripoint COMPONENT program PATTERN __pycache__ EXCLUDE)
endforeach()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/cases/materials DESTINATION share/tripoint COMPONENT program)
foreach(room templates vendors)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/adapters/${room} DESTINATION share/tripoint COMPONENT program PATTERN __pycache__ EXCLUDE PATTERN CMakeLists.txt EXCLUDE PATTERN launcher.in EXCLUDE)
endforeach()
install(FILES ${PROJECT_SOURCE_DIR}/adapters/templates/cpp/CMakeLists.txt DESTINATION share/tripoint/templates/cpp COMPONENT program)
install(FILES LICENSE README.md REFERENCES.md CITATION.cff DESTINATION share/doc/tripoint COMPONENT program)
install(DIRECTORY LICENSES DESTINATION share/doc/tripoint COMPONENT program)

install(EXPORT tripoint NAMESPACE tripoint:: FILE tripointTargets.cmake DESTINATION ${package} COMPONENT program)
configure_package_config_file(cmake/tripointConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/tripointConfig.cmake INSTALL_DESTINATION ${package})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/tripointConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/tripointConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/tripointConfigVersion.cmake DESTINATION ${package} COMPONENT program)

# cpack --config build/CPackConfig.cmake -B DIR
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME tripoint)
set(CPACK_PACKAGE_CONTACT "the tripoint authors <nobody@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "validation testbed for coupled particle simulation")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "python3, python3-matplotlib, python3-h5py, python3-jinja2")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "weasyprint")
include(CPack)
