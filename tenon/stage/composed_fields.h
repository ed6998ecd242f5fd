// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "tenon/compose/prim_index.h"
#include "tenon/layer/field_values.h"
#include "tenon/stage/stage_data.h"

/// How the opinions of one field become one value. Internal to tenon/stage.
namespace tenon::stage {

/// Opinions on a property of a prim, strongest first. Their spec kinds may differ; composition
/// diagnoses that.
std::vector<compose::Opinion> property_opinions(const PrimData& prim, Token name);

/// Calls `visit(opinion)` for each of them until it returns true.
template <class Visit>
void visit_property_opinions(const PrimData& prim, Token name, Visit visit) {
  prim.index->visit_property(name, visit);
}

/// Resolved: as authored, with what they resolve to. Anchored: rewritten so that they mean the same
/// in a layer that stands anywhere.
enum class AssetForm : unsigned char { Resolved, Anchored };

/// A value as authored, moved to the stage: asset paths resolved, time codes and paths mapped.
layer::Value localize(const StageData& stage, const PrimData& prim, const compose::Opinion& opinion,
                      const layer::Value& value, AssetForm form = AssetForm::Resolved);

/// A path authored in `layer`, not empty, so that it means the same wherever it is written.
std::string anchored_asset(const StageData& stage, const layer::Layer& layer,
                           const std::string& path);

/// Opinions on the stage itself: of the session layer and the root layer.
std::vector<compose::Opinion> root_opinions(const StageData& stage);

/// What one opinion does with what weaker ones say about the same field.
enum class FieldEffect : unsigned char { Decides, Declares, EditsList, ReplacesList, MergesKeys };
FieldEffect field_effect(const layer::Value& value);

/// The composed value of a field; empty when no opinion has it. Dictionaries are merged, list edits
/// combined to an explicit list, else the strongest opinion wins. `used` receives the specs that
/// have a part in it, strongest first.
using UsedSpecs = std::vector<const layer::Spec*>;
layer::Value compose_field(const StageData& stage, const PrimData& prim,
                           std::span<const compose::Opinion> opinions, Token field,
                           AssetForm form = AssetForm::Resolved, UsedSpecs* used = nullptr);

/// True for fields that say what is there (values, arcs, lists of children), not how it is meant.
bool is_structure(Token field);

/// True for plain values that mean the same in any layer: no asset paths, time codes, path
/// expressions, nothing that combines with other opinions.
bool means_same_anywhere(const layer::Value& value);

/// Calls `visit(name, value)` for all fields that are no structure, composed.
template <class Visit>
void visit_metadata(const StageData& stage, const PrimData& prim,
                    std::span<const compose::Opinion> opinions, AssetForm form, Visit visit) {
  std::vector<Token> visited;
  for (const compose::Opinion& opinion : opinions) {
    for (const layer::Field& field : opinion.spec->fields()) {
      if (!is_structure(field.name) &&
          std::find(visited.begin(), visited.end(), field.name) == visited.end()) {
        visited.push_back(field.name);
        visit(field.name, compose_field(stage, prim, opinions, field.name, form));
      }
    }
  }
}

/// The same by name.
std::map<std::string, layer::Value> compose_metadata(const StageData& stage, const PrimData& prim,
                                                     std::span<const compose::Opinion> opinions,
                                                     AssetForm form = AssetForm::Resolved);

/// The composed list of a list-edited field.
template <class T>
std::vector<T> compose_list(std::span<const compose::Opinion> opinions, Token field) {
  std::vector<T> result;
  for (std::size_t i = opinions.size(); i-- > 0;) {
    if (const auto* op = opinions[i].spec->get<layer::ListOp<T>>(field)) {
      op->apply_to(result);
    }
  }
  return result;
}

}  // namespace tenon::stage
