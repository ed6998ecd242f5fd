# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# tenon::tenon, the library of all folders as one shared library, for programs outside: installed
# (cmake/install.cmake), or with this project as a part of theirs. Shared, because it finds the
# worker and the engines beside itself, wherever the prefix was moved to, and because programs then
# are linked to nothing else. It exports tenon's own names alone (tenon.map).
get_property(folders GLOBAL PROPERTY TENON_FOLDER_LIBRARIES)
get_property(needs GLOBAL PROPERTY TENON_FOLDER_NEEDS)
set(objects ${folders})
list(TRANSFORM objects REPLACE "(.+)" "$<TARGET_OBJECTS:\\1>")
# Reading by assimp and by MuJoCo is left to the worker, as in the program.
list(TRANSFORM objects REPLACE "(.+:tenon_mesh>)" "$<FILTER:\\1,EXCLUDE,/assimp_scene>")
list(TRANSFORM objects REPLACE "(.+:tenon_mjcf>)" "$<FILTER:\\1,INCLUDE,/write_>")
add_library(tenon_library SHARED ${objects})
add_library(tenon::tenon ALIAS tenon_library)
add_dependencies(tenon_library tenon_worker)
set_target_properties(
  tenon_library
  PROPERTIES OUTPUT_NAME tenon
             EXPORT_NAME tenon
             VERSION ${PROJECT_VERSION}
             SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
             LINKER_LANGUAGE CXX
             LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR}
             INSTALL_RPATH "$ORIGIN/tenon"
             LINK_DEPENDS ${PROJECT_SOURCE_DIR}/cmake/tenon.map)
target_link_libraries(tenon_library PRIVATE ${needs})
# Its own calls stay inside: inline functions that a program was compiled with, by other options,
# change no answer.
target_link_options(
  tenon_library PRIVATE LINKER:--version-script=${PROJECT_SOURCE_DIR}/cmake/tenon.map
                        LINKER:-Bsymbolic-functions LINKER:--no-undefined)
target_compile_features(tenon_library INTERFACE cxx_std_20)
target_include_directories(
  tenon_library
  INTERFACE "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>"
            "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")

# Worker and program over this library, for the Python package, which has the library anyway
# (tools/make_wheel.sh). The worker adds what only it calls.
set(only_worker $<TARGET_OBJECTS:tenon_mesh> $<TARGET_OBJECTS:tenon_mjcf>)
list(TRANSFORM only_worker REPLACE "(.+:tenon_mesh>)" "$<FILTER:\\1,INCLUDE,/assimp_scene>")
list(TRANSFORM only_worker REPLACE "(.+:tenon_mjcf>)" "$<FILTER:\\1,EXCLUDE,/write_>")
if(NOT TENON_WITH_MUJOCO)
  list(FILTER only_worker EXCLUDE REGEX tenon_mjcf)
endif()
tenon_worker_program(tenon_shared_worker EXCLUDE_FROM_ALL ${only_worker})
target_link_libraries(tenon_shared_worker PRIVATE tenon_flags tenon_library ${needs})
set_target_properties(
  tenon_shared_worker
  PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/shared_bin
             INSTALL_RPATH "$ORIGIN/../../${CMAKE_INSTALL_LIBDIR}")

if(TARGET tenon_cli_parts)
  add_executable(tenon_shared_cli EXCLUDE_FROM_ALL ${PROJECT_SOURCE_DIR}/cli/main.cpp
                                                   $<TARGET_OBJECTS:tenon_cli_parts>)
  if(TARGET tenon_live) # of the program alone
    target_sources(tenon_shared_cli PRIVATE $<TARGET_OBJECTS:tenon_live>
                                            $<TARGET_OBJECTS:tenon_serve>)
  endif()
  target_link_libraries(tenon_shared_cli PRIVATE tenon_flags tenon_library)
  target_compile_definitions(tenon_shared_cli PRIVATE TENON_VERSION="${PROJECT_VERSION}")
  set_target_properties(
    tenon_shared_cli
    PROPERTIES OUTPUT_NAME tenon RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/shared_bin
               INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
endif()
