# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
#
# The page of `tenon view` and `tenon report` (page/): the target tenon_page bundles it into
# <build>/share/tenon/page, where the program finds it. Its packages are pinned with their hashes by
# page/package-lock.json and fetched once with npm into <TENON_FETCHED>/page-<hash of that file>.
# Without node and npm there is no page: the build goes on, and the program says how to get it.
# TENON_PAGE_FOLDER is the folder of the bundled page, or empty; TENON_PAGE_SOURCES the folder with
# the sources and their packages, for the check of types; TENON_PAGE_PACKAGES the folder of the
# packages alone, or empty.
include(cmake/wheel.cmake)
option(TENON_PAGE "Build the page of tenon view and tenon report, where node and npm are" ON)
set(TENON_PAGE_FOLDER "")

# Puts node_modules into <destination>.
function(tenon_fetch_page destination)
  message(STATUS "Fetching the packages of the page (75 MB unpacked, once)")
  set(work ${destination}.part)
  file(REMOVE_RECURSE ${work})
  file(MAKE_DIRECTORY ${work})
  file(COPY ${PROJECT_SOURCE_DIR}/page/package.json ${PROJECT_SOURCE_DIR}/page/package-lock.json
       DESTINATION ${work})
  execute_process(
    COMMAND ${TENON_NPM} ci --ignore-scripts --no-audit --no-fund --loglevel=error
    WORKING_DIRECTORY ${work}
    RESULT_VARIABLE status
    OUTPUT_QUIET
    ERROR_VARIABLE reason)
  if(NOT status EQUAL 0)
    message(STATUS "Without the page of tenon view and tenon report; npm said: ${reason}")
    return()
  endif()
  file(REMOVE_RECURSE ${destination})
  file(RENAME ${work} ${destination})
endfunction()

function(tenon_page_packages out)
  set(${out} "" PARENT_SCOPE)
  find_program(TENON_NODE NAMES node nodejs)
  find_program(TENON_NPM npm)
  set(version 0)
  if(TENON_NODE AND TENON_NPM)
    execute_process(COMMAND ${TENON_NODE} --version OUTPUT_VARIABLE version ERROR_QUIET)
    string(REGEX REPLACE "^v([0-9.]+).*" "\\1" version "${version}")
  endif()
  if(version VERSION_LESS 18)
    message(STATUS "Without the page of tenon view and tenon report: it needs node 18 and npm "
                   "(apt-get install nodejs npm)")
    return()
  endif()
  file(SHA256 ${PROJECT_SOURCE_DIR}/page/package-lock.json hash)
  string(SUBSTRING ${hash} 0 12 hash)
  set(packages ${TENON_FETCHED}/page-${hash})
  tenon_fetch_once(tenon_fetch_page ${packages} ${packages}/node_modules)
  if(EXISTS ${packages}/node_modules)
    set(${out} ${packages} PARENT_SCOPE)
  endif()
endfunction()

# A program around the library shows no pages, and a part of the sources may be all there is.
if(TENON_PAGE AND PROJECT_IS_TOP_LEVEL AND EXISTS ${PROJECT_SOURCE_DIR}/page/package-lock.json)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
                                         ${PROJECT_SOURCE_DIR}/page/package-lock.json)
  tenon_page_packages(tenon_page_packages)
else()
  set(tenon_page_packages "")
endif()
set(TENON_PAGE_PACKAGES "${tenon_page_packages}")
if(tenon_page_packages)
  set(TENON_PAGE_FOLDER ${PROJECT_BINARY_DIR}/${CMAKE_INSTALL_DATADIR}/tenon/page)
  set(TENON_PAGE_SOURCES ${PROJECT_BINARY_DIR}/page)
  file(GLOB_RECURSE tenon_page_files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/page/src/*)
  list(APPEND tenon_page_files ${PROJECT_SOURCE_DIR}/page/build.mjs
       ${PROJECT_SOURCE_DIR}/page/tsconfig.json ${PROJECT_SOURCE_DIR}/page/package.json)
  # The sources are copied beside their packages, so that the source folder stays as it is.
  add_custom_command(
    OUTPUT ${TENON_PAGE_FOLDER}/report.html
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${TENON_PAGE_SOURCES}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${TENON_PAGE_SOURCES}
    COMMAND ${CMAKE_COMMAND} -E copy_directory ${PROJECT_SOURCE_DIR}/page/src
            ${TENON_PAGE_SOURCES}/src
    COMMAND ${CMAKE_COMMAND} -E copy ${PROJECT_SOURCE_DIR}/page/build.mjs
            ${PROJECT_SOURCE_DIR}/page/tsconfig.json ${PROJECT_SOURCE_DIR}/page/package.json
            ${TENON_PAGE_SOURCES}
    COMMAND ${CMAKE_COMMAND} -E create_symlink ${tenon_page_packages}/node_modules
            ${TENON_PAGE_SOURCES}/node_modules
    COMMAND ${TENON_NODE} ${TENON_PAGE_SOURCES}/build.mjs ${TENON_PAGE_FOLDER}
    DEPENDS ${tenon_page_files}
    COMMENT "Bundling the page"
    VERBATIM)
  add_custom_target(tenon_page ALL DEPENDS ${TENON_PAGE_FOLDER}/report.html)
endif()
