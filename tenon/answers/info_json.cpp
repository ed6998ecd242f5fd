// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/answers/info_json.h"

#include <cstddef>
#include <filesystem>
#include <set>
#include <string>

#include "tenon/answers/prim_walk.h"
#include "tenon/answers/variants_json.h"
#include "tenon/scene/physics_counts.h"
#include "tenon/stage/stage_units.h"

namespace tenon::answers {
namespace {

/// A layer's place as seen from the folder of the root layer.
std::string layer_name(const std::string& identifier, const std::string& root) {
  const std::filesystem::path path(identifier);
  if (!path.is_absolute()) {
    return identifier;
  }
  return path.lexically_proximate(std::filesystem::path(root).parent_path()).generic_string();
}

const char* axis_name(stage::UpAxis axis) {
  switch (axis) {
    case stage::UpAxis::X:
      return "X";
    case stage::UpAxis::Y:
      return "Y";
    case stage::UpAxis::Z:
      break;
  }
  return "Z";
}

Json stage_summary(const stage::Stage& stage, std::size_t prim_count) {
  std::set<std::string> names;
  for (const layer::LayerPtr& layer : stage.used_layers()) {
    if (layer.get() != stage.session_layer()) {
      names.insert(layer_name(layer->identifier(), stage.root_layer().identifier()));
    }
  }
  Diagnostics reported;  // reading the physics says the same
  const stage::StageUnits units = stage::read_stage_units(stage, reported);
  Json result = Json::object();
  result["layers"] = names;
  result["defaultPrim"] = stage.root_layer().default_prim().str();
  result["upAxis"] = axis_name(units.up_axis);
  result["metersPerUnit"] = units.meters_per_unit;
  result["kilogramsPerUnit"] = units.kilograms_per_unit;
  result["timeCodesPerSecond"] = stage.time_codes_per_second();
  result["primCount"] = prim_count;
  return result;
}

Json counts_json(const scene::PhysicsCounts& counts) {
  Json joints = Json::object();
  for (std::size_t kind = 0; kind < counts.joints.size(); ++kind) {
    joints[std::string(scene::joint_kind_name(static_cast<scene::JointKind>(kind)))] =
        counts.joints[kind];
  }
  return {{"scenes", counts.scenes},
          {"bodies", counts.bodies},
          {"kinematicBodies", counts.kinematic_bodies},
          {"colliders", counts.colliders},
          {"staticColliders", counts.static_colliders},
          {"articulations", counts.articulations},
          {"drives", counts.drives},
          {"limits", counts.limits},
          {"mimics", counts.mimics},
          {"dofs", counts.dofs},
          {"mass_kg", counts.mass},
          {"joints", joints}};
}

Json missing_json(const stage::Stage& stage) {
  Json missing = Json::array();
  for (const compose::MissingArc& arc : stage.missing_arcs()) {
    missing.push_back({{"layer", layer_name(arc.layer, stage.root_layer().identifier())},
                       {"prim", arc.prim.str()},
                       {"arc", arc.arc},
                       {"path", arc.path}});
  }
  return missing;
}

}  // namespace

Json info_json(const stage::Stage& stage, const scene::PhysicsScene& scene) {
  std::size_t prim_count = 0;
  Json variants = Json::array();
  walk_prims(stage.pseudo_root(), [&](const stage::Prim& prim) {
    prim_count += prim.is_pseudo_root() ? 0u : 1u;
    add_variants(prim, variants);
  });
  Json info = Json::object();
  info["stage"] = stage_summary(stage, prim_count);
  info["variants"] = std::move(variants);
  info["physics"] = counts_json(scene::count_physics(scene));
  info["missing"] = missing_json(stage);
  return info;
}

}  // namespace tenon::answers
