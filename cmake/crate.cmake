# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
#
# Engines in C++ that are published as crates, fetched with cargo, pinned by the hash of the crate,
# built once and kept outside of the source: in TENON_ENGINE_CACHE.
if(DEFINED ENV{XDG_CACHE_HOME})
  set(tenon_cache $ENV{XDG_CACHE_HOME})
else()
  set(tenon_cache $ENV{HOME}/.cache)
endif()
set(TENON_ENGINE_CACHE ${tenon_cache}/tenon/engines CACHE PATH "Where built engines are kept")

# Puts the sources of crate <name> <version>, whose hash is <sha256>, into <destination>.
# REPLACE <crate>@<version>[+<feature>]...: crates for its own build with cargo, which are not
# needed here; empty ones take their place. ${<fault>} says why that failed, else it is empty.
function(tenon_fetch_crate name version sha256 destination fault)
  cmake_parse_arguments(PARSE_ARGV 5 arg "" "" "REPLACE")
  find_program(TENON_CARGO cargo)
  if(NOT TENON_CARGO)
    set(${fault} "cargo is not found" PARENT_SCOPE)
    return()
  endif()
  set(work ${destination}.crate)
  file(REMOVE_RECURSE ${work} ${destination})
  set(head "version = \"0.0.0\"\nedition = \"2018\"\n[lib]\npath = \"lib.rs\"\n")
  set(manifest "[package]\nname = \"fetch\"\n${head}[dependencies]\n${name} = \"=${version}\"\n")
  string(APPEND manifest "[patch.crates-io]\n")
  foreach(entry IN LISTS arg_REPLACE)
    string(REGEX MATCH "^([^@]+)@([^+]+)[+]?(.*)$" unused ${entry})
    set(empty ${CMAKE_MATCH_1})
    string(REPLACE "0.0.0" ${CMAKE_MATCH_2} empty_head "${head}")
    set(features "")
    if(CMAKE_MATCH_3)
      set(features "[features]\n${CMAKE_MATCH_3} = []\n")
    endif()
    file(WRITE ${work}/${empty}/Cargo.toml
         "[package]\nname = \"${empty}\"\n${empty_head}${features}")
    file(WRITE ${work}/${empty}/lib.rs "")
    string(APPEND manifest "${empty} = { path = \"${empty}\" }\n")
  endforeach()
  file(WRITE ${work}/Cargo.toml "${manifest}")
  file(WRITE ${work}/lib.rs "")
  execute_process(COMMAND ${TENON_CARGO} vendor --quiet --versioned-dirs vendor
                  WORKING_DIRECTORY ${work} RESULT_VARIABLE status ERROR_VARIABLE reason
                  OUTPUT_QUIET)
  set(crate ${work}/vendor/${name}-${version})
  if(NOT status EQUAL 0 OR NOT EXISTS ${crate})
    set(${fault} "cargo said: ${reason}" PARENT_SCOPE)
    return()
  endif()
  file(STRINGS ${crate}/.cargo-checksum.json found REGEX "\"package\":\"${sha256}\"")
  if(NOT found)
    set(${fault} "the crate ${name} ${version} is not the one that is pinned" PARENT_SCOPE)
    return()
  endif()
  file(RENAME ${crate} ${destination})
  file(REMOVE_RECURSE ${work})
  set(${fault} "" PARENT_SCOPE)
endfunction()

# Builds the project <source> with the crate in <work>.source, which it finds in TENON_CRATE, and
# installs it to <destination>.
function(tenon_build_engine source work destination fault)
  include(ProcessorCount)
  ProcessorCount(processors)
  execute_process(
    COMMAND ${CMAKE_COMMAND} -G ${CMAKE_GENERATOR} -S ${source} -B ${work}.build
            -DTENON_CRATE=${work}.source -DCMAKE_BUILD_TYPE=Release
            -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}
            -DCMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER}
            -DCMAKE_INSTALL_PREFIX=${destination}.part -DCMAKE_INSTALL_LIBDIR=lib
    RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(status EQUAL 0)
    execute_process(
      COMMAND ${CMAKE_COMMAND} --build ${work}.build --parallel ${processors}
              --target install
      RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said)
  endif()
  if(NOT status EQUAL 0)
    string(LENGTH "${said}" length)
    if(length GREATER 2000)
      math(EXPR start "${length} - 2000")
      string(SUBSTRING "${said}" ${start} -1 said)
    endif()
    set(${fault} "${said}" PARENT_SCOPE)
    return()
  endif()
  file(REMOVE_RECURSE ${destination} ${work}.build)
  file(RENAME ${destination}.part ${destination})
  set(${fault} "" PARENT_SCOPE)
endfunction()
