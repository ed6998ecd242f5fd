# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# Installs the executable, the engine library it loads, and all licences. The build folder has the
# same layout, so that the executable finds the library from either place.
set_target_properties(tenon_cli PROPERTIES INSTALL_RPATH
                                           "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}/tenon")
install(TARGETS tenon_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE
        DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/tenon)
if(tenon_coacd_library)
  install(DIRECTORY ${tenon_coacd_root}/coacd ${tenon_coacd_root}/coacd.libs
          DESTINATION ${CMAKE_INSTALL_LIBDIR}/tenon)
  install(DIRECTORY ${tenon_coacd_root}/licences/
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/tenon/coacd)
endif()
if(TENON_WITH_MUJOCO)
  set(library_folder ${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR}/tenon)
  file(MAKE_DIRECTORY ${library_folder})
  file(CREATE_LINK ${tenon_mujoco_library} ${library_folder}/${tenon_mujoco_soname} SYMBOLIC)
  install(FILES ${tenon_mujoco_library} DESTINATION ${CMAKE_INSTALL_LIBDIR}/tenon)
  install(FILES ${tenon_mujoco_licences}
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/tenon/mujoco)
endif()
