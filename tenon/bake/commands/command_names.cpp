// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bake/commands/command_names.h"

#include <vector>

#include "tenon/bake/drive_names.h"
#include "tenon/base/text/nearest_name.h"
#include "tenon/math/angle.h"

namespace tenon::bake {

using scene::Index;

CommandNames::CommandNames(const scene::PhysicsScene& scene, const engines::Simulation& simulation)
    : scene_(scene) {
  for (Index j = 0; j < scene.joints.size(); ++j) {
    const scene::Joint& joint = scene.joints[j];
    const std::string path = joint.path.str();
    for (Index k = 0; k < joint.drives.size(); ++k) {
      const std::string label = drive_label(joint, k);
      known_[path + ".target" + label] = {CommandKind::Target, j, k};
      known_[path + ".velocityTarget" + label] = {CommandKind::VelocityTarget, j, k};
    }
    const std::size_t count = simulation.joint_state(j).position.size();
    for (Index k = 0; k < count; ++k) {
      known_[path + ".effort" + part_label(k, count)] = {CommandKind::Effort, j, k};
    }
  }
}

double CommandNames::unit_of(const CommandColumn& column) const {
  if (column.kind == CommandKind::Effort) {
    return 1;
  }
  return scene::is_angular(scene_.joints[column.joint].drives[column.part].dof)
             ? 1 / kDegreesPerRadian
             : scene_.meters_per_unit;
}

Result<CommandColumn> CommandNames::find(std::string_view name) const {
  const auto found = known_.find(name);
  if (found == known_.end()) {
    return Error(
               ErrorCode::NotFound,
               "the scene has no drive and no degree of freedom for the column " + shown_name(name))
        .with_rule("sim.commands")
        .with_fix(fix_for(name));
  }
  return found->second;
}

/// What could be meant: of the joint that the name begins with, where there is one, else of all.
std::string CommandNames::fix_for(std::string_view name) const {
  constexpr std::size_t kLongest = 500;
  const std::string path = std::string(name.substr(0, name.find('.'))) + ".";
  std::vector<std::string_view> names;
  std::string has;
  for (auto at = known_.lower_bound(path); at != known_.end() && at->first.starts_with(path);
       ++at) {
    names.push_back(at->first);
    if (has.size() < kLongest) {
      has += (has.empty() ? "" : ", ") + at->first.substr(path.size() - 1);
    }
  }
  if (names.empty()) {
    for (const auto& [column, what] : known_) {
      if (column.ends_with("/" + std::string(name))) {
        return "columns have the paths of joints: did you mean " + column + "?";
      }
      names.push_back(column);
    }
  }
  const std::string_view nearest =
      name.size() > kLongest ? std::string_view() : nearest_name(name, names);
  return !nearest.empty() ? "did you mean " + std::string(nearest) + "?"
         : !has.empty()   ? "this joint has " + has
         : known_.empty() ? "name a joint's .target, .velocityTarget or .effort"
                          : "name a joint's .target, .velocityTarget or .effort, such as " +
                                known_.begin()->first;
}

std::string shown_name(std::string_view name) {
  constexpr std::size_t kShown = 100;
  return "\"" + std::string(name.substr(0, kShown)) + (name.size() > kShown ? "..." : "") + "\"";
}

}  // namespace tenon::bake
