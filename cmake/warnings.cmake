# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# Flags of every target of this project. -ffp-contract=off: equal bytes on every machine.
add_library(tenon_flags INTERFACE)
# A newer GCC than that of continuous integration (Debian 12) warns of more; nobody's `make test` is
# to fail for that.
set(tenon_werror ${TENON_WERROR})
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 13)
  set(tenon_werror OFF)
endif()
# A tenth of the time to compile goes into warnings, which nobody who only tries the program reads.
if(TENON_QUICK)
  set(tenon_warnings -w)
  set(tenon_garbage 4000000)
else()
  set(tenon_garbage 600000)
  set(tenon_warnings -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wold-style-cast)
endif()
target_compile_options(
  tenon_flags
  INTERFACE -ffp-contract=off
            ${tenon_warnings}
            # Clang counts changes of sign to -Wconversion, and warns of what GCC's own headers use.
            $<$<CXX_COMPILER_ID:Clang>:-Wno-sign-conversion>
            $<$<CXX_COMPILER_ID:Clang>:-Wno-deprecated-declarations>
            $<$<BOOL:${tenon_werror}>:-Werror>
            # GCC collects garbage once it holds 1.2 GB, which no source needs (4 GB with
            # TENON_QUICK): from 256 MB on, that takes a tenth of its time.
            $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=${tenon_garbage}>)
target_include_directories(tenon_flags INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_features(tenon_flags INTERFACE cxx_std_20)
if(CMAKE_SIZEOF_VOID_P EQUAL 4)
  # Files of 2 GB and more have their size there, too.
  target_compile_definitions(tenon_flags INTERFACE _FILE_OFFSET_BITS=64)
endif()
