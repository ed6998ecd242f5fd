// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "tenon/bake/commands/commands.h"
#include "tenon/base/result.h"
#include "tenon/engines/simulation.h"
#include "tenon/scene/physics_scene.h"

/// Which columns a file of commands may have.
namespace tenon::bake {

/// Every name that a column could have: what a file names is either found there or an error that
/// says what is nearest.
class CommandNames {
 public:
  CommandNames(const scene::PhysicsScene& scene, const engines::Simulation& simulation);

  /// "/hand/joint.target", ".velocityTarget.rotX", ".effort.0". NotFound, without a place.
  Result<CommandColumn> find(std::string_view name) const;
  /// How many SI units one unit of the column is.
  double unit_of(const CommandColumn& column) const;

 private:
  std::string fix_for(std::string_view name) const;

  const scene::PhysicsScene& scene_;
  std::map<std::string, CommandColumn, std::less<>> known_;
};

/// At most 100 bytes of a name for a message, in quotes.
std::string shown_name(std::string_view name);

}  // namespace tenon::bake
