# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0

# tenon_rule_pages(<target>): the pages of docs/rules as a source of <target>, so that the program
# shows what stands there. README.md, the index, is no page.
function(tenon_rule_pages target)
  file(GLOB pages CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/docs/rules/*.md)
  list(FILTER pages EXCLUDE REGEX "/README\\.md$")
  set(rows)
  foreach(page IN LISTS pages)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${page})
    get_filename_component(id ${page} NAME)
    string(REGEX REPLACE "\\.md$" "" id ${id})
    file(READ ${page} text)
    string(APPEND rows "    {\"${id}\", R\"tenon_page(${text})tenon_page\"},\n")
  endforeach()
  set(source ${CMAKE_CURRENT_BINARY_DIR}/rule_pages.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT [[
// Made from docs/rules by cmake/rule_pages.cmake.
#include <algorithm>

#include "tenon/check/rule.h"

namespace tenon::check {
namespace {

constexpr Page kPages[] = {
@rows@};

std::vector<Page> sorted_pages() {
  std::vector<Page> all(std::begin(kPages), std::end(kPages));
  std::sort(all.begin(), all.end(), [](const Page& a, const Page& b) { return a.id < b.id; });
  return all;
}

}  // namespace

const std::vector<Page>& pages() {
  static const std::vector<Page> all = sorted_pages();
  return all;
}

}  // namespace tenon::check
]] @ONLY)
  target_sources(${target} PRIVATE ${source})
endfunction()
