// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// In a model of SDFormat 1.7 and later links, joints and frames share one space of names, "::"
// separates scopes, and "world" and names between two underscores on each side are reserved. Its
// joints have no plane, so a planar joint is two slides and a hinge; engines refuse links that move
// and weigh nothing, so each link between has a millionth of the child's inertia.
#include "tenon/sdf/plain_sdf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "tenon/base/file_finding.h"
#include "tenon/base/text/unique_names.h"

namespace tenon::sdf {

using robot::Index;
using robot::JointKind;

namespace {

constexpr double kBetween = 1e-6;        // of the child's mass and inertia
constexpr double kSmallestMass = 1e-9;   // [kg], [kg m^2] where a link has none
constexpr std::size_t kListedNames = 8;  // that one message names

class PlainSdf {
 public:
  PlainSdf(robot::RobotModel& model, Diagnostics& diagnostics)
      : model_(model), diagnostics_(diagnostics) {}

  void run() {
    move_shapes();
    const std::size_t count = model_.joints.size();
    for (std::size_t i = 0; i < count; ++i) {
      if (model_.joints[i].kind == JointKind::Planar) {
        spread_plane(i);
      }
    }
    for (robot::Link& link : model_.links) {
      weigh(link);
    }
    name_parts();
  }

 private:
  void report(Severity severity, std::string message) {
    diagnostics_.add(file_finding(severity, "sdf.replaced", std::move(message), ""));
  }

  /// Shapes of frames go to the links that these belong to.
  void move_shapes() {
    const Carriers carriers = carriers_of(model_);
    for (Index i = 0; i < model_.links.size(); ++i) {
      if (carriers.is_frame[i] == 0) {
        continue;
      }
      robot::Link& from = model_.links[i];
      robot::Link& to = model_.links[carriers.link[i]];
      for (robot::Visual& visual : from.visuals) {
        visual.pose = carriers.pose[i] * visual.pose;
        to.visuals.push_back(std::move(visual));
      }
      for (robot::Collider& collider : from.colliders) {
        collider.pose = carriers.pose[i] * collider.pose;
        to.colliders.push_back(std::move(collider));
      }
      from.visuals.clear();
      from.colliders.clear();
    }
  }

  Index add_between(const std::string& name, const robot::Link& child) {
    robot::Link link;
    link.name = name;
    link.gravity_scale = child.gravity_scale;
    robot::Inertial& inertial = link.inertial.emplace();
    inertial.mass = kSmallestMass;
    double moment = kSmallestMass;
    if (child.inertial && child.inertial->mass > 0) {
      const Mat3d whole = child.inertial->inertia_in_link();
      inertial.mass = kBetween * child.inertial->mass;
      moment = kBetween * std::max({whole[0][0], whole[1][1], whole[2][2]});
    }
    inertial.inertia = Mat3d{};
    for (std::size_t k = 0; k < 3; ++k) {
      inertial.inertia[k][k] = moment;
    }
    model_.links.push_back(std::move(link));
    return static_cast<Index>(model_.links.size() - 1);
  }

  /// The joint itself becomes the first slide; it turns last, as the child's frame does.
  void spread_plane(std::size_t number) {
    const robot::Joint joint = model_.joints[number];
    const robot::Link child = model_.links[joint.child];
    const std::array<Index, 2> between = {add_between(joint.name + "_x_link", child),
                                          add_between(joint.name + "_y_link", child)};
    report(Severity::Warning, "the planar joint \"" + joint.name +
                                  "\", which SDF does not have, is written as two slides and a "
                                  "hinge with two links of a millionth of the mass of \"" +
                                  child.name + "\" between");
    const Vec3d normal = rotate(joint.frame.orientation, joint.axis);
    const std::size_t least = std::fabs(normal[0]) < 0.9 ? 0 : 1;
    Vec3d helper;
    helper[least] = 1;
    const Vec3d along = normalized(cross(helper, normal));
    const Pose anchor{joint.frame.position, kIdentityRotation};
    robot::Joint part = joint;
    part.origin = joint.origin * anchor;
    part.frame = {};
    part.kind = JointKind::Prismatic;
    part.limit.reset();
    part.axis = along;
    part.name = joint.name + "_x";
    part.child = between[0];
    model_.joints[number] = part;
    part.origin = {};
    part.axis = cross(normal, along);
    part.name = joint.name + "_y";
    part.parent = between[0];
    part.child = between[1];
    model_.joints.push_back(part);
    part.origin = inverse(anchor);
    part.frame = anchor;
    part.kind = JointKind::Continuous;
    part.axis = normal;
    part.name = joint.name;
    part.parent = between[1];
    part.child = joint.child;
    model_.joints.push_back(part);
  }

  void weigh(robot::Link& link) {
    if (!link.inertial) {
      return;
    }
    const Mat3d inertia = link.inertial->inertia_in_link();
    const bool has_moments = inertia[0][0] > 0 && inertia[1][1] > 0 && inertia[2][2] > 0;
    if (link.inertial->mass > 0 && has_moments) {
      return;
    }
    link.inertial->mass = std::max(link.inertial->mass, kSmallestMass);
    if (!has_moments) {
      link.inertial->axes = kIdentityRotation;
      link.inertial->inertia = Mat3d{};
      for (std::size_t k = 0; k < 3; ++k) {
        link.inertial->inertia[k][k] = kSmallestMass;
      }
    }
    report(Severity::Warning, "the link \"" + link.name +
                                  "\" has no mass or no inertia, which readers of SDF refuse; "
                                  "1e-9 kg or kg m^2 is written");
  }

  std::string free_name(const std::string& wanted, const char* kind) {
    std::string name = wanted;
    for (std::size_t at = name.find("::"); at != std::string::npos; at = name.find("::", at)) {
      name.replace(at, 2, "__");
    }
    const bool reserved = name.empty() || name == "world" ||
                          (name.size() >= 4 && name.starts_with("__") && name.ends_with("__"));
    if (reserved || taken_.is_taken(name)) {
      name += std::string(name.empty() ? "" : "_") + kind;
    }
    name = taken_.make(name);
    if (name != wanted) {
      renamed_.push_back("\"" + wanted + "\" as \"" + name + "\"");
    }
    return name;
  }

  void name_parts() {
    const Carriers carriers = carriers_of(model_);
    for (Index i = 0; i < model_.links.size(); ++i) {
      robot::Link& link = model_.links[i];
      const bool unwritten = i == carriers.root && carriers.root_is_world && link.visuals.empty() &&
                             link.colliders.empty();
      if (!unwritten) {
        link.name = free_name(link.name, carriers.is_frame[i] != 0 ? "frame" : "link");
      }
      for (robot::Site& site : link.sites) {
        site.name = free_name(site.name, "frame");
      }
      name_shapes(link.visuals, "visual");
      name_shapes(link.colliders, "collision");
    }
    for (robot::Joint& joint : model_.joints) {
      const bool unwritten =
          joint.kind == JointKind::Floating || carriers.is_frame[joint.child] != 0;
      if (!unwritten) {
        joint.name = free_name(joint.name, "joint");
      }
    }
    if (renamed_.empty()) {
      return;
    }
    std::string list;
    for (std::size_t i = 0; i < std::min(renamed_.size(), kListedNames); ++i) {
      list += (i == 0 ? "" : ", ") + renamed_[i];
    }
    if (renamed_.size() > kListedNames) {
      list += " and " + std::to_string(renamed_.size() - kListedNames) + " more";
    }
    report(Severity::Info,
           "names that SDF reserves, or that two parts have, are written as others: " + list);
  }

  /// Each has a name, and no two of a link the same.
  template <class Shape>
  static void name_shapes(std::vector<Shape>& shapes, const char* kind) {
    UniqueNames names;
    for (Shape& shape : shapes) {
      shape.name = names.make(shape.name.empty() ? kind : shape.name);
    }
  }

  robot::RobotModel& model_;
  Diagnostics& diagnostics_;
  UniqueNames taken_;
  std::vector<std::string> renamed_;
};

}  // namespace

Carriers carriers_of(const robot::RobotModel& model) {
  const std::size_t count = model.links.size();
  Carriers result;
  result.link.resize(count);
  result.pose.resize(count);
  result.is_frame.assign(count, 0);
  std::vector<std::vector<Index>> below(count);
  std::vector<char> carried(count, 0);
  for (Index i = 0; i < model.joints.size(); ++i) {
    below[model.joints[i].parent].push_back(i);
    carried[model.joints[i].child] = 1;
  }
  std::vector<Index> pending;
  for (Index i = 0; i < count; ++i) {
    result.link[i] = i;
    if (carried[i] == 0) {
      pending.push_back(i);
    }
  }
  result.root = pending.empty() ? 0 : pending.front();
  result.root_is_world = count > 0 && !model.links[result.root].inertial;
  while (!pending.empty()) {
    const Index at = pending.back();
    pending.pop_back();
    for (const Index number : below[at]) {
      const robot::Joint& joint = model.joints[number];
      if (joint.kind == JointKind::Fixed && !model.links[joint.child].inertial) {
        result.is_frame[joint.child] = 1;
        result.link[joint.child] = result.link[at];
        result.pose[joint.child] = result.pose[at] * joint.origin;
      }
      pending.push_back(joint.child);
    }
  }
  return result;
}

void make_plain(robot::RobotModel& model, Diagnostics& diagnostics) {
  PlainSdf(model, diagnostics).run();
}

}  // namespace tenon::sdf
