# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# Imported target jolt::jolt, with which the adapter is built and linked. The sources come with the
# crate joltc-sys (11 MB), which wraps Jolt for Rust and is where Jolt can be had from a package
# client; they are built once, in 2 to 5 minutes, to
# <TENON_ENGINE_CACHE>/jolt-<version>-<what it was built from and with>.
include(crate)
include(wheel)
set(TENON_JOLT_VERSION 5.0.0)
include(${PROJECT_SOURCE_DIR}/thirdparty/jolt/definitions.cmake)

set(tenon_jolt_key ${CMAKE_CXX_COMPILER_ID}${CMAKE_CXX_COMPILER_VERSION}${CMAKE_SYSTEM_PROCESSOR})
foreach(file CMakeLists.txt definitions.cmake)
  file(READ ${PROJECT_SOURCE_DIR}/thirdparty/jolt/${file} tenon_jolt_text)
  string(APPEND tenon_jolt_key "${tenon_jolt_text}")
endforeach()
string(SHA256 tenon_jolt_key "${tenon_jolt_key}")
string(SUBSTRING ${tenon_jolt_key} 0 12 tenon_jolt_key)
set(tenon_jolt_root ${TENON_ENGINE_CACHE}/jolt-${TENON_JOLT_VERSION}-${tenon_jolt_key})

function(tenon_make_jolt destination)
  set(advice "Jolt is fetched with cargo (apt-get install cargo). Build without it: "
             "-DTENON_WITH_JOLT=OFF.")
  message(STATUS "Fetching and building Jolt ${TENON_JOLT_VERSION} (2 to 5 minutes, once)")
  set(work ${TENON_ENGINE_CACHE}/jolt)  # the same for every key, so that ccache knows it again
  file(LOCK ${work}.lock GUARD FUNCTION TIMEOUT 1200)
  tenon_fetch_crate(joltc-sys 0.3.1+Jolt-5.0.0
                    846f2354e51c0a8214e687fc22a676e8cae894fd2ea647d3e5bb511583c4b297
                    ${work}.source fault REPLACE anyhow@1.0.82 bindgen@0.69.4
                    cc@1.0.96+parallel cmake@0.1.50 walkdir@2.5.0)
  if(NOT fault)
    tenon_build_engine(${PROJECT_SOURCE_DIR}/thirdparty/jolt ${work} ${destination} fault)
  endif()
  if(fault)
    message(FATAL_ERROR "No Jolt ${TENON_JOLT_VERSION}: ${fault}\n" ${advice})
  endif()
  file(REMOVE_RECURSE ${work}.source)
endfunction()
tenon_fetch_once(tenon_make_jolt ${tenon_jolt_root} ${tenon_jolt_root}/lib)

find_package(Threads REQUIRED)
add_library(jolt::jolt STATIC IMPORTED GLOBAL)
set_target_properties(jolt::jolt PROPERTIES
  IMPORTED_LOCATION ${tenon_jolt_root}/lib/libtenon_jolt.a
  INTERFACE_LINK_LIBRARIES Threads::Threads)
target_include_directories(jolt::jolt SYSTEM INTERFACE ${tenon_jolt_root}/include)
target_compile_definitions(jolt::jolt INTERFACE ${TENON_JOLT_DEFINITIONS})
