# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# Installs the licence of every library that is compiled in, linked or loaded. Debian keeps that of
# each package in /usr/share/doc; the package is the one that owns a file of the library.
# tests/release/licences.py holds the list to what the build really uses.

# tenon_licence(<name> <file of the library>): to share/doc/tenon/<name>/copyright.
function(tenon_licence name file)
  find_program(TENON_DPKG_QUERY dpkg-query)
  mark_as_advanced(TENON_DPKG_QUERY)
  if(NOT TENON_DPKG_QUERY OR NOT EXISTS "${file}")
    message(STATUS "No licence of ${name} is installed: no Debian package of `${file}`")
    return()
  endif()
  # A path that dpkg knows: /lib may be a link to /usr/lib.
  get_filename_component(real ${file} REALPATH)
  foreach(place IN ITEMS ${file} ${real})
    execute_process(COMMAND ${TENON_DPKG_QUERY} -S ${place} OUTPUT_VARIABLE owner ERROR_QUIET)
    string(REGEX MATCH "^[^:, \n]+" package "${owner}")
    if(package)
      break()
    endif()
  endforeach()
  set(licence /usr/share/doc/${package}/copyright)
  if(NOT package OR NOT EXISTS ${licence})
    message(STATUS "No licence of ${name} is installed: no ${licence}")
    return()
  endif()
  install(FILES ${licence} DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/tenon/${name})
endfunction()

tenon_licence(eigen ${EIGEN3_INCLUDE_DIR}/Eigen/Core)
if(TENON_PROGRAM)
  find_path(TENON_CLI11_INCLUDE_DIR CLI/CLI.hpp)
  tenon_licence(cli11 ${TENON_CLI11_INCLUDE_DIR}/CLI/CLI.hpp)
endif()
find_path(TENON_JSON_INCLUDE_DIR nlohmann/json.hpp)
tenon_licence(nlohmann-json ${TENON_JSON_INCLUDE_DIR}/nlohmann/json.hpp)
tenon_licence(lz4 ${TENON_LZ4_INCLUDE_DIR}/lz4.h)
tenon_licence(qhull ${TENON_QHULL_INCLUDE_DIR}/libqhull_r/libqhull_r.h)
tenon_licence(pugixml ${TENON_PUGIXML_INCLUDE_DIR}/pugixml.hpp)
if(TENON_WITH_VIEW)
  tenon_licence(boost ${TENON_BOOST_INCLUDE_DIR}/boost/version.hpp)
endif()
tenon_licence(meshoptimizer ${TENON_MESHOPTIMIZER_INCLUDE_DIR}/meshoptimizer.h)
if(TENON_ZLIB_INCLUDE_DIR)
  tenon_licence(zlib ${TENON_ZLIB_INCLUDE_DIR}/zlib.h)
endif()
if(TENON_ASSIMP_INCLUDE_DIR)
  tenon_licence(assimp ${TENON_ASSIMP_INCLUDE_DIR}/assimp/cimport.h)
endif()
mark_as_advanced(TENON_CLI11_INCLUDE_DIR TENON_JSON_INCLUDE_DIR)
# The C++ library stands in the program itself (-static-libstdc++).
execute_process(COMMAND ${CMAKE_CXX_COMPILER} -print-file-name=libstdc++.a
                OUTPUT_VARIABLE tenon_libstdcxx OUTPUT_STRIP_TRAILING_WHITESPACE)
get_filename_component(tenon_libstdcxx "${tenon_libstdcxx}" REALPATH)
tenon_licence(libstdc++ ${tenon_libstdcxx})
