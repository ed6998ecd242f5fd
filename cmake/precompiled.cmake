# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# Headers of the standard library that most files include, compiled once: a third less to compile
# for who builds the program. Only where sources are joined (cmake/unity.cmake): the preset
# `separate` proves that every file includes what it uses, and ccache would only be disturbed. Not
# for the ten units of TENON_QUICK, which read them faster themselves.
set(TENON_PRECOMPILED_HEADERS <algorithm> <array> <cstdint> <functional> <map> <memory> <optional>
                              <set> <span> <string> <string_view> <unordered_map> <utility>
                              <variant> <vector>)
# Those of them and of what writes JSON: a sixth of what these take.
set(TENON_PRECOMPILED_JSON ${TENON_PRECOMPILED_HEADERS} <nlohmann/json.hpp>)

# Gives <target> the headers, compiled with the options <kind>: what has been compiled with the same
# is used again. It links those that are to be precompiled already.
function(tenon_precompile target kind)
  if(TENON_CCACHE OR NOT TENON_UNITY OR TENON_QUICK)
    return()
  endif()
  get_target_property(linked ${target} LINK_LIBRARIES)
  set(headers ${TENON_PRECOMPILED_HEADERS})
  if("tenon_answers" IN_LIST linked OR "nlohmann_json::nlohmann_json" IN_LIST linked)
    set(headers ${TENON_PRECOMPILED_JSON})
    string(APPEND kind _json)
  endif()
  get_property(first GLOBAL PROPERTY tenon_precompiled_${kind})
  if(first)
    target_precompile_headers(${target} REUSE_FROM ${first})
  else()
    target_precompile_headers(${target} PRIVATE ${headers})
    set_property(GLOBAL PROPERTY tenon_precompiled_${kind} ${target})
  endif()
endfunction()
