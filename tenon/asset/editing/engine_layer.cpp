// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/editing/engine_layer.h"

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

#include "tenon/edit/layer_editor.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"
#include "tenon/structure/layout.h"
#include "tenon/structure/make/interface_layer.h"

namespace tenon {
namespace {

namespace fs = std::filesystem;
using structure::Role;

/// Of an engine that the structure has a place for.
bool has_a_place(const std::string& engine) {
  const Role role = structure::role_of_physics_variant(engine);
  return structure::is_engine(role) && role != Role::Engine;
}

}  // namespace

Result<layer::Layer> with_engine_variant(const layer::Layer& interface, const std::string& engine,
                                         const std::string& file) {
  layer::Layer edited = interface;
  edit::LayerEditor editor(edited);
  const std::string set(structure::kPhysicsSet);
  const Path robot = Path::absolute_root().child(interface.default_prim());
  TENON_CHECK(editor.create_variant(robot, set, engine));
  const fs::path folder = fs::path(interface.identifier()).parent_path();
  layer::Payload payload;
  payload.asset_path = "./" + fs::path(file).lexically_relative(folder).generic_string();
  editor.edit_list(robot.variant_selection(Token(set), Token(engine)), layer::fields::payload,
                   edit::ListEdit<layer::Payload>::add(payload));
  return edited;
}

Result<std::optional<EngineLayer>> missing_engine_layer(const layer::Layer& interface,
                                                        const std::string& engine) {
  if (!has_a_place(engine)) {
    return std::optional<EngineLayer>();
  }
  const structure::RolesOfFiles roles = structure::roles_of_files(interface, {});
  const auto file_with = [&](Role role) {
    return std::find_if(roles.begin(), roles.end(),
                        [&](const auto& file) { return file.second == role; });
  };
  const auto physics = file_with(Role::Physics);
  if (physics == roles.end() ||
      file_with(structure::role_of_physics_variant(engine)) != roles.end()) {
    return std::optional<EngineLayer>();
  }
  const fs::path shared(physics->first);
  layer::Layer file((shared.parent_path() / (engine + ".usda")).string());
  structure::put_stage_metadata(interface, file, true);
  file.root().set(layer::fields::subLayers,
                  std::vector<std::string>{"./" + shared.filename().string()});
  TENON_TRY(layer::Layer edited, with_engine_variant(interface, engine, file.identifier()));
  return std::optional(EngineLayer{std::move(edited), std::move(file)});
}

}  // namespace tenon
