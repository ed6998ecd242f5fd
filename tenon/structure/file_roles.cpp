// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <unordered_map>

#include "tenon/structure/layer_arcs.h"
#include "tenon/structure/layout.h"

namespace tenon::structure {
namespace {

namespace fs = std::filesystem;

/// The role that an arc of a file gives to what it leads to; Other when it gives none.
Role role_by_arc(Role from, const LayerArc& arc) {
  const std::string scope = arc.target.empty() ? "" : arc.target.prefixes()[1].name().str();
  switch (from) {
    case Role::Interface:
      if (arc.kind == Arc::Reference) {
        return Role::Base;
      }
      if (arc.kind == Arc::Payload && arc.spec.is_variant_selection()) {
        return arc.spec.name() == kPhysicsSet ? role_of_physics_variant(arc.spec.variant().view())
                                              : Role::Variant;
      }
      return Role::Other;
    case Role::Base:
    case Role::Instances:
      for (const Role role : {Role::Geometries, Role::Materials, Role::Instances}) {
        if (arc.kind == Arc::Reference && scope == root_scope(role)) {
          return role;
        }
      }
      return from == Role::Base && arc.kind != Arc::Payload ? Role::Robot : Role::Other;
    default:
      return is_engine(from) && arc.kind == Arc::SubLayer ? Role::Physics : Role::Other;
  }
}

bool leads_to_a_base(const layer::Layer& interface) {
  const Path prim = Path::absolute_root().child(interface.default_prim());
  for (const LayerArc& arc : arcs_of(interface)) {
    const bool on_prim = arc.spec == prim && arc.kind == Arc::Reference;
    const std::string name = fs::path(arc.asset_path).stem().string();
    if (on_prim && name == role_name(Role::Base)) {
      return true;
    }
  }
  return false;
}

class Finder {
 public:
  explicit Finder(const std::vector<layer::LayerPtr>& layers) {
    for (const layer::LayerPtr& layer : layers) {
      layers_.emplace(layer->identifier(), layer.get());
    }
  }

  RolesOfFiles run(const layer::Layer& interface) {
    add(interface.identifier(), Role::Interface, &interface);
    while (!pending_.empty()) {
      const Step step = pending_.back();
      pending_.pop_back();
      for (const LayerArc& arc : arcs_of(*step.layer)) {
        if (!arc.asset_path.empty()) {
          follow(step, arc);
        }
      }
    }
    return std::move(roles_);
  }

 private:
  struct Step {
    const layer::Layer* layer;
    Role role;
  };

  void follow(const Step& from, const LayerArc& arc) {
    const std::string target = target_of(arc.asset_path, *from.layer);
    const auto found = layers_.find(target);
    const Role role = role_by_arc(from.role, arc);
    if (role != Role::Other) {
      add(target, role, found == layers_.end() ? nullptr : found->second);
    }
  }

  void add(const std::string& identifier, Role role, const layer::Layer* layer) {
    if (roles_.emplace(identifier, role).second && layer != nullptr) {
      pending_.push_back({layer, role});
    }
  }

  std::unordered_map<std::string, const layer::Layer*> layers_;
  std::vector<Step> pending_;
  RolesOfFiles roles_;
};

}  // namespace

std::string target_of(std::string_view asset_path, const layer::Layer& anchor) {
  const fs::path path(asset_path);
  const fs::path folder = fs::path(anchor.identifier()).parent_path();
  return (path.is_absolute() ? path : folder / path).lexically_normal().generic_string();
}

RolesOfFiles roles_of_files(const layer::Layer& interface,
                            const std::vector<layer::LayerPtr>& layers) {
  if (!leads_to_a_base(interface)) {
    return {};
  }
  RolesOfFiles roles = Finder(layers).run(interface);
  const fs::path folder = fs::path(interface.identifier()).parent_path();
  for (const layer::LayerPtr& layer : layers) {
    const std::string place =
        fs::path(layer->identifier()).lexically_relative(folder).generic_string();
    const Role role = role_of_file_name(place);
    if (role != Role::Interface && role != Role::Other) {
      roles.emplace(layer->identifier(), role);
    }
  }
  return roles;
}

}  // namespace tenon::structure
