# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
#
# Libraries out of binary wheels, pinned by hash, fetched once with pip into TENON_FETCHED: the
# folder build/_deps of the source, which all presets share; as a part of another project its own
# build folder.
if(PROJECT_IS_TOP_LEVEL)
  set(TENON_FETCHED ${PROJECT_SOURCE_DIR}/build/_deps)
else()
  set(TENON_FETCHED ${PROJECT_BINARY_DIR}/_deps)
endif()

# Runs <fetch>(<destination>) unless <proof> is there; configures that run beside each other wait.
function(tenon_fetch_once fetch destination proof)
  if(EXISTS ${proof})
    return()
  endif()
  get_filename_component(folder ${destination} DIRECTORY)
  file(MAKE_DIRECTORY ${folder})
  file(LOCK ${destination}.lock GUARD FUNCTION TIMEOUT 300)
  if(NOT EXISTS ${proof})
    cmake_language(CALL ${fetch} ${destination})
  endif()
endfunction()

# Unpacks the one wheel of <requirements> for an ABI tag of Python 3.11 and a platform into
# <work>/unpacked; ${<fault>} says why that failed, else it is empty.
function(tenon_unpack_wheel requirements abi platform work fault)
  find_program(TENON_PYTHON python3)
  file(REMOVE_RECURSE ${work})
  file(MAKE_DIRECTORY ${work})
  execute_process(
    COMMAND
      ${TENON_PYTHON} -m pip download --quiet --disable-pip-version-check --no-deps
      --only-binary=:all: --require-hashes --implementation cp --python-version 311 --abi ${abi}
      --platform ${platform} --dest ${work}/wheel -r ${requirements}
    RESULT_VARIABLE status
    ERROR_VARIABLE reason)
  file(GLOB wheel ${work}/wheel/*.whl)
  if(NOT status EQUAL 0 OR NOT wheel)
    set(${fault} "pip said: ${reason}" PARENT_SCOPE)
    return()
  endif()
  file(ARCHIVE_EXTRACT INPUT ${wheel} DESTINATION ${work}/unpacked)
  set(${fault} "" PARENT_SCOPE)
endfunction()

# Copies the licences of the unpacked wheel of <project> to <destination>.
function(tenon_copy_licences work project destination)
  file(GLOB licences ${work}/unpacked/${project}-*.dist-info/LICENSE*
       ${work}/unpacked/${project}-*.dist-info/licenses/LICENSE*)
  file(COPY ${licences} DESTINATION ${destination})
endfunction()
