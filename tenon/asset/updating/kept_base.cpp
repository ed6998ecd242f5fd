// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/updating/kept_base.h"

#include <string>

#include "tenon/base/content_digest.h"
#include "tenon/formats/text/write/value_text.h"

namespace tenon {
namespace {

using diff::MergeConflict;
using layer::Layer;
using layer::Spec;
using layer::Value;

/// Gives `to` the spec of `from`, or none where `from` has none.
void take_spec(Layer& to, const Layer& from, Path path) {
  if (to.has(path)) {
    to.erase(path);
  }
  if (const Spec* spec = from.find(path)) {
    to.create(path, spec->kind).set_field_list(spec->field_list());
  }
}

void take_below(Layer& to, const Layer& from, const std::set<Path>& roots) {
  std::set<Path> paths;
  const auto note = [&](const Layer& layer) {
    for (const Layer::Entry& entry : layer.entries()) {
      for (const Path root : roots) {
        const bool around =
            root.has_prefix(entry.path.is_property() ? entry.path.prim() : entry.path);
        if (!entry.path.empty() &&
            (entry.path.has_prefix(root) || (around && !from.has(entry.path)))) {
          paths.insert(entry.path);
        }
      }
    }
  };
  note(to);
  note(from);
  for (const Path path : paths) {
    take_spec(to, from, path);
  }
}

}  // namespace

// What the source did at these places is taken for what was there before, so that the old state is
// an edit of it, which a merge keeps.
Layer kept_base(const Layer& base, const Layer& source, const std::vector<MergeConflict>& conflicts,
                const std::set<Path>& whole) {
  Layer before = base;
  std::set<Path> roots = whole;
  for (const MergeConflict& conflict : conflicts) {
    if (conflict.kind != MergeConflict::Kind::Values || conflict.field.empty()) {
      roots.insert(conflict.path);
      continue;
    }
    const Spec* now = source.find(conflict.path);
    const Value* value = now == nullptr ? nullptr : now->find(conflict.field);
    if (Spec* spec = before.find(conflict.path)) {
      value == nullptr ? spec->erase(conflict.field) : spec->set(conflict.field, *value);
    }
  }
  take_below(before, source, roots);
  return diff::merge_layers(before, base, source, {diff::Side::Edits, {}}).layer;
}

std::uint64_t conflict_digest(const MergeConflict& conflict) {
  std::string text = std::to_string(static_cast<int>(conflict.kind));
  for (const std::string& part :
       {conflict.path.str(), conflict.field.str(), conflict.key,
        conflict.source.empty() ? std::string() : formats::value_text(conflict.source)}) {
    text += '\n' + part;
  }
  return content_digest(text);
}

}  // namespace tenon
