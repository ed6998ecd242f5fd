// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0

// Input: lines with a path, an anchor and a path expression (the rest). What an expression matches,
// it matches each time and in parentheses.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "fuzz/taken_bytes.h"
#include "tenon/stage/collection.h"

namespace {

// Text that means the same alone and within other text.
bool is_whole(const std::string& text) {
  int depth = 0;
  for (const char c : text) {
    depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    if (depth < 0) {
      return false;
    }
  }
  return depth == 0 && text.find_first_of("{}[]%\"'") == std::string::npos;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  tenon::fuzz::TakenBytes input(data, size);
  const tenon::Path path = tenon::Path::from(input.until('\n'));
  const tenon::Path anchor = tenon::Path::from(input.until('\n'));
  const std::string expression(input.rest());
  if (!path.is_absolute() || !anchor.is_absolute() || !(path.is_prim() || path.is_property())) {
    return 0;
  }
  const bool matches = tenon::stage::expression_matches(expression, anchor, path);
  if (matches != tenon::stage::expression_matches(expression, anchor, path)) {
    std::abort();
  }
  if (matches && is_whole(expression) &&
      !tenon::stage::expression_matches("(" + expression + ")", anchor, path)) {
    std::abort();
  }
  return 0;
}
