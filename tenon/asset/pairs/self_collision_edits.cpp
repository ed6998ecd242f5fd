// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/pairs/self_collision_edits.h"

#include <array>
#include <map>
#include <utility>

#include "tenon/base/diagnostics.h"

namespace tenon {
namespace {

constexpr const char* kNewtonApi = "NewtonArticulationRootAPI";
constexpr const char* kNewtonFlag = "newton:selfCollisionEnabled";

/// A schema that says whether links touch each other, and its property.
constexpr std::array kForms{
    std::pair(kNewtonApi, kNewtonFlag),
    std::pair("PhysxArticulationAPI", "physxArticulation:enabledSelfCollisions"),
};

AssetEdit set_flag(Path root, const char* property, bool on) {
  AssetEdit edit;
  edit.kind = AssetEdit::Kind::SetProperty;
  edit.object = root.property(Token(property));
  edit.value = on ? "true" : "false";
  edit.may_rest = true;  // a form that another one wins over is not what engines of tenon read
  return edit;
}

AssetEdit apply_newton(Path root) {
  AssetEdit edit;
  edit.kind = AssetEdit::Kind::ApplyApi;
  edit.object = root;
  edit.api = Token(kNewtonApi);
  edit.may_rest = true;
  return edit;
}

}  // namespace

Result<std::vector<AssetEdit>> self_collision_edits(const std::string& path,
                                                    const scene::PhysicsScene& scene, bool on,
                                                    const EditOptions& options) {
  if (scene.articulations.empty()) {
    return Error(ErrorCode::NotFound, "the asset has no articulation whose links could touch")
        .in_file(path)
        .with_rule("pairs.no-articulation")
        .with_fix("apply PhysicsArticulationRootAPI to the prim of the robot");
  }
  Diagnostics ignored;  // of opening: edit_asset opens again and reports
  TENON_TRY(AssetEditor editor, AssetEditor::open(path, options, ignored));
  TENON_TRY(const auto views, editor.views());
  std::vector<AssetEdit> edits;
  for (const scene::Articulation& articulation : scene.articulations) {
    std::map<std::string, bool> found;  // by property, as it is under the first variant with it
    for (const AssetEditor::View& view : views) {
      const stage::Prim root = view.stage->prim(articulation.path);
      for (const auto& [api, property] : kForms) {
        if (root && root.has_api(Token(api))) {
          found.emplace(property, root.attribute(Token(property)).get_as<bool>().value_or(true));
        }
      }
    }
    if (found.empty() && articulation.self_collision != on) {
      edits.push_back(apply_newton(articulation.path));
      edits.push_back(set_flag(articulation.path, kNewtonFlag, on));
    }
    for (const auto& [property, is_on] : found) {
      if (is_on != on) {
        edits.push_back(set_flag(articulation.path, property.c_str(), on));
      }
    }
  }
  return edits;
}

}  // namespace tenon
