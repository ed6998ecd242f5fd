# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# Imported target physx::headers, with which the adapter is built; it opens the library when it
# needs it. The sources come with the crate physx-sys (24 MB), which wraps PhysX for Rust and is
# where PhysX can be had from a package client; they are built once, in 2 to 4 minutes, to
# <TENON_ENGINE_CACHE>/physx-<version>-<what it was built from and with>.
include(crate)
include(wheel)
set(TENON_PHYSX_VERSION 5.1.3)

set(tenon_physx_key ${CMAKE_CXX_COMPILER_ID}${CMAKE_CXX_COMPILER_VERSION}${CMAKE_SYSTEM_PROCESSOR})
foreach(file thirdparty/physx/CMakeLists.txt thirdparty/physx/functions.cpp
        thirdparty/physx/friction.cpp thirdparty/physx/friction.h
        tenon/engines/physx/physx_functions.h tenon/engines/physx/physx_headers.h)
  file(READ ${PROJECT_SOURCE_DIR}/${file} tenon_physx_text)
  string(APPEND tenon_physx_key "${tenon_physx_text}")
endforeach()
string(SHA256 tenon_physx_key "${tenon_physx_key}")
string(SUBSTRING ${tenon_physx_key} 0 12 tenon_physx_key)
set(tenon_physx_root ${TENON_ENGINE_CACHE}/physx-${TENON_PHYSX_VERSION}-${tenon_physx_key})

function(tenon_make_physx destination)
  set(advice "PhysX is fetched with cargo (apt-get install cargo). Build without it: "
             "-DTENON_WITH_PHYSX=OFF.")
  message(STATUS "Fetching and building PhysX ${TENON_PHYSX_VERSION} (2 to 4 minutes, once)")
  set(work ${TENON_ENGINE_CACHE}/physx)  # the same for every key, so that ccache knows it again
  file(LOCK ${work}.lock GUARD FUNCTION TIMEOUT 1200)
  tenon_fetch_crate(physx-sys 0.11.5
                    6e5201d76c6786a8770f7bf5da2f244aa16708708d68e7fa2a2bab440270758a
                    ${work}.source fault REPLACE bitflags@1.3.2 cc@1.0.0+parallel)
  if(NOT fault)
    tenon_build_engine(${PROJECT_SOURCE_DIR}/thirdparty/physx ${work} ${destination} fault)
  endif()
  if(fault)
    message(FATAL_ERROR "No PhysX ${TENON_PHYSX_VERSION}: ${fault}\n" ${advice})
  endif()
  file(REMOVE_RECURSE ${work}.source)
endfunction()
tenon_fetch_once(tenon_make_physx ${tenon_physx_root} ${tenon_physx_root}/lib)

add_library(physx::headers INTERFACE IMPORTED GLOBAL)
target_include_directories(physx::headers SYSTEM INTERFACE ${tenon_physx_root}/include)
set(tenon_physx_library ${tenon_physx_root}/lib/libtenon_physx.so)
set(tenon_physx_names TENON_PHYSX_SONAME="libtenon_physx.so")
list(APPEND CMAKE_INSTALL_RPATH ${tenon_physx_root}/lib)  # of all that is built and not installed
