# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# Imported targets mujoco::headers, with which tenon is built (it opens the library when it needs
# it), and mujoco::mujoco, for programs that are linked to it.
#
# Default: the official binary wheel, pinned by hash in thirdparty/mujoco-requirements.txt, fetched
# once with pip into <TENON_FETCHED>/mujoco-<version>, 10 MB.
# Own MuJoCo: -DTENON_MUJOCO_DIR=<dir> with include/mujoco/mujoco.h and lib/libmujoco.so* (the
# layout of MuJoCo's release archives and of an installed source build).
include(cmake/wheel.cmake)
set(TENON_MUJOCO_VERSION 4.0.1)
set(TENON_MUJOCO_DIR "" CACHE PATH "Own MuJoCo (include/ and lib/); empty: fetch the pinned wheel")

# Puts include/, lib/ and licences of the pinned wheel into <destination>.
function(tenon_fetch_mujoco destination)
  find_program(TENON_PYTHON python3)
  set(advice "Install pip (apt-get install python3-pip), or give your own MuJoCo with "
             "-DTENON_MUJOCO_DIR=<dir>, or build without it: -DTENON_WITH_MUJOCO=OFF.")
  if(NOT TENON_PYTHON)
    message(FATAL_ERROR "MuJoCo ${TENON_MUJOCO_VERSION} is fetched with python3, not found. "
                        ${advice})
  endif()
  if(NOT CMAKE_SYSTEM_NAME STREQUAL Linux OR NOT CMAKE_SYSTEM_PROCESSOR MATCHES
                                             "^(x86_64|aarch64)$")
    message(FATAL_ERROR "No pinned MuJoCo for ${CMAKE_SYSTEM_NAME} ${CMAKE_SYSTEM_PROCESSOR}. "
                        "Give your own: -DTENON_MUJOCO_DIR=<dir>.")
  endif()
  message(STATUS "Fetching MuJoCo ${TENON_MUJOCO_VERSION} (10 MB, once)")
  set(work ${destination}.part)
  tenon_unpack_wheel(${PROJECT_SOURCE_DIR}/thirdparty/mujoco-requirements.txt cp311
                     manylinux_2_28_${CMAKE_SYSTEM_PROCESSOR} ${work} fault)
  if(fault)
    message(FATAL_ERROR "Could not fetch MuJoCo ${TENON_MUJOCO_VERSION}: ${fault}\n" ${advice})
  endif()
  file(GLOB libraries ${work}/unpacked/mujoco/libmujoco.so*)
  file(COPY ${work}/unpacked/mujoco/include DESTINATION ${work}/ready)
  file(COPY ${libraries} DESTINATION ${work}/ready/lib)
  tenon_copy_licences(${work} mujoco_core ${work}/ready/licences)
  file(RENAME ${work}/ready ${destination})
  file(REMOVE_RECURSE ${work})
endfunction()

if(TENON_MUJOCO_DIR)
  set(tenon_mujoco_root ${TENON_MUJOCO_DIR})
else()
  set(tenon_mujoco_root ${TENON_FETCHED}/mujoco-${TENON_MUJOCO_VERSION})
  tenon_fetch_once(tenon_fetch_mujoco ${tenon_mujoco_root} ${tenon_mujoco_root}/lib)
endif()

# The wheel holds libmujoco.so.<version> without the unversioned link: take the one real file.
file(GLOB tenon_mujoco_library ${tenon_mujoco_root}/lib/libmujoco.so*)
list(SORT tenon_mujoco_library COMPARE NATURAL ORDER DESCENDING)
if(NOT tenon_mujoco_library OR NOT EXISTS ${tenon_mujoco_root}/include/mujoco/mujoco.h)
  message(FATAL_ERROR "No MuJoCo in `${tenon_mujoco_root}`: need include/mujoco/mujoco.h and "
                      "lib/libmujoco.so*. Correct or clear TENON_MUJOCO_DIR.")
endif()
list(GET tenon_mujoco_library 0 tenon_mujoco_library)
file(GLOB tenon_mujoco_licences ${tenon_mujoco_root}/licences/*)
get_filename_component(tenon_mujoco_soname ${tenon_mujoco_library} NAME)
# What mujoco_library.cpp looks for.
set(tenon_mujoco_names TENON_MUJOCO_SONAME="${tenon_mujoco_soname}")

list(APPEND CMAKE_INSTALL_RPATH ${tenon_mujoco_root}/lib)  # of all that is built and not installed
add_library(mujoco::mujoco SHARED IMPORTED GLOBAL)
set_target_properties(mujoco::mujoco PROPERTIES IMPORTED_LOCATION ${tenon_mujoco_library}
                                                IMPORTED_SONAME ${tenon_mujoco_soname})
add_library(mujoco::headers INTERFACE IMPORTED GLOBAL)
target_include_directories(mujoco::headers SYSTEM INTERFACE ${tenon_mujoco_root}/include)
target_link_libraries(mujoco::mujoco INTERFACE mujoco::headers)
