# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# Packages of the system; tools/bootstrap.sh installs them, docs/dependencies.md says why each.
find_package(Threads REQUIRED)
find_package(Eigen3 3.3 REQUIRED NO_MODULE)
if(TENON_PROGRAM)
  find_package(CLI11 REQUIRED)
endif()
find_package(nlohmann_json 3.9 REQUIRED)

find_path(TENON_LZ4_INCLUDE_DIR lz4.h)
find_library(TENON_LZ4_LIBRARY lz4)
if(NOT TENON_LZ4_INCLUDE_DIR OR NOT TENON_LZ4_LIBRARY)
  message(FATAL_ERROR "lz4 not found: install liblz4-dev (tools/bootstrap.sh).")
endif()
add_library(tenon_lz4 INTERFACE)
target_include_directories(tenon_lz4 SYSTEM INTERFACE ${TENON_LZ4_INCLUDE_DIR})
target_link_libraries(tenon_lz4 INTERFACE ${TENON_LZ4_LIBRARY})

find_path(TENON_QHULL_INCLUDE_DIR libqhull_r/libqhull_r.h)
find_library(TENON_QHULL_LIBRARY qhull_r)
if(NOT TENON_QHULL_INCLUDE_DIR OR NOT TENON_QHULL_LIBRARY)
  message(FATAL_ERROR "qhull not found: install libqhull-dev (tools/bootstrap.sh).")
endif()
add_library(tenon_qhull INTERFACE)
target_include_directories(tenon_qhull SYSTEM INTERFACE ${TENON_QHULL_INCLUDE_DIR})
target_link_libraries(tenon_qhull INTERFACE ${TENON_QHULL_LIBRARY})

find_path(TENON_PUGIXML_INCLUDE_DIR pugixml.hpp)
find_library(TENON_PUGIXML_LIBRARY NAMES libpugixml.a pugixml)
if(NOT TENON_PUGIXML_INCLUDE_DIR OR NOT TENON_PUGIXML_LIBRARY)
  message(FATAL_ERROR "pugixml not found: install libpugixml-dev (tools/bootstrap.sh).")
endif()
add_library(tenon_pugixml INTERFACE)
target_include_directories(tenon_pugixml SYSTEM INTERFACE ${TENON_PUGIXML_INCLUDE_DIR})
target_link_libraries(tenon_pugixml INTERFACE ${TENON_PUGIXML_LIBRARY})

# Loaded at run time when a mesh needs it; only its headers count here.
find_path(TENON_ASSIMP_INCLUDE_DIR assimp/cimport.h)
add_library(tenon_assimp INTERFACE)
if(TENON_ASSIMP_INCLUDE_DIR)
  target_include_directories(tenon_assimp SYSTEM INTERFACE ${TENON_ASSIMP_INCLUDE_DIR})
  target_compile_definitions(tenon_assimp INTERFACE TENON_WITH_ASSIMP=1
                                                    TENON_ASSIMP_SONAME="libassimp.so.5")
else()
  message(STATUS "assimp not found (libassimp-dev): .dae, .gltf and .glb meshes are not read")
  target_compile_definitions(tenon_assimp INTERFACE TENON_WITH_ASSIMP=0)
endif()
find_path(TENON_MESHOPTIMIZER_INCLUDE_DIR meshoptimizer.h)
find_library(TENON_MESHOPTIMIZER_LIBRARY meshoptimizer)
if(NOT TENON_MESHOPTIMIZER_INCLUDE_DIR OR NOT TENON_MESHOPTIMIZER_LIBRARY)
  message(FATAL_ERROR "meshoptimizer not found: install libmeshoptimizer-dev "
                      "(tools/bootstrap.sh).")
endif()
add_library(tenon_meshoptimizer INTERFACE)
target_include_directories(tenon_meshoptimizer SYSTEM
                           INTERFACE ${TENON_MESHOPTIMIZER_INCLUDE_DIR})
# Opened at run time too, by the name that programs are linked to.
execute_process(COMMAND ${CMAKE_OBJDUMP} -p ${TENON_MESHOPTIMIZER_LIBRARY}
                OUTPUT_VARIABLE tenon_dynamic ERROR_QUIET)
string(REGEX MATCH "SONAME +([^ \n]+)" tenon_dynamic "${tenon_dynamic}")
if(NOT CMAKE_MATCH_1)
  message(FATAL_ERROR "`${TENON_MESHOPTIMIZER_LIBRARY}` is no shared library with a name "
                      "of its own (SONAME): install libmeshoptimizer-dev (tools/bootstrap.sh).")
endif()
target_compile_definitions(tenon_meshoptimizer
                           INTERFACE TENON_MESHOPTIMIZER_SONAME="${CMAKE_MATCH_1}")

# Opened at run time, when a report is made.
find_path(TENON_ZLIB_INCLUDE_DIR zlib.h)
add_library(tenon_zlib INTERFACE)
if(TENON_ZLIB_INCLUDE_DIR)
  target_include_directories(tenon_zlib SYSTEM INTERFACE ${TENON_ZLIB_INCLUDE_DIR})
  target_compile_definitions(tenon_zlib INTERFACE TENON_WITH_ZLIB=1)
else()
  message(STATUS "zlib not found (zlib1g-dev): reports are larger")
  target_compile_definitions(tenon_zlib INTERFACE TENON_WITH_ZLIB=0)
endif()

# Opened at run time, when gains are searched (tenon/tuning/optimizer.cpp); nothing of it is needed
# to compile. Here for its licence and for the packages that are made.
find_library(TENON_NLOPT_LIBRARY NAMES libnlopt.so.0 libnlopt.so.1)
mark_as_advanced(TENON_NLOPT_LIBRARY)
add_library(tenon_nlopt INTERFACE)
if(TENON_NLOPT_LIBRARY)
  get_filename_component(tenon_nlopt_name ${TENON_NLOPT_LIBRARY} NAME)
  target_compile_definitions(tenon_nlopt INTERFACE TENON_NLOPT_SONAME="${tenon_nlopt_name}")
endif()

# Reads tenon.toml; headers alone. Ubuntu 22.04 has no package of it.
find_path(TENON_TOML_INCLUDE_DIR toml++/toml.h)
add_library(tenon_toml INTERFACE)
if(TENON_TOML_INCLUDE_DIR)
  target_include_directories(tenon_toml SYSTEM INTERFACE ${TENON_TOML_INCLUDE_DIR})
  target_compile_definitions(tenon_toml INTERFACE TENON_WITH_TOML=1)
else()
  message(STATUS "toml++ not found (libtomlplusplus-dev): assets with a tenon.toml are refused")
  target_compile_definitions(tenon_toml INTERFACE TENON_WITH_TOML=0)
endif()

# Of the server behind `tenon view`; headers alone.
if(TENON_WITH_VIEW)
  find_path(TENON_BOOST_INCLUDE_DIR boost/beast.hpp)
  if(TENON_BOOST_INCLUDE_DIR)
    add_library(tenon_boost INTERFACE)
    target_include_directories(tenon_boost SYSTEM INTERFACE ${TENON_BOOST_INCLUDE_DIR})
    target_link_libraries(tenon_boost INTERFACE Threads::Threads)
    if(TENON_SANITIZE_THREADS)
      # The thread sanitizer knows locks, which suffice here, and no fences.
      target_compile_definitions(tenon_boost INTERFACE BOOST_ASIO_DISABLE_FENCED_BLOCK)
    endif()
  else()
    message(STATUS "Boost not found (libboost-dev): without tenon view")
    set(TENON_WITH_VIEW OFF)
  endif()
endif()

if(TENON_DEVELOPER)
  find_package(GTest REQUIRED)
endif()
