# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
#
# Several sources of a library are compiled as one: most of the time for a single one goes into the
# headers that they all include. Names in unnamed namespaces are therefore unique in a folder. Not
# for coverage; the preset `separate` compiles every source and every header alone.
if(TENON_COVERAGE)
  set(tenon_unity_default OFF)
else()
  set(tenon_unity_default ON)
endif()
option(TENON_UNITY "Compile several sources of a library as one" ${tenon_unity_default})

# As many as keep a compiler within 1.5 GB, and two of them busy to the end. The preset `quick` has
# units of 90 sources of any folders, within 2.2 GB (tools/quiet_build.sh).
set(TENON_UNITY_SOURCES 16 CACHE STRING "Sources that are compiled as one")
mark_as_advanced(TENON_UNITY_SOURCES)

function(tenon_unity target)
  if(TENON_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE
                                               ${TENON_UNITY_SOURCES})
  endif()
endfunction()
