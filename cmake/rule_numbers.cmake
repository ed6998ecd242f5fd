# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0

# tenon_rule_numbers(<target>): the table of numbered rules, tests/physics/conformance.txt, as a
# source of <target>, so that the program explains the numbers that its messages name.
function(tenon_rule_numbers target)
  set(table ${PROJECT_SOURCE_DIR}/tests/physics/conformance.txt)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${table})
  file(READ ${table} text)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/rule_number_table.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT [[
// Made from tests/physics/conformance.txt by cmake/rule_numbers.cmake.
#include "cli/text/rule_numbers.h"

namespace tenon::cli {

std::string_view rule_number_table() {
  return R"tenon_table(@text@)tenon_table";
}

}  // namespace tenon::cli
]] @ONLY)
  target_sources(${target} PRIVATE ${source})
endfunction()
