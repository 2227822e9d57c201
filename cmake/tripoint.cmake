# SPDX-License-Identifier: BSD-3-Clause
# A target a room: tripoint_room(NAME SOURCES a.cpp ... PUBLIC deps PRIVATE deps) makes tripoint_NAME and tripoint::NAME.
add_library(tripoint_warnings INTERFACE)
add_library(tripoint::warnings ALIAS tripoint_warnings)
target_compile_options(tripoint_warnings INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wno-sign-conversion
  $<$<BOOL:${TRIPOINT_WERROR}>:-Werror>)

# What is compiled for a vector unit (NAME_unit.cpp) stays a unit of its own at every width.
function(tripoint_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  set(units ${ROOM_SOURCES})
  list(FILTER units INCLUDE REGEX "_unit\\.cpp$")
  set_source_files_properties(${units} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  add_library(tripoint_${name} STATIC ${ROOM_SOURCES})
  add_library(tripoint::${name} ALIAS tripoint_${name})
  target_include_directories(tripoint_${name} PUBLIC ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR})
  target_link_libraries(tripoint_${name} PUBLIC ${ROOM_PUBLIC} PRIVATE ${ROOM_PRIVATE} tripoint::warnings)
endfunction()

# FOLDER/all_pair_slots.hpp, which includes the headers of all effects that have pair terms: tripoint_pair_slots(FOLDER effects/NAME/pair_slots.hpp ...)
function(tripoint_pair_slots folder)
  list(TRANSFORM ARGN REPLACE "(.+)" "#include \"\\1\"\n" OUTPUT_VARIABLE lines)
  list(JOIN lines "" text)
  file(CONFIGURE OUTPUT ${folder}/all_pair_slots.hpp CONTENT "${text}" @ONLY)
endfunction()

# Adds FILES to a room once for each vector unit; code chooses at run time (core/machine.hpp). At -O1 at least: unoptimised, shared
# inline functions of such a file could be taken for the whole program.
# tripoint_units(TARGET a.cpp ... [DEFECTS]); DEFECTS: as the test build has them
function(tripoint_units target)
  cmake_parse_arguments(U "DEFECTS" "" "" ${ARGN})
  foreach(unit "Avx2;4;-mavx2" "Avx512;8;-mavx512f -mavx512dq -mprefer-vector-width=512")
    list(GET unit 0 name)
    list(GET unit 1 lanes)
    list(GET unit 2 options)
    separate_arguments(options)
    add_library(${target}_${name} OBJECT ${U_UNPARSED_ARGUMENTS})
    target_include_directories(${target}_${name} PRIVATE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR})
    target_compile_definitions(${target}_${name} PRIVATE TRIPOINT_UNIT=${name} TRIPOINT_UNIT_LANES=${lanes} $<$<BOOL:${U_DEFECTS}>:TRIPOINT_DEFECTS>)
    if(U_DEFECTS)
      tripoint_sees_broken(${target}_${name} src)
    endif()
    target_compile_options(${target}_${name} PRIVATE ${options} $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized> $<IF:$<CONFIG:Debug>,-O1,-O3>)
    target_link_libraries(${target}_${name} PRIVATE OpenMP::OpenMP_CXX tripoint::warnings)
    set_target_properties(${target}_${name} PROPERTIES UNITY_BUILD OFF)
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${target}_${name}>)
  endforeach()
endfunction()

# An engine executable: build/libexec/tripoint/engine-NAME
function(tripoint_engine name)
  cmake_parse_arguments(ENGINE "" "" "SOURCES;PRIVATE" ${ARGN})
  add_executable(engine-${name} ${ENGINE_SOURCES})
  target_include_directories(engine-${name} PRIVATE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR})
  target_link_libraries(engine-${name} PRIVATE ${ENGINE_PRIVATE} tripoint::warnings)
  set_target_properties(engine-${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/libexec/tripoint)
endfunction()

# A test program of one room: tripoint_test(NAME SOURCES a_test.cpp ... PRIVATE deps); every TEST becomes a ctest.
function(tripoint_test name)
  cmake_parse_arguments(T "" "" "SOURCES;PRIVATE" ${ARGN})
  add_executable(test-${name} ${T_SOURCES})
  target_include_directories(test-${name} PRIVATE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/tests)
  target_link_libraries(test-${name} PRIVATE ${T_PRIVATE} tripoint::warnings GTest::gtest_main)
  target_compile_options(test-${name} PRIVATE $<$<CONFIG:Release>:-O1>)  # a test's own code is compiled longer than it runs
  set_target_properties(test-${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  gtest_discover_tests(test-${name} DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60 PROPERTIES LABELS ${name})
endfunction()

# The definition of TRIPOINT_EFFECTS for these effects, or groups of them: tripoint_effect_list(VARIABLE liquid solid heat ...). None = all.
function(tripoint_effect_list variable)
  set(groups_liquid pressure viscosity density contact lattice_walls no_slip walls faces interfaces transport motion)
  set(groups_solid elastic motion)
  set(groups_heat heat rigid)  # what conducts and does not flow is a body
  foreach(name ${ARGN})
    if(DEFINED groups_${name})
      list(APPEND names ${groups_${name}})
    else()
      list(APPEND names ${name})
    endif()
  endforeach()
  list(REMOVE_DUPLICATES names)
  list(JOIN names "," text)
  set(definition "")
  if(NOT text STREQUAL "")
    set(definition "TRIPOINT_EFFECTS=\",${text},\"")
  endif()
  set(${variable} "${definition}" PARENT_SCOPE)
endfunction()
