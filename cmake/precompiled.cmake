# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# Headers of the standard library that most files include, compiled once: a third less to compile
# for who builds the program. Only where sources are joined (cmake/unity.cmake): the preset
# `separate` proves that every file includes what it uses, and ccache would only be disturbed.
set(TENON_PRECOMPILED_HEADERS <algorithm> <array> <cstdint> <functional> <map> <memory> <optional>
                              <set> <span> <string> <string_view> <unordered_map> <utility>
                              <variant> <vector>)

# Gives <target> the headers, compiled with the options <kind>: what has been compiled with the same
# is used again.
function(tenon_precompile target kind)
  if(TENON_CCACHE OR NOT TENON_UNITY)
    return()
  endif()
  get_property(first GLOBAL PROPERTY tenon_precompiled_${kind})
  if(first)
    target_precompile_headers(${target} REUSE_FROM ${first})
  else()
    target_precompile_headers(${target} PRIVATE ${TENON_PRECOMPILED_HEADERS})
    set_property(GLOBAL PROPERTY tenon_precompiled_${kind} ${target})
  endif()
endfunction()
