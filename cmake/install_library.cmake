# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# The library for programs outside: libtenon.so, its headers, and what find_package(tenon) and
# pkg-config read. Nothing in them names an absolute path, so that the prefix may be moved.
include(CMakePackageConfigHelpers)
include(public_headers)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME development)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/tenon)
set(made_folder ${PROJECT_BINARY_DIR}/package)

install(TARGETS tenon_library EXPORT tenon LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
        COMPONENT runtime NAMELINK_COMPONENT development)
install(EXPORT tenon NAMESPACE tenon:: FILE tenon-targets.cmake DESTINATION ${package_folder})
file(CONFIGURE OUTPUT ${made_folder}/tenon-config.cmake CONTENT
     "include(\${CMAKE_CURRENT_LIST_DIR}/tenon-targets.cmake)\n" @ONLY)
write_basic_package_version_file(${made_folder}/tenon-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${made_folder}/tenon-config.cmake ${made_folder}/tenon-config-version.cmake
        DESTINATION ${package_folder})

file(RELATIVE_PATH up /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
file(CONFIGURE OUTPUT ${made_folder}/tenon.pc CONTENT [[
prefix=${pcfiledir}/@up@
includedir=${prefix}/@CMAKE_INSTALL_INCLUDEDIR@
libdir=${prefix}/@CMAKE_INSTALL_LIBDIR@

Name: tenon
Description: @PROJECT_DESCRIPTION@
Version: @PROJECT_VERSION@
Cflags: -I${includedir}
Libs: -L${libdir} -ltenon
]] @ONLY)
install(FILES ${made_folder}/tenon.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

tenon_public_headers(headers)
foreach(header IN LISTS headers)
  get_filename_component(folder ${header} DIRECTORY)
  install(FILES ${PROJECT_SOURCE_DIR}/${header}
          DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/${folder})
endforeach()
