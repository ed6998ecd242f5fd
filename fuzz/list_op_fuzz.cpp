// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0

// List edits made from the input, applied over one another: the result has no item twice, an edit
// applied twice gives the items that it gives once, and every edit survives text and crate.
#include <cstdint>
#include <cstdlib>
#include <set>
#include <string>
#include <vector>

#include "fuzz/taken_bytes.h"
#include "tenon/formats/crate/reader.h"
#include "tenon/formats/crate/writer.h"
#include "tenon/formats/text/reader.h"
#include "tenon/formats/text/write/writer.h"
#include "tenon/layer/field_values.h"

namespace {

using tenon::Token;
using TokenEdit = tenon::layer::ListOp<Token>;

std::vector<Token> take_items(tenon::fuzz::TakenBytes& input) {
  std::vector<Token> items;
  std::set<Token> seen;
  for (unsigned left = input.below(12); left > 0; --left) {
    const Token item("i" + std::to_string(input.below(10)));
    if (seen.insert(item).second) {  // as the readers give them
      items.push_back(item);
    }
  }
  return items;
}

TokenEdit take_edit(tenon::fuzz::TakenBytes& input) {
  TokenEdit edit;
  const auto bits = input.take<std::uint8_t>();
  edit.is_explicit = bits % 8 == 7;
  if (edit.is_explicit) {
    edit.explicit_items = take_items(input);
    return edit;
  }
  std::vector<Token>* const lists[] = {&edit.prepended, &edit.appended, &edit.deleted, &edit.added,
                                       &edit.ordered};
  for (std::size_t i = 0; i < std::size(lists); ++i) {
    if ((bits >> i & 1) != 0) {
      *lists[i] = take_items(input);
    }
  }
  return edit;
}

void check(bool holds) {
  if (!holds) {
    std::abort();
  }
}

void check_stored(const TokenEdit& edit) {
  tenon::layer::Layer layer("edits");
  const tenon::Path path = tenon::Path::absolute_root().child(Token("P"));
  layer.root().set(Token("primChildren"), std::vector<Token>{Token("P")});
  tenon::layer::Spec& spec = layer.create(path, tenon::layer::SpecKind::Prim);
  spec.set(Token("specifier"), tenon::layer::Specifier::Over);
  spec.set(Token("apiSchemas"), edit);
  const std::string text = tenon::formats::write_text(layer);
  tenon::Diagnostics diagnostics;
  const auto from_text = tenon::formats::read_text(text, "edits.usda", diagnostics);
  check(from_text && tenon::formats::write_text(*from_text) == text);
  const auto crate = tenon::formats::write_crate(layer);
  check(crate.has_value());
  const auto from_crate =
      tenon::formats::read_crate(tenon::bytes::FileBytes::own(*crate), "edits.usdc", diagnostics);
  check(from_crate && tenon::formats::write_text(*from_crate) == text);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  tenon::fuzz::TakenBytes input(data, size);
  std::vector<Token> list;
  for (int i = 0; i < 8 && !input.empty(); ++i) {
    const TokenEdit edit = take_edit(input);
    edit.apply_to(list);
    check(std::set<Token>(list.begin(), list.end()).size() == list.size());
    std::vector<Token> twice = list;
    edit.apply_to(twice);
    check(std::set<Token>(list.begin(), list.end()) == std::set<Token>(twice.begin(), twice.end()));
    if (!(edit == TokenEdit())) {  // text has no word for an edit that does nothing, as OpenUSD's
      check_stored(edit);
    }
  }
  return 0;
}
