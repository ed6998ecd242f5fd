# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0

# tenon_folder(<folder> [LIBRARIES <target>...] [WITHOUT <sub-folder>...] [OF_PROGRAM]
#              [FAST | SMALL])
#
# Turns tenon/<folder> into the static library tenon_<folder> ('/' becomes '_'), built from every
# .cpp in it and below it except *_test.cpp and except the sub-folders named by WITHOUT (they are
# folders of their own). Its dependencies are read from tenon/folders.txt. With TENON_DEVELOPER it
# also makes
#   tenon_<folder>_test      all *_test.cpp, each TEST registered with ctest under the label `unit`
#   tenon_<folder>_headers   compiles every header without a source file alone, unless TENON_UNITY
# A folder without any .cpp becomes an interface library. The others, and what they name as
# LIBRARIES, are in the global properties TENON_FOLDER_LIBRARIES and TENON_FOLDER_NEEDS, of which
# libtenon.so is made; what is OF_PROGRAM is in the program alone. FAST is for folders whose own
# code takes most of the time that users wait, SMALL for those whose own takes none that anybody
# notices (tenon_speed).
function(tenon_folder folder)
  cmake_parse_arguments(PARSE_ARGV 1 arg "OF_PROGRAM;FAST;SMALL" "" "LIBRARIES;WITHOUT")
  string(REPLACE "/" "_" name ${folder})
  set(library tenon_${name})
  set(root ${PROJECT_SOURCE_DIR}/tenon/${folder})

  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${root}/*.cpp)
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS ${root}/*.h)
  foreach(other IN LISTS arg_WITHOUT)
    list(FILTER sources EXCLUDE REGEX "^${root}/${other}/")
    list(FILTER headers EXCLUDE REGEX "^${root}/${other}/")
  endforeach()
  set(tests ${sources})
  list(FILTER tests INCLUDE REGEX "_test\\.cpp$")
  list(FILTER sources EXCLUDE REGEX "_test\\.cpp$")
  list(SORT sources)
  list(SORT tests)

  tenon_folder_line(${folder} dependencies)
  tenon_folder_libraries("${dependencies}" dependencies)
  if(sources)
    if(arg_FAST)
      set(speed fast)
    elseif(arg_SMALL)
      set(speed small)
    else()
      set(speed plain)
    endif()
    tenon_folder_library(${library} ${speed} "${sources}" "${dependencies}" "${arg_LIBRARIES}")
    if(NOT arg_OF_PROGRAM)
      set_property(GLOBAL APPEND PROPERTY TENON_FOLDER_LIBRARIES ${library})
      set_property(GLOBAL APPEND PROPERTY TENON_FOLDER_NEEDS ${arg_LIBRARIES})
    endif()
  else()
    add_library(${library} INTERFACE)
    target_link_libraries(${library} INTERFACE tenon_flags ${dependencies} ${arg_LIBRARIES})
  endif()

  if(TENON_DEVELOPER)
    tenon_header_check(${library} "${headers}")
    tenon_unit_tests(${library} "${tests}")
    tenon_folder_line("${folder} tests" extra)
    if(extra AND TARGET ${library}_test)
      tenon_folder_libraries("${extra}" extra)
      target_link_libraries(${library}_test PRIVATE ${extra})
    endif()
  endif()
endfunction()

# <library> of the sources of a folder, which may use the folders <dependencies> and the <libraries>
# of others. With TENON_QUICK the sources of all folders are one library, tenon_folders: its few
# large units read headers and instantiate templates less often, a fifth less to compile.
function(tenon_folder_library library speed sources dependencies libraries)
  if(TENON_QUICK)
    if(NOT TARGET tenon_folders)
      add_library(tenon_folders STATIC)
      target_compile_options(tenon_folders PRIVATE -fno-exceptions -fno-rtti)
      target_link_libraries(tenon_folders PUBLIC tenon_flags)
      tenon_unity(tenon_folders)
    endif()
    target_sources(tenon_folders PRIVATE ${sources})
    target_link_libraries(tenon_folders PUBLIC ${libraries})
    add_library(${library} INTERFACE)
    target_link_libraries(${library} INTERFACE tenon_folders ${dependencies})
    return()
  endif()
  add_library(${library} STATIC ${sources})
  target_compile_options(${library} PRIVATE -fno-exceptions -fno-rtti)
  tenon_speed(${library} ${speed})
  tenon_unity(${library})
  target_link_libraries(${library} PUBLIC tenon_flags ${dependencies} ${libraries})
  tenon_precompile(${library} ${speed}_folder)
endfunction()

# The target that compiles the sources of <library>.
function(tenon_compiled_in library out)
  if(TENON_QUICK)
    set(library tenon_folders)
  endif()
  set(${out} ${library} PARENT_SCOPE)
endfunction()

# How releases of the target are compiled: `fast`, `small`, or `plain`, which is as all targets are.
# GCC stops inlining where a unit has grown by 40 %, which costs units of many sources a tenth of
# their speed; the bounds of `fast` let them be inlined like single files, for a fifth more to
# compile. `small` is a third of the code. With TENON_QUICK nothing is optimised.
function(tenon_speed target speed)
  if(TENON_QUICK)
    return()
  endif()
  if(speed STREQUAL small)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-Os>)
  elseif(speed STREQUAL fast AND TENON_UNITY AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    target_compile_options(
      ${target} PRIVATE $<$<CONFIG:Release>:--param=large-unit-insns=1000000
                        --param=inline-unit-growth=400>)
  endif()
endfunction()

# Reads the line "<key> : a b c" of tenon/folders.txt into <out> as a list; empty without a line.
function(tenon_folder_line key out)
  set(table ${PROJECT_SOURCE_DIR}/tenon/folders.txt)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${table})
  file(STRINGS ${table} line REGEX "^${key} *:")
  string(REGEX REPLACE "^[^:]*:" "" line "${line}")
  string(STRIP "${line}" line)
  string(REGEX REPLACE " +" ";" found "${line}")
  if(NOT TENON_WITH_MUJOCO)
    list(REMOVE_ITEM found engines/mujoco mjcf)
  endif()
  if(NOT TENON_WITH_PHYSX)
    list(REMOVE_ITEM found engines/physx)
  endif()
  if(NOT TENON_WITH_JOLT)
    list(REMOVE_ITEM found engines/jolt)
  endif()
  if(NOT TENON_WITH_VIEW)
    list(REMOVE_ITEM found serve live)
  endif()
  set(${out} ${found} PARENT_SCOPE)
endfunction()

# Folder names -> library targets; `tenon` is the wiring.
function(tenon_folder_libraries folders out)
  list(TRANSFORM folders REPLACE "/" "_")
  list(TRANSFORM folders PREPEND tenon_)
  list(TRANSFORM folders REPLACE "^tenon_tenon$" "tenon")
  set(${out} ${folders} PARENT_SCOPE)
endfunction()

# One generated .cpp per header that includes only this header, compiled into an object library. A
# header with a source file beside it needs none: the source includes it first, a test holds that.
function(tenon_header_check library headers)
  if(TENON_UNITY)
    return()
  endif()
  set(units)
  foreach(header IN LISTS headers)
    string(REGEX REPLACE "\\.h$" ".cpp" source ${header})
    # Tests of engines that the file that includes them names.
    if(EXISTS ${source} OR header MATCHES "/test_interface\\.h$")
      continue()
    endif()
    file(RELATIVE_PATH relative ${PROJECT_SOURCE_DIR} ${header})
    string(MAKE_C_IDENTIFIER ${relative} unit_name)
    set(unit ${CMAKE_CURRENT_BINARY_DIR}/headers/${unit_name}.cpp)
    set(text "#include \"${relative}\"\n#include \"${relative}\"  // twice: the guard holds\n")
    file(CONFIGURE OUTPUT ${unit} CONTENT "${text}" @ONLY)
    list(APPEND units ${unit})
    if(header MATCHES "/test_[a-z_]+\\.h$")
      set_source_files_properties(${unit} PROPERTIES COMPILE_DEFINITIONS
                                                     TENON_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
    endif()
  endforeach()
  if(units)
    add_library(${library}_headers OBJECT ${units})
    target_link_libraries(${library}_headers PRIVATE ${library})
    target_compile_options(${library}_headers PRIVATE -O0 -fno-sanitize=all) # never run
  endif()
endfunction()

# GoogleTest's header, compiled once for all unit tests. Not with ccache, which precompiled headers
# would only disturb.
function(tenon_precompiled_gtest out)
  set(${out} "" PARENT_SCOPE)
  if(TENON_CCACHE)
    return()
  endif()
  if(NOT TARGET tenon_gtest)
    # A program, as the tests are: its flags have to be theirs.
    set(unit ${PROJECT_BINARY_DIR}/gtest_header.cpp)
    file(CONFIGURE OUTPUT ${unit} CONTENT "int main() {}\n" @ONLY)
    add_executable(tenon_gtest ${unit})
    target_link_libraries(tenon_gtest PRIVATE tenon_flags GTest::gtest)
    target_precompile_headers(tenon_gtest PRIVATE <gtest/gtest.h>)
    if(TENON_SANITIZE)
      target_compile_options(tenon_gtest PRIVATE -O0 -g0)
    endif()
  endif()
  set(${out} tenon_gtest PARENT_SCOPE)
endfunction()

function(tenon_unit_tests library tests)
  if(NOT tests)
    return()
  endif()
  add_executable(${library}_test ${tests})
  target_link_libraries(${library}_test PRIVATE ${library} GTest::gtest_main)
  target_compile_definitions(${library}_test
                             PRIVATE TENON_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  if(TENON_SANITIZE)
    # Half the compile time; what is tested keeps its optimisation and its lines.
    target_compile_options(${library}_test PRIVATE -O0 -g0)
  endif()
  tenon_unity(${library}_test)
  tenon_precompiled_gtest(precompiled)
  if(precompiled)
    target_precompile_headers(${library}_test REUSE_FROM ${precompiled})
  endif()
  gtest_discover_tests(
    ${library}_test
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
    DISCOVERY_TIMEOUT 300
    PROPERTIES LABELS unit TIMEOUT 900)
endfunction()
