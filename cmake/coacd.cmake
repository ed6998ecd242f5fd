# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
#
# tenon_coacd_library: path of lib_coacd.so, or empty. The program loads it when a mesh is to be
# taken apart and does without it, so that nothing here may stop a build.
#
# The official binary wheel, pinned by hash in thirdparty/coacd-requirements.txt, fetched once with
# pip into <TENON_FETCHED>/coacd-<version>, 3 MB.
include(cmake/wheel.cmake)
set(TENON_COACD_VERSION 1.0.14)
set(tenon_coacd_root ${TENON_FETCHED}/coacd-${TENON_COACD_VERSION})

# Puts coacd/ and coacd.libs/ of the pinned wheel and its licence into <destination>.
function(tenon_fetch_coacd destination)
  find_program(TENON_PYTHON python3)
  if(NOT TENON_PYTHON OR NOT CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|aarch64)$")
    return()
  endif()
  message(STATUS "Fetching CoACD ${TENON_COACD_VERSION} (3 MB, once)")
  set(work ${destination}.part)
  tenon_unpack_wheel(${PROJECT_SOURCE_DIR}/thirdparty/coacd-requirements.txt abi3
                     manylinux2014_${CMAKE_SYSTEM_PROCESSOR} ${work} fault)
  if(fault)
    message(STATUS "Without CoACD: meshes are not taken apart; ${fault}")
    return()
  endif()
  file(COPY ${work}/unpacked/coacd/lib_coacd.so DESTINATION ${work}/ready/coacd)
  file(COPY ${work}/unpacked/coacd.libs DESTINATION ${work}/ready)
  tenon_copy_licences(${work} coacd ${work}/ready/licences)
  file(RENAME ${work}/ready ${destination})
  file(REMOVE_RECURSE ${work})
endfunction()

set(tenon_coacd_library "")
if(TENON_WITH_COACD AND CMAKE_SYSTEM_NAME STREQUAL Linux)
  tenon_fetch_once(tenon_fetch_coacd ${tenon_coacd_root} ${tenon_coacd_root}/coacd)
  if(EXISTS ${tenon_coacd_root}/coacd/lib_coacd.so)
    set(tenon_coacd_library ${tenon_coacd_root}/coacd/lib_coacd.so)
  endif()
endif()
