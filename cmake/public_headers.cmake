# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0

# tenon_public_headers(<out>): the headers that programs outside include, relative to the project:
# the wiring, every verb of tenon/asset, authoring and saving, multibody algebra, and all that these
# include. Found by their #include lines. What names another library stays inside.
function(tenon_public_headers out)
  file(GLOB_RECURSE wanted CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}
       ${PROJECT_SOURCE_DIR}/tenon/asset/*.h)
  list(APPEND wanted tenon/tenon.h tenon/open_indices.h tenon/stage_sources.h
       tenon/dynamics/dynamics.h tenon/dynamics/multibody.h tenon/dynamics/posture_text.h
       tenon/edit/stage_editor.h tenon/formats/save_layer.h tenon/guard/worker_place.h)
  set(found)
  foreach(header IN LISTS wanted)
    tenon_included_headers(${header} headers is_public)
    if(is_public)
      list(APPEND found ${headers})
    endif()
  endforeach()
  list(REMOVE_DUPLICATES found)
  list(SORT found)
  set(${out} ${found} PARENT_SCOPE)
endfunction()

# <header> and all of this project that it includes, and whether none of them names a library of
# others.
function(tenon_included_headers header out is_public)
  set(found)
  set(public TRUE)
  set(open ${header})
  while(open)
    list(POP_FRONT open next)
    if(NOT next IN_LIST found)
      list(APPEND found ${next})
      set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${next})
      file(STRINGS ${PROJECT_SOURCE_DIR}/${next} lines REGEX "^#include ")
      foreach(line IN LISTS lines)
        if(line MATCHES "\"(tenon/[^\"]+)\"")
          list(APPEND open ${CMAKE_MATCH_1})
        elseif(line MATCHES "<(.+[/.].+)>")
          set(public FALSE)
        endif()
      endforeach()
    endif()
  endwhile()
  set(${out} ${found} PARENT_SCOPE)
  set(${is_public} ${public} PARENT_SCOPE)
endfunction()
