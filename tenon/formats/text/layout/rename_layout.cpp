// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/text/layout/rename_layout.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "tenon/formats/text/layout/text_patch.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"
#include "tenon/layer/spec_equality.h"

namespace tenon::formats::text {
namespace {

namespace fields = layer::fields;

/// The old and the new name, where they are all that differs between two lists of children.
std::optional<std::pair<Token, Token>> one_new_name(const std::vector<Token>& before,
                                                    const std::vector<Token>& after) {
  if (before.size() != after.size()) {
    return std::nullopt;
  }
  const auto [old, now] = std::mismatch(before.begin(), before.end(), after.begin());
  if (old == before.end() || !std::equal(old + 1, before.end(), now + 1) ||
      std::find(before.begin(), before.end(), *now) != before.end()) {
    return std::nullopt;
  }
  return std::pair(*old, *now);
}

/// The old and new names of properties, where lists of as many names differ in some.
std::vector<std::pair<Token, Token>> new_names(const std::vector<Token>& before,
                                               const std::vector<Token>& after) {
  std::vector<std::pair<Token, Token>> found;
  for (std::size_t i = 0; before.size() == after.size() && i < before.size(); ++i) {
    if (before[i] == after[i]) {
      continue;
    }
    if (std::find(before.begin(), before.end(), after[i]) != before.end()) {
      return {};
    }
    found.emplace_back(before[i], after[i]);
  }
  return found;
}

/// Writes the new names of a prim's properties in the statements that give them.
bool rename_properties(TextPatch& patch, std::string_view text, const SourceMap& sources,
                       const layer::Layer& before, const layer::Layer& after, Path prim) {
  bool any = false;
  for (const auto& [old, now] : new_names(before.children(prim, fields::properties),
                                          after.children(prim, fields::properties))) {
    const layer::Spec* was = before.find(prim.property(old));
    const layer::Spec* is = after.find(prim.property(now));
    const auto statements = sources.properties.find(prim.property(old));
    if (was == nullptr || is == nullptr || !layer::same_spec(*was, *is) ||
        statements == sources.properties.end()) {
      continue;
    }
    for (const PropertyStatement& statement : statements->second) {
      const std::string_view name = old.view();
      const std::size_t at = text.substr(0, statement.name_end).rfind(name);
      if (at != std::string_view::npos && at >= statement.range.begin) {
        patch.replace({at, at + name.size()}, now.str());
        any = true;
      }
    }
  }
  return any;
}

bool are_alike(const layer::Spec* before, const layer::Spec* after) {
  const auto same = [&](Token field) {
    const layer::Value* x = before->find(field);
    const layer::Value* y = after->find(field);
    return x == nullptr || y == nullptr ? x == y : *x == *y;
  };
  return before != nullptr && after != nullptr && same(fields::specifier) &&
         same(fields::typeName) && same(fields::primChildren);
}

}  // namespace

std::optional<std::string> with_new_names(std::string_view text, const SourceMap& sources,
                                          const layer::Layer& before, const layer::Layer& after) {
  TextPatch patch(text);
  bool any = false;
  for (const layer::Layer::Entry& entry : before.entries()) {
    if (entry.path.empty() ||
        !(entry.path.is_prim_or_root() || entry.path.is_variant_selection())) {
      continue;
    }
    any = rename_properties(patch, text, sources, before, after, entry.path) || any;
    const auto names = one_new_name(before.children(entry.path, fields::primChildren),
                                    after.children(entry.path, fields::primChildren));
    const auto block =
        names ? sources.blocks.find(entry.path.child(names->first)) : sources.blocks.end();
    if (block != sources.blocks.end() && are_alike(before.find(entry.path.child(names->first)),
                                                   after.find(entry.path.child(names->second)))) {
      patch.replace({block->second.name_begin, block->second.name_end},
                    '"' + names->second.str() + '"');
      any = true;
    }
  }
  return any ? patch.result() : std::nullopt;
}

}  // namespace tenon::formats::text
