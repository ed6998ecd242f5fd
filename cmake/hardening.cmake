# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# What makes a memory fault in the program harder to use: all addresses random (PIE), relocations
# bound at the start and read-only from then on, no stack that can run code, canaries before return
# addresses, checked copies of the C library. tests/release/hardening.py reads what is installed.
#
# Sanitizers and coverage bring their own and stay without; a build without optimisation cannot have
# checked copies, and `make demo` (TENON_QUICK) is to be there soon: docs/installing.md says so.
include(CheckPIESupported)
include(CheckCXXSourceCompiles)
check_pie_supported()

if(TENON_QUICK OR TENON_SANITIZE OR TENON_SANITIZE_THREADS OR TENON_COVERAGE)
  return()
endif()

add_compile_options(-fstack-protector-strong)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|aarch64)$")
  add_compile_options(-fstack-clash-protection)
endif()
add_link_options(-Wl,-z,relro -Wl,-z,now -Wl,-z,noexecstack)

# Level 3 checks sizes that are known only at run time; older compilers and libraries have 2.
set(CMAKE_REQUIRED_FLAGS "-O2 -Werror -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=3")
check_cxx_source_compiles("#include <cstring>\nint main() {}" TENON_FORTIFY_3)
unset(CMAKE_REQUIRED_FLAGS)
if(TENON_FORTIFY_3)
  set(tenon_fortify 3)
else()
  set(tenon_fortify 2)
endif()
add_compile_options(
  "$<$<NOT:$<CONFIG:Debug>>:SHELL:-U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=${tenon_fortify}>")
