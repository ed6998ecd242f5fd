# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# Installs everything: the program, the worker that it starts, the engine library of both, all
# licences; and the library with its headers and package files, which --component development
# installs alone (with the component runtime, which it needs).
# The build folder has the same layout, so that the executable finds the libraries from either place
# and no path of the build is compiled into it (tests/release/moved.py).
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME runtime)
set(library_folder ${PROJECT_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR}/tenon)
file(MAKE_DIRECTORY ${library_folder})
set_target_properties(tenon_worker PROPERTIES INSTALL_RPATH
                                              "$ORIGIN/../../${CMAKE_INSTALL_LIBDIR}/tenon")
if(TENON_WITH_MUJOCO)
  file(CREATE_LINK ${tenon_mujoco_library} ${library_folder}/${tenon_mujoco_soname} SYMBOLIC)
endif()
if(TENON_WITH_PHYSX)
  file(CREATE_LINK ${tenon_physx_library} ${library_folder}/libtenon_physx.so SYMBOLIC)
endif()
if(tenon_coacd_library)
  foreach(folder coacd coacd.libs)
    file(CREATE_LINK ${tenon_coacd_root}/${folder} ${library_folder}/${folder} SYMBOLIC)
  endforeach()
endif()
if(TARGET tenon_cli)
  set_target_properties(tenon_cli PROPERTIES INSTALL_RPATH
                                             "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}/tenon")
endif()
if(NOT TENON_INSTALL)
  return()
endif()

install(TARGETS tenon_worker RUNTIME DESTINATION libexec/tenon)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE
        DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/tenon)
include(licences)
if(TARGET tenon_cli)
  install(TARGETS tenon_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
endif()
if(tenon_shell_files) # cli/CMakeLists.txt
  install(FILES ${tenon_shell_files}/tenon.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1
          COMPONENT program)
  install(FILES ${tenon_shell_files}/tenon
          DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
  install(FILES ${tenon_shell_files}/_tenon
          DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions COMPONENT program)
  install(FILES ${tenon_shell_files}/tenon.fish
          DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT program)
endif()

if(TENON_PAGE_FOLDER)
  install(DIRECTORY ${TENON_PAGE_FOLDER} DESTINATION ${CMAKE_INSTALL_DATADIR}/tenon)
endif()
if(tenon_coacd_library)
  install(DIRECTORY ${tenon_coacd_root}/coacd ${tenon_coacd_root}/coacd.libs
          DESTINATION ${CMAKE_INSTALL_LIBDIR}/tenon)
  install(DIRECTORY ${tenon_coacd_root}/licences/
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/tenon/coacd)
endif()
if(TENON_WITH_MUJOCO)
  install(FILES ${tenon_mujoco_library} DESTINATION ${CMAKE_INSTALL_LIBDIR}/tenon)
  install(FILES ${tenon_mujoco_licences}
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/tenon/mujoco)
endif()
if(TENON_WITH_PHYSX)
  install(FILES ${tenon_physx_library} DESTINATION ${CMAKE_INSTALL_LIBDIR}/tenon)
  install(FILES ${tenon_physx_root}/licences/LICENSE.md
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/tenon/physx)
endif()
if(TENON_WITH_JOLT)
  install(FILES ${tenon_jolt_root}/licences/LICENSE
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/tenon/jolt)
endif()
if(TARGET tenon_library)
  include(install_library)
endif()
