// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>

#include "tenon/asset/pairs/body_pairs.h"
#include "tenon/base/path.h"
#include "tenon/base/result.h"
#include "tenon/scene/physics_scene.h"

/// Internal to tenon/asset/pairs.
namespace tenon {

/// Bodies by the names of their prims, which are those of links in robots' descriptions.
class LinkNames {
 public:
  /// Errors: Invalid (pairs.same-name) for two bodies of one name.
  static Result<LinkNames> of(const scene::PhysicsScene& scene);

  std::optional<Path> find(const std::string& name) const;
  bool is_body(Path path) const;
  /// What to type instead of a name that no body has.
  std::string advice(const std::string& name) const;

 private:
  std::map<std::string, Path> bodies_;
};

/// Why SRDF disables collisions of a pair: "Adjacent", "Default", "Always", "Often", "User" where
/// the asset keeps it apart beside, "Never"; empty: it does not.
std::string srdf_reason(const BodyPair& pair);

}  // namespace tenon
