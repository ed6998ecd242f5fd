// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Engines weigh a body that nothing gives a mass as one unit, which makes hands of 0.5 kg weigh 6.
// A link without mass is therefore no body where that can be, has its colliders' mass where it has
// some (at the density that the options give), and else a share of a neighbour's mass that is too
// small to change a motion.
#include "tenon/convert/bodies.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "tenon/base/text/rounded_text.h"
#include "tenon/convert/prepare_joints.h"
#include "tenon/math/inertia.h"

namespace tenon::convert {

using layer::Value;
using robot::Index;

namespace {

/// Of the mass of a neighbour, for a link without mass; solvers still hold it.
constexpr double kRootShare = 1e-6;

/// What adding poses up the tree leaves behind a number's last digit.
Vec3d without_sum_errors(Vec3d metres) {
  constexpr double kSteps = 1e15;  // per metre: as far as a double of about 1 goes
  for (double& part : metres.v) {
    part = std::round(part * kSteps) / kSteps;
  }
  return metres;
}

void write_mass(LayerBuilder& builder, Path path, const robot::Inertial& inertial) {
  builder.apply(path, "PhysicsMassAPI");
  builder.set_number(path, "PhysicsMassAPI", "physics:mass", inertial.mass);
  builder.set_vector(path, "PhysicsMassAPI", "physics:centerOfMass",
                     without_noise(inertial.center_of_mass));
  const Mat3d inertia = inertial.inertia_in_link();
  if (inertia == Mat3d{}) {
    return;  // a mass without inertia: from the colliders
  }
  const PrincipalInertia principal = principal_inertia(inertia);
  builder.set_vector(path, "PhysicsMassAPI", "physics:diagonalInertia", principal.moments);
  // The moments are about these very axes, so all but signs of zeros stays.
  builder.set_value(path, "PhysicsMassAPI", "physics:principalAxes",
                    Value(to_float(with_plain_zeros(principal.axes))));
  // Floats and a turned frame round; Newton's form keeps the numbers.
  builder.apply(path, "NewtonMassAPI");
  builder.set_value(path, "NewtonMassAPI", "newton:inertia",
                    Value(std::vector<double>{inertia[0][0], inertia[1][1], inertia[2][2],
                                              inertia[0][1], inertia[0][2], inertia[1][2]}));
}

void write_root_share(RobotLayer& layer, Path path, const robot::Link& root,
                      const robot::Link& carried) {
  robot::Inertial share = *carried.inertial;
  share.mass *= kRootShare;
  for (auto& row : share.inertia.m) {
    for (double& moment : row) {
      moment *= kRootShare;
    }
  }
  write_mass(layer.builder(), path, share);
  layer.report(root.place, Severity::Warning, "convert.massless-root",
               "the root \"" + root.name + "\" has no mass: it gets a millionth of that of \"" +
                   carried.name + "\"",
               "");
}

/// A moving link without mass: engines would weigh it as one unit. So it gets a millionth of a
/// neighbour's mass, as round as can be, which changes no motion and lets solvers go on.
void write_share(RobotLayer& layer, const LinkPrim& prim, const robot::Link& link,
                 const robot::Link& neighbour) {
  const robot::Inertial& whole = *neighbour.inertial;
  const Vec3d moments = principal_inertia(whole.inertia).moments;
  const double mean = (moments[0] + moments[1] + moments[2]) / 3;
  robot::Inertial share;
  share.mass = whole.mass * kRootShare;
  share.inertia = diagonal_matrix(Vec3d{{1, 1, 1}} * (mean * kRootShare));
  write_mass(layer.builder(), prim.path, share);
  layer.report(link.place, prim.carries_mass ? Severity::Warning : Severity::Error,
               "convert.massless",
               "the link \"" + link.name + "\" moves and has no mass" +
                   (prim.carries_mass ? "" : ", nor has anything that it carries") +
                   ": it gets a millionth of that of \"" + neighbour.name + "\"",
               "give it an inertial");
}

/// A moving link that the description gives no mass.
void write_no_mass(RobotLayer& layer, const Source& source, const LinkPrim& prim,
                   const robot::Link& link) {
  const robot::RobotModel& model = source.model;
  if (source.options.density && !link.colliders.empty()) {
    layer.builder().apply(prim.path, "PhysicsMassAPI");
    layer.builder().set_number(prim.path, "PhysicsMassAPI", "physics:density",
                               *source.options.density);
    layer.report(link.place, Severity::Info, "convert.no-mass",
                 "the link \"" + link.name + "\" moves and has no mass; it gets that of its " +
                     "colliders at " + rounded_text(*source.options.density) + " kg/m^3",
                 "give it an inertial");
    return;
  }
  if (prim.mass_of && link.colliders.empty()) {
    write_share(layer, prim, link, model.links[*prim.mass_of]);
    return;
  }
  const std::string weighed =
      link.colliders.empty() ? "weigh it 1 kg" : "take that of its colliders";
  layer.report(link.place, Severity::Warning, "convert.no-mass",
               "the link \"" + link.name + "\" moves and has no mass; engines " + weighed,
               "give it an inertial");
}

/// A link that is no body.
void write_frame(RobotLayer& layer, const LinkPrim& prim, const robot::Link& link, bool is_root) {
  if (is_root && link.name != "world") {
    layer.report(link.place, Severity::Info, "convert.static-root",
                 "the root \"" + link.name +
                     "\" has no mass: it is not a body, and what fixed joints hold to it stands "
                     "still",
                 link.colliders.empty()
                     ? "give it an inertial where the robot is free to move"
                     : "convert with --float-base where the robot is free to move");
  }
  if (prim.role == LinkRole::Frame) {
    layer.builder().apply(prim.path, "IsaacSiteAPI");
  }
}

void write_own_mass(RobotLayer& layer, Path path, const robot::Link& link) {
  write_mass(layer.builder(), path, *link.inertial);
  if (link.inertial->inertia == Mat3d{}) {
    const std::string source = link.colliders.empty()
                                   ? "and it has no colliders to take one of: engines choose one"
                                   : "engines take that of its colliders";
    layer.report(link.place, Severity::Warning, "convert.no-inertia",
                 "the link \"" + link.name + "\" has a mass and no inertia; " + source,
                 "give it an inertia [kg m^2]");
  }
}

/// PhysX can only switch it off; the number is this program's own.
void write_gravity(LayerBuilder& builder, Path prim, double scale) {
  builder.set_custom(prim, "tenon:gravityScale", "float", Value(static_cast<float>(scale)));
  if (scale == 0) {
    builder.apply(prim, "PhysxRigidBodyAPI");
    builder.set_value(prim, "PhysxRigidBodyAPI", "physxRigidBody:disableGravity", Value(true));
  }
}

/// Its mass is that of its colliders, whatever their density.
bool is_weighed_by_colliders(const Source& source, const LinkPrims& links, Index number) {
  const robot::Link& link = source.model.links[number];
  const bool is_root = !source.tree.joint_to_parent[number];
  return links[number].role == LinkRole::Body && !has_mass(link) && !link.colliders.empty() &&
         !(is_root && links.carried);
}

}  // namespace

void note_unused_density(const Source& source, const LinkPrims& links, RobotLayer& layer) {
  if (!source.options.density) {
    return;
  }
  for (Index number = 0; number < source.model.links.size(); ++number) {
    if (is_weighed_by_colliders(source, links, number)) {
      return;
    }
  }
  layer.report({}, Severity::Info, "convert.without-effect",
               "--density has no effect: each link that moves has a mass, or has no colliders",
               "leave it out");
}

void write_body(const Source& source, const LinkPrims& links, Index number, RobotLayer& layer) {
  const robot::RobotModel& model = source.model;
  const LinkPrim& prim = links[number];
  const robot::Link& link = model.links[number];
  const std::optional<Index> above = source.tree.joint_to_parent[number];
  const bool relative = above && !(source.options.flat && prim.role != LinkRole::Frame);
  Pose pose =
      relative ? start_in_parent(model, model.joints[*above], source.options.start) : prim.in_robot;
  if (above && !relative) {
    pose.position = without_sum_errors(pose.position);
  }
  if (source.options.tutorial) {
    layer.set_tutorial_pose(prim.path, pose);
  } else {
    layer.set_pose(prim.path, pose);
  }
  if (prim.role != LinkRole::Body) {
    write_frame(layer, prim, link, !above);
    return;
  }
  layer.builder().apply(prim.path, "PhysicsRigidBodyAPI");
  if (has_mass(link)) {
    write_own_mass(layer, prim.path, link);
  } else if (!above && links.carried) {
    write_root_share(layer, prim.path, link, model.links[*links.carried]);
  } else {
    write_no_mass(layer, source, prim, link);
  }
  layer.builder().apply(prim.path, "IsaacLinkAPI");
  if (link.gravity_scale != 1) {
    write_gravity(layer.builder(), prim.path, link.gravity_scale);
  }
}

void write_excluded_pairs(const robot::RobotModel& model, const LinkPrims& links,
                          LayerBuilder& builder) {
  std::map<Path, std::vector<Path>> others;
  for (const auto& [a, b] : model.excluded_pairs) {
    const Path first = links.host(a).path;
    const Path second = links.host(b).path;
    if (first != second) {
      others[std::min(first, second)].push_back(std::max(first, second));
    }
  }
  for (auto& [path, list] : others) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    builder.apply(path, "PhysicsFilteredPairsAPI");
    builder.set_targets(path, "PhysicsFilteredPairsAPI", "physics:filteredPairs", std::move(list));
  }
}

}  // namespace tenon::convert
