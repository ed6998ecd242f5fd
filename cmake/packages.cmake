# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# Packages of the system; tools/bootstrap.sh installs them, docs/dependencies.md says why each.
find_package(Threads REQUIRED)
find_package(Eigen3 3.3 REQUIRED NO_MODULE)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json 3.9 REQUIRED)
find_package(tl-expected QUIET)
find_path(TENON_EXPECTED_INCLUDE_DIR tl/expected.hpp)
if(NOT TENON_EXPECTED_INCLUDE_DIR)
  message(FATAL_ERROR "tl/expected.hpp not found: install libexpected-dev (tools/bootstrap.sh).")
endif()

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

if(TENON_DEVELOPER)
  find_package(GTest REQUIRED)
endif()
