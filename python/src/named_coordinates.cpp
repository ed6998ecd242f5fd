// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Unlike texts of poses (tenon/dynamics/posture_text.h), which may move many joints by one name, a
// name means exactly one here, since each gives one number.
#include "named_coordinates.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <unordered_map>

#include "tenon/base/text/nearest_name.h"
#include "tenon/base/text/quoted_text.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::python {
namespace {

using dynamics::Coordinate;
using dynamics::Multibody;
using scene::Index;

constexpr std::size_t kLongestName = 200;  // for which a similar one is looked for
constexpr std::size_t kListed = 8;

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size() && i < kListed; ++i) {
    text += (i == 0 ? "" : ", ") + names[i];
  }
  return names.size() > kListed ? text + ", ..." : text;
}

/// The objects of a list of the scene by their paths and names.
template <class Object>
class ByName {
 public:
  /// `one` and `many` are words for them, `other_way` is said behind the paths of those that share
  /// a name. `objects` must outlive it.
  ByName(const std::vector<Object>& objects, std::string one, std::string many,
         std::string other_way)
      : objects_(objects),
        one_(std::move(one)),
        many_(std::move(many)),
        other_way_(std::move(other_way)) {
    for (Index i = 0; i < objects.size(); ++i) {
      if (!objects[i].path.empty()) {
        found_[objects[i].path.str()].push_back(i);
        found_[objects[i].path.name().str()].push_back(i);
      }
    }
  }

  Result<Index> find(const std::string& name) const {
    const auto found = found_.find(name);
    if (found == found_.end()) {
      return unknown(name);
    }
    if (found->second.size() == 1) {
      return found->second.front();
    }
    std::vector<std::string> paths;
    for (const Index i : found->second) {
      paths.push_back(objects_[i].path.str());
    }
    return Error(ErrorCode::Invalid,
                 std::to_string(paths.size()) + " " + many_ + " are called " + quoted_text(name))
        .with_rule("dynamics.no-" + one_)
        .with_fix("give the path of one: " + listed(paths) + other_way_);
  }

 private:
  Error unknown(const std::string& name) const {
    const bool is_path = name.starts_with('/');
    std::vector<std::string> names;
    for (const Object& object : objects_) {
      if (!object.path.empty()) {
        names.push_back(is_path ? object.path.str() : object.path.name().str());
      }
    }
    const std::vector<std::string_view> views(names.begin(), names.end());
    const std::string near(name.size() < kLongestName ? nearest_name(name, views)
                                                      : std::string_view());
    return Error(ErrorCode::NotFound, "the scene has no " + one_ + " " + quoted_text(name))
        .with_rule("dynamics.no-" + one_)
        .with_fix(near.empty() ? (names.empty() ? "" : "it has " + listed(names))
                               : "did you mean " + near + "?");
  }

  const std::vector<Object>& objects_;
  std::string one_;
  std::string many_;
  std::string other_way_;
  std::unordered_map<std::string, std::vector<Index>> found_;
};

using JointsByName = ByName<scene::Joint>;

JointsByName joints_by_name(const Multibody& multibody) {
  return {multibody.scene().joints, "joint", "joints", ""};
}

/// Why a joint has no coordinate.
Error no_coordinate(const Multibody& multibody, Index joint) {
  const scene::ForestRole role = multibody.forest().joints[joint];
  const std::string path = multibody.scene().joints[joint].path.str();
  const bool closes = role == scene::ForestRole::Loop;
  const char* why = closes ? " has no coordinate of its own: it closes a loop, or bounds a distance"
                    : role == scene::ForestRole::None
                        ? " has no coordinate: it is disabled, or both its sides are the same"
                        : " has no coordinate: it leaves nothing free";
  return Error(ErrorCode::NotFound, path + why)
      .with_prim(path)
      .with_rule("dynamics.no-dof")
      .with_fix(closes ? "name the other joints of the loop, which move it"
                       : "Dynamics.coordinates lists what moves");
}

/// "/hand/joint:rotX" as joint and degree of freedom.
std::pair<std::string, std::string> parts_of(const std::string& joint, const std::string& dof) {
  const std::size_t colon = joint.rfind(':');
  if (!dof.empty() || colon == std::string::npos || colon + 1 == joint.size()) {
    return {joint, dof};
  }
  return {joint.substr(0, colon), joint.substr(colon + 1)};
}

Result<std::size_t> find_coordinate(const Multibody& multibody, const JointsByName& joints,
                                    const std::string& joint, const std::string& dof) {
  const auto [name, part] = parts_of(joint, dof);
  TENON_TRY(const Index found, joints.find(name));
  const std::vector<Coordinate>& coordinates = multibody.coordinates();
  std::vector<std::size_t> own;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    if (coordinates[i].joint == found) {
      own.push_back(i);
      names.emplace_back(scene::dof_name(coordinates[i].dof));
      if (names.back() == part) {
        return i;
      }
    }
  }
  const std::string path = multibody.scene().joints[found].path.str();
  if (own.empty()) {
    return no_coordinate(multibody, found);
  }
  if (!part.empty()) {
    return Error(ErrorCode::NotFound, path + " has no degree of freedom " + quoted_text(part))
        .with_prim(path)
        .with_rule("dynamics.no-dof")
        .with_fix("it has " + listed(names));
  }
  if (own.size() > 1) {
    return Error(ErrorCode::Invalid, path + " has several degrees of freedom: " + listed(names))
        .with_prim(path)
        .with_rule("dynamics.no-dof")
        .with_fix("name one, as in " + quoted_text(name + ":" + names.front()));
  }
  return own.front();
}

}  // namespace

Result<std::size_t> coordinate_named(const Multibody& multibody, const std::string& joint,
                                     const std::string& dof) {
  return find_coordinate(multibody, joints_by_name(multibody), joint, dof);
}

Result<Index> body_named(const scene::PhysicsScene& scene, const std::string& body) {
  return ByName<scene::Body>(scene.bodies, "body", "bodies", ", or its index").find(body);
}

Result<dynamics::Posture> posture_from_values(
    const Multibody& multibody, const std::vector<std::pair<std::string, double>>& values) {
  const auto bad = [](const std::string& message, const std::string& fix) {
    return Error(ErrorCode::Invalid, message).with_rule("pose.bad-value").with_fix(fix);
  };
  const scene::PhysicsScene& scene = multibody.scene();
  dynamics::Posture start = multibody.start();
  std::vector<std::vector<double>> joints = start.joints;
  const JointsByName by_name = joints_by_name(multibody);
  for (const auto& [name, value] : values) {
    TENON_TRY(const std::size_t i, find_coordinate(multibody, by_name, name, ""));
    const Coordinate& coordinate = multibody.coordinates()[i];
    const scene::Joint& joint = scene.joints[*coordinate.joint];
    if (!std::isfinite(value)) {
      return bad(joint.path.str() + " cannot be put to a number that is not finite",
                 "give m or rad");
    }
    if (!multibody.coordinate_of(*coordinate.joint, coordinate.dof)) {
      return bad(joint.path.str() + " turns as a ball, which no single number describes",
                 "leave it out: it stays as it is at the start");
    }
    for (const scene::Mimic& mimic : joint.mimics) {
      if (mimic.dof == coordinate.dof) {
        return bad(joint.path.str() + " follows another joint",
                   "move its leader, " + scene.joints[mimic.leader].path.str());
      }
    }
    joints[*coordinate.joint][coordinate.part] = value;
  }
  return multibody.moved(start, std::move(joints));
}

}  // namespace tenon::python
