# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# Sanitizers and coverage are set for the whole tree: mixing instrumented and plain code of one
# program gives false reports with standard containers.
if(TENON_SANITIZE)
  # The library has no run-time type information, so its objects cannot be checked for it (vptr).
  add_compile_options(-fsanitize=address,undefined -fno-sanitize=vptr -fno-sanitize-recover=all
                      -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
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
if(TENON_TIDY)
  find_program(TENON_CLANG_TIDY NAMES clang-tidy-19 clang-tidy REQUIRED)
  set(CMAKE_CXX_CLANG_TIDY ${TENON_CLANG_TIDY} --quiet)
endif()
