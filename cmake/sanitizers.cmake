# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# Sanitizers and coverage are set for the whole tree: mixing instrumented and plain code of one
# program gives false reports with standard containers.
if(TENON_SANITIZE)
  # The library has no run-time type information, so its objects cannot be checked for it (vptr).
  set(tenon_unchecked vptr)
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    # Two fifths of GCC's time for what the address sanitizer stops (null) or this processor allows
    # (alignment). The preset `fuzz`, with clang, checks both.
    string(APPEND tenon_unchecked ,null,alignment)
  endif()
  add_compile_options(-fsanitize=address,undefined -fno-sanitize=${tenon_unchecked}
                      -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    # libasan.so calls dlopen in place of the program, and the loader then searches the library
    # folders of libasan.so, where no engine is. Clang links it statically by itself.
    add_link_options(-static-libasan)
  endif()
endif()
if(TENON_SANITIZE_THREADS)
  add_compile_options(-fsanitize=thread -fno-omit-frame-pointer)
  add_link_options(-fsanitize=thread)
endif()
if(TENON_COVERAGE)
  add_compile_options(--coverage)
  add_link_options(--coverage)
endif()
if(TENON_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES Clang)
    message(FATAL_ERROR "TENON_FUZZ needs clang (libFuzzer); use the preset `fuzz`.")
  endif()
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()
