# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# Headers of the standard library that most files include, compiled once: a third less to compile
# for who builds the program. Not in the developer's builds, which prove that every file includes
# what it uses, and not with ccache, which precompiled headers would only disturb.
set(TENON_PRECOMPILED_HEADERS <algorithm> <array> <cstdint> <functional> <map> <memory> <optional>
                              <set> <span> <string> <string_view> <unordered_map> <utility>
                              <variant> <vector>)

# Gives <target> the headers, compiled with the options <kind>: what has been compiled with the same
# is used again.
function(tenon_precompile target kind)
  if(TENON_DEVELOPER OR TENON_CCACHE OR TENON_TIDY)
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
