// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/updating/follow_moves.h"

#include <set>
#include <utility>

#include "tenon/edit/layer_editor.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"

namespace tenon {
namespace {

namespace fields = layer::fields;
using Prims = std::map<Path, Token>;  // with their types

/// Prims that some layer defines.
Prims defined_prims(const std::vector<const layer::Layer*>& layers) {
  Prims prims;
  for (const layer::Layer* layer : layers) {
    for (const layer::Layer::Entry& entry : layer->entries()) {
      const auto* type = entry.path.empty() || !entry.path.is_prim() || entry.path.has_variants()
                             ? nullptr
                             : entry.spec.get<Token>(fields::typeName);
      if (type != nullptr &&
          entry.spec.get_or(fields::specifier, layer::Specifier::Over) == layer::Specifier::Def) {
        prims.emplace(entry.path, *type);
      }
    }
  }
  return prims;
}

using Named = std::map<std::pair<Token, Token>, std::vector<Path>>;  // by name and type

/// Of `prims` those that `others` lack.
Named missing_in(const Prims& others, const Prims& prims) {
  Named named;
  for (const auto& [path, type] : prims) {
    if (!others.contains(path)) {
      named[{path.name(), type}].push_back(path);
    }
  }
  return named;
}

bool goes_along(const std::map<Path, Path>& moved, Path from, Path to) {
  for (Path at = from.parent(); !at.empty() && !at.is_absolute_root(); at = at.parent()) {
    const auto around = moved.find(at);
    if (around != moved.end()) {
      return from.replace_prefix(around->first, around->second) == to;
    }
  }
  return false;
}

}  // namespace

std::map<Path, Path> moved_prims(const std::vector<const layer::Layer*>& before,
                                 const std::vector<const layer::Layer*>& after) {
  const Prims old_prims = defined_prims(before);
  const Prims new_prims = defined_prims(after);
  const Named gone = missing_in(new_prims, old_prims);
  const Named come = missing_in(old_prims, new_prims);
  std::map<Path, Path> pairs;
  for (const auto& [name, paths] : gone) {
    const auto at = come.find(name);
    if (paths.size() == 1 && at != come.end() && at->second.size() == 1) {
      pairs.emplace(paths[0], at->second[0]);
    }
  }
  std::map<Path, Path> moved;
  for (const auto& [from, to] : pairs) {  // a prim before what is below it
    if (!goes_along(moved, from, to)) {
      moved.emplace(from, to);
    }
  }
  return moved;
}

void follow_moves(const std::map<Path, Path>& moved, layer::Layer& layer) {
  edit::LayerEditor editor(layer);
  // Those far down first, so that what moves out of a moved prim is still where it was.
  for (auto at = moved.rbegin(); at != moved.rend(); ++at) {
    const auto& [from, to] = *at;
    if (layer.has(from) && !layer.has(to) && !to.has_prefix(from) &&
        editor.create_prim(to.parent())) {
      if (!editor.move_prim(from, to)) {
        continue;  // stays where it is: told as removed by the source where it was edited
      }
    }
    editor.retarget(from, to);
  }
}

}  // namespace tenon
