// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What a variant says itself is edited whether it is selected or not, as its specs are in the file.
// Only what its arcs bring in has to be composed to be known.
#include "tenon/asset/editing/other_variants.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "tenon/edit/layer_editor.h"
#include "tenon/layer/fields.h"

namespace tenon {
namespace {

namespace fields = layer::fields;
using VariantNames = std::set<std::pair<std::string, std::string>>;  // set, variant

bool has_arc(const layer::Spec& spec) {
  return spec.has(fields::references) || spec.has(fields::payload) ||
         spec.has(fields::inheritPaths) || spec.has(fields::specializes);
}

/// Of variants with arcs in them, in all layers of the stage.
VariantNames variants_with_arcs(const stage::Stage& stage) {
  VariantNames names;
  for (const layer::LayerPtr& layer : stage.used_layers()) {
    for (const layer::Layer::Entry& entry : layer->entries()) {
      if (!entry.path.has_variants() || !entry.path.is_prim_or_variant() || !has_arc(entry.spec)) {
        continue;
      }
      for (Path at = entry.path; !at.is_absolute_root(); at = at.parent()) {
        if (at.is_variant_selection()) {
          names.emplace(at.name().str(), at.variant().str());
        }
      }
    }
  }
  return names;
}

/// One variant of one prim to select.
struct Selection {
  Path prim;
  std::string set;
  std::string variant;
};

/// In the first list the first other variant of each set, and so on.
std::vector<std::vector<Selection>> rounds_of(const stage::Stage& stage, const VariantNames& names,
                                              const std::set<std::string>& without) {
  std::vector<std::vector<Selection>> rounds;
  std::vector<stage::Prim> open{stage.pseudo_root()};
  while (!open.empty()) {
    const stage::Prim prim = open.back();
    open.pop_back();
    for (const std::string& set : prim.variant_set_names()) {
      std::size_t round = 0;
      for (const std::string& variant : prim.variant_names(set)) {
        if (without.contains(set) || !names.contains({set, variant}) ||
            variant == prim.variant_selection(set)) {
          continue;
        }
        rounds.resize(std::max(rounds.size(), round + 1));
        rounds[round++].push_back({prim.path(), set, variant});
      }
    }
    if (!prim.is_instance()) {
      const std::vector<stage::Prim> children = prim.children();
      open.insert(open.end(), children.begin(), children.end());
    }
  }
  return rounds;
}

}  // namespace

std::vector<layer::LayerPtr> sessions_of_other_variants(const stage::Stage& stage,
                                                        const layer::LayerPtr& session,
                                                        const std::set<std::string>& without) {
  std::vector<layer::LayerPtr> sessions;
  const VariantNames names = variants_with_arcs(stage);
  if (names.empty()) {
    return sessions;
  }
  for (const auto& round : rounds_of(stage, names, without)) {
    auto made = std::make_shared<layer::Layer>(
        session == nullptr ? layer::Layer("anon:other_variants.usda") : *session);
    edit::LayerEditor editor(*made);
    for (const Selection& one : round) {
      if (editor.create_prim(one.prim)) {
        editor.select_variant(one.prim, one.set, one.variant);
      }
    }
    sessions.push_back(std::move(made));
  }
  return sessions;
}

}  // namespace tenon
