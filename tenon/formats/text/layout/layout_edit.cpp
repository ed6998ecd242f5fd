// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Compares what a text says with what it shall say and changes the statements that differ: blocks
// here, their contents in metadata_layout.cpp and property_layout.cpp.
#include "tenon/formats/text/layout/layout_edit.h"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include "tenon/base/diagnostics.h"
#include "tenon/formats/text/layout/layout_state.h"
#include "tenon/formats/text/layout/rename_layout.h"
#include "tenon/formats/text/reader.h"
#include "tenon/formats/text/text_scanner.h"
#include "tenon/formats/text/write/value_text.h"
#include "tenon/formats/text/write/writer.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/spec_equality.h"

namespace tenon::formats {
namespace text {
namespace {

using layer::Layer;
using layer::Spec;
using layer::SpecKind;
using layer::Value;
namespace fields = layer::fields;

bool has(const std::vector<Token>& names, Token name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Names of both that may stay where they are: the longest common subsequence.
std::unordered_set<Token> names_in_order(const std::vector<Token>& before,
                                         const std::vector<Token>& after) {
  std::unordered_map<Token, std::size_t> place;
  for (std::size_t i = 0; i < before.size(); ++i) {
    place.emplace(before[i], i);
  }
  // The longest ascending chain of places: `ends` holds for each length the name that ends it.
  std::vector<std::size_t> ends;
  std::vector<std::size_t> previous(after.size(), after.size());
  for (std::size_t i = 0; i < after.size(); ++i) {
    const auto found = place.find(after[i]);
    if (found == place.end()) {
      continue;
    }
    const auto at = std::lower_bound(
        ends.begin(), ends.end(), found->second,
        [&](std::size_t end, std::size_t value) { return place[after[end]] < value; });
    if (at != ends.begin()) {
      previous[i] = *(at - 1);
    }
    if (at == ends.end()) {
      ends.push_back(i);
    } else {
      *at = i;
    }
  }
  std::unordered_set<Token> kept;
  for (std::size_t i = ends.empty() ? after.size() : ends.back(); i < after.size();
       i = previous[i]) {
    kept.insert(after[i]);
  }
  return kept;
}

class BlockLayout {
 public:
  explicit BlockLayout(LayoutState& state) : state_(state), patch_(state.patch) {}

  void run() {
    pending_.push_back(Path::absolute_root());
    while (!pending_.empty() && !state_.failed) {
      const Path path = pending_.back();
      pending_.pop_back();
      edit_block(path);
    }
  }

 private:
  const SourceBlock* block(Path path) const {
    const auto it = state_.sources.blocks.find(path);
    return it == state_.sources.blocks.end() ? nullptr : &it->second;
  }

  void edit_block(Path path) {
    const Spec* const was = state_.before.find(path);
    const Spec* const is = state_.after.find(path);
    const SourceBlock* at = block(path);
    if (was == nullptr || is == nullptr || (!path.is_absolute_root() && at == nullptr)) {
      state_.failed = true;
      return;
    }
    const Spec& before = *was;
    const Spec& after = *is;
    if (at == nullptr) {
      edit_metadata(state_, path, {0, state_.sources.header_end});
      const auto metadata = state_.sources.metadata.find(path);
      last_ = metadata == state_.sources.metadata.end() ? SourceRange{0, state_.sources.header_end}
                                                        : metadata->second.range;
    } else {
      edit_head(*at, before, after);
      edit_metadata(state_, path, {at->range.begin, at->name_end});
      last_ = {at->body.begin, at->body.begin + 1};
    }
    edit_orders(path, before, after);
    edit_properties(path, before, after);
    edit_children(path, before, after);
    edit_variant_sets(path, before, after);
  }

  /// `def Type` in front of the name.
  void edit_head(const SourceBlock& at, const Spec& before, const Spec& after) {
    if (before.kind != SpecKind::Prim) {
      return;
    }
    const auto head = [](const Spec& spec) {
      constexpr const char* kWords[] = {"def", "over", "class"};
      const auto specifier = spec.get_or(fields::specifier, layer::Specifier::Over);
      const Token type = spec.get_or(fields::typeName, Token());
      return std::string(kWords[static_cast<std::size_t>(specifier)]) +
             (type.empty() ? " " : " " + type.str() + " ");
    };
    if (head(before) != head(after)) {
      patch_.replace({at.range.begin, at.name_begin}, head(after));
    }
  }

  /// The statement that gives an order of the block, or nullptr.
  const SourceRange* order_statement(Path path, Token field) const {
    const auto found = state_.sources.orders.find(path);
    if (found == state_.sources.orders.end()) {
      return nullptr;
    }
    for (const SourceRange& range : found->second) {
      Scanner scanner(patch_.text(), range.begin);
      scanner.next();
      if ((scanner.next() == "properties") == (field == fields::propertyOrder)) {
        return &range;
      }
    }
    return nullptr;
  }

  void edit_orders(Path path, const Spec& before, const Spec& after) {
    for (const Token field : {fields::primOrder, fields::propertyOrder}) {
      const SourceRange* statement = order_statement(path, field);
      const auto& names = Layer::children(after, field);
      if (names != Layer::children(before, field)) {
        const char* what = field == fields::propertyOrder ? "properties"
                           : path.is_absolute_root()      ? "rootPrims"
                                                          : "nameChildren";
        const std::string text = "reorder " + std::string(what) + " = " + value_text(Value(names));
        if (names.empty() && statement != nullptr) {
          patch_.remove(*statement);
        } else if (statement != nullptr) {
          patch_.replace(*statement, text);
        } else if (!names.empty()) {
          insert(path, text + "\n", false);
        }
      }
      if (statement != nullptr) {
        note_last(*statement);
      }
    }
  }

  std::string inner_indent(Path path) const {
    const SourceBlock* at = block(path);
    return at == nullptr ? std::string() : patch_.indent_at(at->range.begin) + state_.unit;
  }

  /// Where a child of the block stands, its indentation counts for new ones.
  std::string indent_of_new(Path path) const {
    const SourceBlock* at = block(path);
    const bool inside = at == nullptr || last_.begin > at->body.begin;
    return inside && last_.end != 0 && patch_.starts_line(last_.begin)
               ? patch_.indent_at(last_.begin)
               : inner_indent(path);
  }

  void note_last(SourceRange range) {
    if (range.end > last_.end) {
      last_ = range;
    }
  }

  void insert(Path path, const std::string& canonical, bool blank_line) {
    const std::string lines = reindented(canonical, indent_of_new(path), state_.unit);
    const std::string text = (blank_line ? "\n" : "") + lines;
    const SourceBlock* at = block(path);
    if (at != nullptr && last_.begin == at->body.begin) {
      patch_.insert_inside(last_.begin, text);
    } else {
      patch_.insert_after(last_, text);
    }
  }

  /// The spec says the same before and after; what is in one of the layers alone does not.
  bool is_same(Path path) const {
    const Spec* const before = state_.before.find(path);
    const Spec* const after = state_.after.find(path);
    return before == nullptr || after == nullptr ? before == after
                                                 : layer::same_spec(*before, *after);
  }

  void edit_properties(Path path, const Spec& before, const Spec& after) {
    const auto& old = Layer::children(before, fields::properties);
    const auto& now = Layer::children(after, fields::properties);
    for (const Token name : old) {
      const Path property = path.property(name);
      const auto found = state_.sources.properties.find(property);
      if (found == state_.sources.properties.end()) {
        state_.failed = true;
        return;
      }
      for (const PropertyStatement& statement : found->second) {
        note_last(statement.range);
        if (!has(now, name)) {
          patch_.remove(statement.range);
        }
      }
      if (has(now, name) && !is_same(property)) {
        edit_property(state_, property);
      }
    }
    for (const Token name : now) {
      if (!has(old, name)) {
        insert(path, part_text(state_.after, path.property(name)), false);
      }
    }
  }

  void edit_children(Path path, const Spec& before, const Spec& after) {
    const auto& old = Layer::children(before, fields::primChildren);
    const auto& now = Layer::children(after, fields::primChildren);
    const std::unordered_set<Token> kept = names_in_order(old, now);
    for (const Token name : old) {
      const SourceBlock* child = block(path.child(name));
      if (child == nullptr) {
        state_.failed = true;
        return;
      }
      if (!kept.contains(name)) {
        patch_.remove(child->range, '\0');
      }
    }
    const SourceBlock* at = block(path);
    for (const Token name : now) {
      const bool first = at != nullptr && last_.begin == at->body.begin;
      if (kept.contains(name)) {
        last_ = block(path.child(name))->range;
        pending_.push_back(path.child(name));
      } else {
        insert(path, part_text(state_.after, path.child(name)), !first);
      }
    }
    for (const Token name : old) {
      note_last(block(path.child(name))->range);
    }
  }

  void edit_variant_sets(Path path, const Spec& before, const Spec& after) {
    const auto& old = Layer::children(before, fields::variantSetChildren);
    const auto& now = Layer::children(after, fields::variantSetChildren);
    for (const Token name : old) {
      const Path set = path.variant_selection(name, Token());
      if (const SourceBlock* at = block(set)) {
        note_last(at->range);
        has(now, name) ? edit_variants(path, set) : patch_.remove(at->range, '\0');
      } else if (has(now, name) && !is_same(set)) {
        insert(path, part_text(state_.after, set), false);
      }
    }
    for (const Token name : now) {
      if (!has(old, name)) {
        insert(path, part_text(state_.after, path.variant_selection(name, Token())), false);
      }
    }
  }

  void edit_variants(Path prim, Path set) {
    const auto& old = state_.before.children(set, fields::variantChildren);
    const auto& now = state_.after.children(set, fields::variantChildren);
    const SourceRange outer = last_;
    last_ = {block(set)->body.begin, block(set)->body.begin + 1};
    for (const Token name : old) {
      const Path variant = prim.variant_selection(set.name(), name);
      const SourceBlock* at = block(variant);
      if (at == nullptr) {
        state_.failed = true;
        return;
      }
      note_last(at->range);
      if (has(now, name)) {
        pending_.push_back(variant);
      } else {
        patch_.remove(at->range, '\0');
      }
    }
    for (const Token name : now) {
      if (!has(old, name)) {
        insert(set, part_text(state_.after, prim.variant_selection(set.name(), name)), false);
      }
    }
    last_ = outer;
  }

  LayoutState& state_;
  TextPatch& patch_;
  std::vector<Path> pending_;
  SourceRange last_;  // of the block at hand: the last statement, or the brace
};

/// Equal except for the order of properties.
bool same_meaning(const Layer& a, const Layer& b) {
  if (a.spec_count() != b.spec_count()) {
    return false;
  }
  const auto sorted = [](Spec spec) {
    std::vector<Token> names = Layer::children(spec, fields::properties);
    std::sort(names.begin(), names.end());
    if (!names.empty()) {
      spec.set(fields::properties, Value(std::move(names)));
    }
    return spec;
  };
  return std::all_of(a.entries().begin(), a.entries().end(), [&](const Layer::Entry& entry) {
    if (entry.path.empty()) {
      return true;
    }
    const Spec* other = b.find(entry.path);
    return other != nullptr && (layer::same_spec(entry.spec, *other) ||
                                layer::same_spec(sorted(entry.spec), sorted(*other)));
  });
}

/// The indentation of the first statement that is further in than its block.
std::string detect_unit(const SourceMap& sources, const TextPatch& patch) {
  std::size_t first = std::string::npos;
  std::string unit = "    ";
  for (const auto& [path, block] : sources.blocks) {
    const auto parent = sources.blocks.find(path.parent());
    if (parent == sources.blocks.end() || block.range.begin > first) {
      continue;
    }
    const std::string outer = patch.indent_at(parent->second.range.begin);
    const std::string inner = patch.indent_at(block.range.begin);
    if (inner.size() > outer.size() && inner.starts_with(outer)) {
      first = block.range.begin;
      unit = inner.substr(outer.size());
    }
  }
  for (const auto& [path, statements] : sources.properties) {
    const auto parent = sources.blocks.find(path.parent());
    const std::size_t begin = statements.front().range.begin;
    if (parent == sources.blocks.end() || begin > first) {
      continue;
    }
    const std::string outer = patch.indent_at(parent->second.range.begin);
    const std::string inner = patch.indent_at(begin);
    if (inner.size() > outer.size() && inner.starts_with(outer)) {
      first = begin;
      unit = inner.substr(outer.size());
    }
  }
  return unit;
}

}  // namespace
}  // namespace text

EditedText edit_text(std::string_view original, const layer::Layer& edited) {
  Diagnostics ignored;
  text::SourceMap sources;
  const auto before = read_text_with_sources(original, edited.identifier(), ignored, sources);
  if (before) {
    if (const auto renamed = text::with_new_names(original, sources, *before, edited)) {
      return edit_text(*renamed, edited);
    }
    text::LayoutState state{*before, edited, sources, text::TextPatch(original)};
    state.unit = text::detect_unit(sources, state.patch);
    text::BlockLayout(state).run();
    std::optional<std::string> result = state.failed ? std::nullopt : state.patch.result();
    const auto again = result ? read_text(*result, edited.identifier(), ignored)
                              : Result<layer::Layer>(Error(ErrorCode::Invalid, ""));
    if (again && text::same_meaning(*again, edited)) {
      return {*std::move(result), true};
    }
  }
  return {write_text(edited), false};
}

}  // namespace tenon::formats
