// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>

#include "tenon/base/limits.h"
#include "tenon/convert/conversion.h"
#include "tenon/math/inertia.h"

namespace tenon::convert {

using layer::Value;
using layer::Variability;
using robot::Index;
using robot::JointKind;

namespace {

/// What a text layer may nest, less what stands above and below links.
constexpr std::size_t kNestedLinks = limits::kTextNestingDepth - 20;

/// Of the mass of what a root without mass carries; solvers still hold it.
constexpr double kRootShare = 1e-6;

bool has_mass(const robot::Link& link) { return link.inertial && link.inertial->mass > 0; }

}  // namespace

/// Of a robot that is to float: the first link with mass that fixed joints hold to a root without.
/// ROS's own reader takes no inertia at the root, so robots begin with an empty link.
void Conversion::find_carried() {
  if (!options_.float_base) {
    return;
  }
  std::vector<bool> is_part(model_.links.size(), false);
  is_part[tree_.root] = true;
  for (const Index link : tree_.order) {
    const std::optional<Index> above = tree_.joint_to_parent[link];
    if (above && is_part[model_.joints[*above].parent] &&
        model_.joints[*above].kind == JointKind::Fixed) {
      if (has_mass(model_.links[link])) {
        carried_ = link;
        return;
      }
      is_part[link] = true;
    }
  }
}

LinkRole Conversion::role_of(Index link) const {
  if (has_mass(model_.links[link])) {
    return LinkRole::Body;
  }
  const std::optional<Index> above = tree_.joint_to_parent[link];
  if (!above) {
    return carried_ ? LinkRole::Body : LinkRole::Static;
  }
  return model_.joints[*above].kind == JointKind::Fixed ? LinkRole::Frame : LinkRole::Body;
}

Path Conversion::parent_path(Index link) const {
  const std::optional<Index> above = tree_.joint_to_parent[link];
  if (options_.flat && links_[link].role != LinkRole::Frame) {
    return robot_;
  }
  return above ? links_[model_.joints[*above].parent].path : robot_.child("Geometry");
}

Result<void> Conversion::place_links() {
  if (!options_.flat) {
    builder_.define(robot_, "Geometry", "Scope");
  }
  links_.resize(model_.links.size());
  find_carried();
  for (const Index link : tree_.order) {
    LinkPrim& prim = links_[link];
    prim.role = role_of(link);
    prim.host = link;
    if (const std::optional<Index> above = tree_.joint_to_parent[link]) {
      const robot::Joint& joint = model_.joints[*above];
      const LinkPrim& parent = links_[joint.parent];
      prim.in_robot = parent.in_robot * joint.origin;
      if (prim.role == LinkRole::Frame) {
        prim.host = parent.host;
        prim.in_host = parent.in_host * joint.origin;
      }
    }
    const Path parent = parent_path(link);
    if (parent.depth() > kNestedLinks) {
      return Error(ErrorCode::Limit, "the link \"" + model_.links[link].name +
                                         "\" is nested deeper than " +
                                         std::to_string(kNestedLinks) + " links")
          .in_file(model_.file)
          .at(model_.links[link].place.line, model_.links[link].place.column)
          .until(model_.links[link].place.end_line, model_.links[link].place.end_column)
          .with_rule("convert.too-deep")
          .with_fix("convert with --flat");
    }
    const Token name = link_names_.make(model_.links[link].name);
    prim.path = builder_.define(parent, name, "Xform");
    name_prim(prim.path, name, model_.links[link].name);
  }
  return {};
}

void Conversion::write_pose(Path prim, const Pose& pose, const Vec3d& scale) {
  std::vector<Token> order;
  if (!(pose.position == Vec3d{})) {
    builder_.set_attribute(prim, "xformOp:translate", "double3", Value(pose.position));
    order.emplace_back("xformOp:translate");
  }
  if (!(pose.orientation == kIdentityRotation)) {
    builder_.set_attribute(prim, "xformOp:orient", "quatd", Value(pose.orientation));
    order.emplace_back("xformOp:orient");
  }
  if (!(scale == Vec3d{{1, 1, 1}})) {
    builder_.set_attribute(prim, "xformOp:scale", "double3", Value(scale));
    order.emplace_back("xformOp:scale");
  }
  if (!order.empty()) {
    builder_.set_attribute(prim, "xformOpOrder", "token[]", Value(std::move(order)),
                           Variability::Uniform);
  }
}

void Conversion::write_mass(Path path, const robot::Inertial& inertial) {
  builder_.apply(path, "PhysicsMassAPI");
  builder_.set_number(path, "PhysicsMassAPI", "physics:mass", inertial.mass);
  builder_.set_vector(path, "PhysicsMassAPI", "physics:centerOfMass", inertial.center_of_mass);
  const Mat3d inertia = inertial.inertia_in_link();
  if (inertia == Mat3d{}) {
    return;  // a mass without inertia: from the colliders
  }
  const PrincipalInertia principal = principal_inertia(inertia);
  builder_.set_vector(path, "PhysicsMassAPI", "physics:diagonalInertia", principal.moments);
  builder_.set_rotation(path, "PhysicsMassAPI", "physics:principalAxes", principal.axes);
  // Floats and a turned frame round; Newton's form keeps the numbers.
  builder_.apply(path, "NewtonMassAPI");
  builder_.set_value(path, "NewtonMassAPI", "newton:inertia",
                     Value(std::vector<double>{inertia[0][0], inertia[1][1], inertia[2][2],
                                               inertia[0][1], inertia[0][2], inertia[1][2]}));
}

void Conversion::write_root_share(Path path, const robot::Link& root) {
  const robot::Link& carried = model_.links[*carried_];
  robot::Inertial share = *carried.inertial;
  share.mass *= kRootShare;
  for (auto& row : share.inertia.m) {
    for (double& moment : row) {
      moment *= kRootShare;
    }
  }
  write_mass(path, share);
  report(root.place, Severity::Warning, "convert.massless-root",
         "the root \"" + root.name + "\" has no mass: it gets a millionth of that of \"" +
             carried.name + "\"",
         "");
}

void Conversion::write_body(Index link) {
  const LinkPrim& prim = links_[link];
  const robot::Link& source = model_.links[link];
  const std::optional<Index> above = tree_.joint_to_parent[link];
  const bool relative = above && !(options_.flat && prim.role != LinkRole::Frame);
  write_pose(prim.path, relative ? model_.joints[*above].origin : prim.in_robot, {{1, 1, 1}});
  if (prim.role != LinkRole::Body) {
    if (!above && source.name != "world") {
      report(source.place, Severity::Info, "convert.static-root",
             "the root \"" + source.name +
                 "\" has no mass: it is not a body, and what fixed joints hold to it stands still",
             "convert with --float-base where the robot is free to move");
    }
    if (prim.role == LinkRole::Frame) {
      builder_.apply(prim.path, "IsaacSiteAPI");
    }
    return;
  }
  builder_.apply(prim.path, "PhysicsRigidBodyAPI");
  if (has_mass(source)) {
    write_mass(prim.path, *source.inertial);
    if (source.inertial->inertia == Mat3d{}) {
      report(source.place, Severity::Info, "convert.no-inertia",
             "the link \"" + source.name +
                 "\" has a mass and no inertia; engines take that of its colliders",
             "give it an inertia");
    }
  } else if (!above) {
    write_root_share(prim.path, source);
  } else {
    report(source.place, Severity::Warning, "convert.no-mass",
           "the link \"" + source.name +
               "\" moves and has no mass; engines take that of its colliders, or 1 kg",
           "give it an inertial");
  }
  builder_.apply(prim.path, "IsaacLinkAPI");
}

/// Pairs by prim path: of bodies, or of what stands still.
void Conversion::write_excluded_pairs() {
  std::map<Path, std::vector<Path>> others;
  for (const auto& [a, b] : model_.excluded_pairs) {
    const Path first = links_[links_[a].host].path;
    const Path second = links_[links_[b].host].path;
    if (first != second) {
      others[std::min(first, second)].push_back(std::max(first, second));
    }
  }
  for (auto& [path, list] : others) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    builder_.apply(path, "PhysicsFilteredPairsAPI");
    builder_.set_targets(path, "PhysicsFilteredPairsAPI", "physics:filteredPairs", std::move(list));
  }
}

}  // namespace tenon::convert
