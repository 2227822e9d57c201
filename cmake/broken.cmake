# SPDX-License-Identifier: BSD-3-Clause
# The self-test's copies of sources: files that a folder's defects.toml changes are written to build/broken (tools/break_sources.py), and found there before the
# true ones. Nothing else is compiled of them, so what users get has no trace of a defect.
if(NOT TRIPOINT_TESTS AND NOT TRIPOINT_SELFTEST)
  return()  # a build of the program alone needs no Python
endif()
find_program(TRIPOINT_PYTHON3 NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH REQUIRED)
set(break_sources ${TRIPOINT_PYTHON3} -B ${PROJECT_SOURCE_DIR}/tools/break_sources.py)

# tripoint_break(NAME ROOT): target broken-NAME writes the changed files of ROOT to build/broken/NAME.
function(tripoint_break name root)
  file(GLOB_RECURSE tables CONFIGURE_DEPENDS ${root}/defects.toml)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${tables} ${PROJECT_SOURCE_DIR}/tools/break_sources.py)
  execute_process(COMMAND ${break_sources} --list ${root} OUTPUT_VARIABLE files RESULT_VARIABLE failed OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(failed)
    message(FATAL_ERROR "the defects of ${root} can't be put into its files")
  endif()
  string(REPLACE "\n" ";" files "${files}")
  set(copies)
  foreach(file ${files})
    set(copy ${CMAKE_BINARY_DIR}/broken/${name}/${file})
    add_custom_command(OUTPUT ${copy} COMMAND ${break_sources} --write ${file} --to ${copy} ${root}
      DEPENDS ${root}/${file} ${tables} ${PROJECT_SOURCE_DIR}/tools/break_sources.py COMMENT "Breaking ${file} for the self-test")
    list(APPEND copies ${copy})
  endforeach()
  add_custom_target(broken-${name} DEPENDS ${copies})
  set_property(GLOBAL PROPERTY tripoint_broken_${name} "${files}")
  set_property(GLOBAL APPEND PROPERTY tripoint_broken_tables ${tables})
endfunction()

# tripoint_broken_sources(VARIABLE NAME ROOT FILE...): those of FILE that are broken in the copies of NAME stand for the true ones.
function(tripoint_broken_sources variable name root)
  get_property(files GLOBAL PROPERTY tripoint_broken_${name})
  set(list)
  foreach(source ${ARGN})
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} NORMALIZE OUTPUT_VARIABLE path)
    file(RELATIVE_PATH file ${root} ${path})
    if(file IN_LIST files)
      set(path ${CMAKE_BINARY_DIR}/broken/${name}/${file})
      set_source_files_properties(${path} PROPERTIES GENERATED ON)
    endif()
    list(APPEND list ${path})
  endforeach()
  set(${variable} ${list} PARENT_SCOPE)
endfunction()

# tripoint_sees_broken(TARGET NAME): its includes find the broken headers first. How a change breaks its lines is no error: some compilers count columns, some not.
function(tripoint_sees_broken target name)
  target_compile_options(${target} PRIVATE -Wno-misleading-indentation)
  target_include_directories(${target} BEFORE PRIVATE ${CMAKE_BINARY_DIR}/broken/${name})
  add_dependencies(${target} broken-${name})
endfunction()
