# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# `make deb`: all that is installed as one Debian package under /usr: the command, the worker, the
# engines, the library and its headers. What it depends on is asked of the programs themselves.
if(NOT PROJECT_IS_TOP_LEVEL OR NOT TENON_INSTALL)
  return()
endif()
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME tenon)
set(CPACK_PACKAGE_VENDOR "tenon authors")
set(CPACK_PACKAGE_CONTACT "tenon authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "command and library for physics-ready USD assets")
set(CPACK_PACKAGE_DESCRIPTION
    "Opens USD assets with physics, tells what is in them, checks, edits, converts and
simulates them on MuJoCo, PhysX and Jolt. No part of OpenUSD is needed.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEB_COMPONENT_INSTALL OFF)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Where dpkg-shlibdeps finds what the package brings itself.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS
    ${PROJECT_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR}
    ${PROJECT_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR}/tenon)
if(tenon_coacd_library)
  list(APPEND CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${tenon_coacd_root}/coacd.libs)
endif()

# Libraries that are opened only when they are needed, so that no program names them: the package of
# each is recommended.
find_program(TENON_DPKG_QUERY dpkg-query)
mark_as_advanced(TENON_DPKG_QUERY)
foreach(target IN ITEMS tenon_assimp tenon_meshoptimizer tenon_nlopt)
  get_target_property(definitions ${target} INTERFACE_COMPILE_DEFINITIONS)
  if(TENON_DPKG_QUERY AND "${definitions}" MATCHES "SONAME=\"([^\"]+)\"")
    execute_process(COMMAND ${TENON_DPKG_QUERY} -S */${CMAKE_MATCH_1} OUTPUT_VARIABLE owner
                    ERROR_QUIET)
    if(owner MATCHES "^([^:, \n]+)")
      list(APPEND CPACK_DEBIAN_PACKAGE_RECOMMENDS ${CMAKE_MATCH_1})
    endif()
  endif()
endforeach()
list(JOIN CPACK_DEBIAN_PACKAGE_RECOMMENDS ", " CPACK_DEBIAN_PACKAGE_RECOMMENDS)
include(CPack)
