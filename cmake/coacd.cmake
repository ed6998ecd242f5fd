# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
#
# tenon_coacd_library: path of lib_coacd.so, or empty. The program loads it when a mesh is to be
# taken apart and does without it, so that nothing here may stop a build.
#
# The official binary wheel, pinned by hash in thirdparty/coacd-requirements.txt, fetched once with
# pip into build/_deps/coacd-<version> (shared by all presets), 3 MB.
set(TENON_COACD_VERSION 1.0.14)
set(tenon_coacd_root ${PROJECT_SOURCE_DIR}/build/_deps/coacd-${TENON_COACD_VERSION})

# Puts coacd/ and coacd.libs/ of the pinned wheel and its licence into <destination>.
function(tenon_fetch_coacd destination)
  find_program(TENON_PYTHON python3)
  if(NOT TENON_PYTHON OR NOT CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|aarch64)$")
    return()
  endif()
  message(STATUS "Fetching CoACD ${TENON_COACD_VERSION} (3 MB, once)")
  set(work ${destination}.part)
  file(REMOVE_RECURSE ${work})
  file(MAKE_DIRECTORY ${work})
  execute_process(
    COMMAND
      ${TENON_PYTHON} -m pip download --quiet --disable-pip-version-check --no-deps
      --only-binary=:all: --require-hashes --implementation cp --python-version 311 --abi abi3
      --platform manylinux2014_${CMAKE_SYSTEM_PROCESSOR} --dest ${work}/wheel -r
      ${PROJECT_SOURCE_DIR}/thirdparty/coacd-requirements.txt
    RESULT_VARIABLE status
    ERROR_VARIABLE reason)
  file(GLOB wheel ${work}/wheel/*.whl)
  if(NOT status EQUAL 0 OR NOT wheel)
    message(STATUS "Without CoACD: meshes are not taken apart. pip said:\n${reason}")
    return()
  endif()
  file(ARCHIVE_EXTRACT INPUT ${wheel} DESTINATION ${work}/unpacked)
  file(GLOB licences ${work}/unpacked/coacd-*.dist-info/LICENSE*
       ${work}/unpacked/coacd-*.dist-info/licenses/LICENSE*)
  file(COPY ${work}/unpacked/coacd/lib_coacd.so DESTINATION ${work}/ready/coacd)
  file(COPY ${work}/unpacked/coacd.libs DESTINATION ${work}/ready)
  file(COPY ${licences} DESTINATION ${work}/ready/licences)
  file(RENAME ${work}/ready ${destination})
  file(REMOVE_RECURSE ${work})
endfunction()

set(tenon_coacd_library "")
if(TENON_WITH_COACD AND CMAKE_SYSTEM_NAME STREQUAL Linux)
  if(NOT EXISTS ${tenon_coacd_root}/coacd)
    file(MAKE_DIRECTORY ${PROJECT_SOURCE_DIR}/build/_deps)
    file(LOCK ${PROJECT_SOURCE_DIR}/build/_deps/coacd.lock GUARD FILE TIMEOUT 300)
    if(NOT EXISTS ${tenon_coacd_root}/coacd)
      tenon_fetch_coacd(${tenon_coacd_root})
    endif()
    file(LOCK ${PROJECT_SOURCE_DIR}/build/_deps/coacd.lock RELEASE)
  endif()
  if(EXISTS ${tenon_coacd_root}/coacd/lib_coacd.so)
    set(tenon_coacd_library ${tenon_coacd_root}/coacd/lib_coacd.so)
  endif()
endif()
