// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0

// Input: lines with a prefix, an anchor and a path expression (the rest). The text that a tree
// gives is read as the same text; taken from the anchor and with paths mapped it can be read too.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "fuzz/taken_bytes.h"
#include "tenon/layer/expressions/path_expression.h"

namespace {

using tenon::Path;
using tenon::layer::PathExpressionTree;

/// The tree that the text of `tree` gives; its text must be the same.
PathExpressionTree read_again(const PathExpressionTree& tree) {
  const std::string text = tree.text();
  // Arguments with control characters or line ends are written as OpenUSD does, which refuses them;
  // a negative zero as -0, which is the whole number 0 when it is read.
  if (text.find("-0") != std::string::npos || text.find("\\x") != std::string::npos ||
      text.find("\"\"\"") != std::string::npos || text.find("'''") != std::string::npos) {
    return tree;
  }
  auto again = PathExpressionTree::parse(text);
  if (!again || again->text() != text) {
    std::abort();
  }
  return *std::move(again);
}

/// A tree whose paths have changed, read from its text: "//" may have come up, which takes in what
/// stands beside it.
PathExpressionTree simplified(const PathExpressionTree& tree) {
  const auto again = PathExpressionTree::parse(tree.text());
  return again ? *again : tree;
}

/// Paths of prims that expressions can name: as in OpenUSD, theirs are of ASCII alone.
bool is_nameable(Path path) {
  const std::string text = path.str();
  return path.is_absolute() && path.is_prim() && std::all_of(text.begin(), text.end(), [](char c) {
           return static_cast<unsigned char>(c) < 0x80;
         });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  tenon::fuzz::TakenBytes input(data, size);
  const Path prefix = Path::from(input.until('\n'));
  const Path anchor = Path::from(input.until('\n'));
  const auto parsed = PathExpressionTree::parse(input.rest());
  if (!parsed) {
    return 0;
  }
  PathExpressionTree tree = read_again(*parsed);
  if (is_nameable(anchor)) {
    tree.make_absolute(anchor);
    tree = read_again(simplified(tree));
  }
  if (is_nameable(prefix)) {
    read_again(simplified(
        tree.mapped([&](Path path) { return path.has_prefix(prefix) ? prefix : Path(); })));
  }
  if (const auto composed = tree.composed_over(*parsed)) {
    read_again(simplified(*composed));
  }
  return 0;
}
