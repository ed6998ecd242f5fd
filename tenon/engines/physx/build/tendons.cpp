// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Tendons of the asset, which PhysX has within one articulation: fixed ones are sums of
// coordinates, spatial ones go from point to point of its links. A spring that is slack between two
// lengths is one of PhysX's limits. A fixed tendon shares its stiffness out among its joints.
#include "tenon/engines/physx/build/tendons.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>

#include "tenon/engines/start_coordinates.h"

namespace tenon::engines::physx {
namespace {

using scene::Index;
using scene::Tendon;
using scene::TendonWrap;

/// Links from `link` up to the root, itself first.
std::vector<px::PxArticulationLink*> way_up(px::PxArticulationLink* link) {
  std::vector<px::PxArticulationLink*> way;
  while (link != nullptr) {
    way.push_back(link);
    px::PxArticulationJointReducedCoordinate* joint = link->getInboundJoint();
    link = joint == nullptr ? nullptr : &joint->getParentArticulationLink();
  }
  return way;
}

std::optional<px::PxArticulationAxis::Enum> free_axis(
    const px::PxArticulationJointReducedCoordinate& joint) {
  for (int axis = 0; axis < px::PxArticulationAxis::eCOUNT; ++axis) {
    const auto candidate = static_cast<px::PxArticulationAxis::Enum>(axis);
    if (joint.getMotion(candidate) != px::PxArticulationMotion::eLOCKED) {
      return candidate;
    }
  }
  return std::nullopt;
}

/// The tendon joints from below `top` down to `link`, made where they are missing.
using TendonJoints = std::map<px::PxArticulationLink*, px::PxArticulationTendonJoint*>;
bool reach(px::PxArticulationFixedTendon& tendon, px::PxArticulationLink* link,
           const TendonShares& shares, TendonJoints& made) {
  std::vector<px::PxArticulationLink*> missing;
  for (px::PxArticulationLink* at : way_up(link)) {
    if (made.contains(at)) {
      break;
    }
    missing.push_back(at);
  }
  std::reverse(missing.begin(), missing.end());
  for (px::PxArticulationLink* at : missing) {
    px::PxArticulationJointReducedCoordinate& joint = *at->getInboundJoint();
    const auto share = std::find_if(shares.begin(), shares.end(),
                                    [&](const auto& each) { return each.first == at; });
    const auto axis = share != shares.end() ? std::optional(share->second.axis) : free_axis(joint);
    if (!axis.has_value()) {
      return false;
    }
    const double coefficient = share != shares.end() ? share->second.coefficient : 0;
    made[at] = tendon.createTendonJoint(made.at(&joint.getParentArticulationLink()), *axis,
                                        to_px(coefficient), to_px(coefficient), at);
  }
  return true;
}

px::PxArticulationLink* common_link(px::PxArticulationLink* a, px::PxArticulationLink* b) {
  const std::vector<px::PxArticulationLink*> way = way_up(a);
  for (px::PxArticulationLink* at : way_up(b)) {
    if (std::find(way.begin(), way.end(), at) != way.end()) {
      return at;
    }
  }
  return nullptr;
}

/// Numbers of a tendon as PhysX has them.
struct TendonLaw {
  double stiffness = 0;
  double damping = 0;
  double rest = 0;
  double limit_stiffness = 0;
  double lower = -static_cast<double>(PX_MAX_F32);
  double upper = static_cast<double>(PX_MAX_F32);
};

/// `start` is the length at the start [rad or m].
TendonLaw law_of(Build& build, const Tendon& source, double start) {
  TendonLaw law;
  constexpr double kAsItStands = -1;
  const bool as_it_stands =
      source.spring_length[0] == kAsItStands && source.spring_length[1] == kAsItStands;
  const double low = as_it_stands ? start : source.spring_length[0];
  const double high = as_it_stands ? start : source.spring_length[1];
  law.damping = source.damping;
  if (source.range) {
    law.lower = (*source.range)[0];
    law.upper = (*source.range)[1];
    law.limit_stiffness = source.limit_stiffness > 0 ? source.limit_stiffness : kRigidTendon;
  }
  if (high <= low || source.stiffness == 0) {
    law.stiffness = source.stiffness;
    law.rest = low;
  } else if (!source.range) {
    law.lower = low;
    law.upper = high;
    law.limit_stiffness = source.stiffness;
  } else {
    build.report(source.path, "mjc:springlength",
                 "PhysX has limits or a slack spring for a tendon; it gets its limits");
  }
  if (source.friction > 0 || source.armature > 0) {
    build.report(source.path, "mjc:frictionloss, mjc:armature", "tendons of PhysX have none");
  }
  return law;
}

void write_law(const TendonLaw& law, double count, px::PxArticulationTendon& tendon) {
  tendon.setStiffness(to_px(law.stiffness * count));
  tendon.setDamping(to_px(law.damping * count));
  tendon.setLimitStiffness(to_px(law.limit_stiffness * count));
}

void leave_out(Build& build, const Tendon& tendon, const char* why) {
  build.report(tendon.path, "", std::string(why) + "; the tendon is skipped");
}

void add_fixed(Build& build, const Tendon& source) {
  TendonShares shares;
  std::optional<std::size_t> tree;
  double start = 0;
  for (std::size_t i = 0; i < source.joints.size(); ++i) {
    const Index joint = source.joints[i];
    const JointMap& map = build.model.joints[joint];
    const bool fits = map.role == JointRole::Reduced && map.dofs.free.size() == 1 &&
                      map.tree == tree.value_or(map.tree);
    if (!fits) {
      leave_out(build, source, "PhysX has tendons over coordinates of one articulation only");
      return;
    }
    tree = map.tree;
    shares.push_back(
        {&map.link_joint->getChildArticulationLink(), {source.coefficients[i], map.axis}});
    Diagnostics silent;
    start += source.coefficients[i] *
             start_coordinates(build.scene, build.scene.joints[joint], map.dofs, silent).front();
  }
  const auto [tendon, count] = make_fixed_tendon(*build.model.trees[*tree].articulation, shares);
  if (tendon == nullptr) {
    leave_out(build, source, "a joint on the way of the tendon has no coordinate of its own");
    return;
  }
  const TendonLaw law = law_of(build, source, start);
  tendon->setOffset(0);
  tendon->setRestLength(to_px(law.rest));
  tendon->setLimitParameters(px::PxArticulationTendonLimit(to_px(law.lower), to_px(law.upper)));
  write_law(law, count, *tendon);
}

/// What PhysX has of a path: points of links of one articulation, and the part that the way to each
/// has in the length.
struct PathPoint {
  Index body = 0;
  Vec3d in_body;
  double coefficient = 1;
};

std::vector<PathPoint> points_of(const Tendon& source) {
  std::vector<PathPoint> points;
  double part = 1;
  bool branches = false;  // a pulley came: the path goes on where it ended
  for (const TendonWrap& wrap : source.wraps) {
    if (wrap.kind == TendonWrap::Kind::Pulley) {
      part = 1 / wrap.divisor;
      branches = true;
      continue;
    }
    if (wrap.kind != TendonWrap::Kind::Site || !wrap.attachment.body) {
      return {};
    }
    const PathPoint point{*wrap.attachment.body, wrap.attachment.pose.position, part};
    const bool again = branches && !points.empty() && points.back().body == point.body &&
                       points.back().in_body == point.in_body;
    if (branches && !again) {
      return {};
    }
    if (!again) {
      points.push_back(point);
    }
    branches = false;
  }
  return points;
}

double length_at_start(const Build& build, const std::vector<PathPoint>& points) {
  double sum = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const auto world = [&](const PathPoint& point) {
      return transform_point(build.scene.bodies[point.body].pose, point.in_body);
    };
    sum += points[i].coefficient * length(world(points[i]) - world(points[i - 1]));
  }
  return sum;
}

px::PxArticulationReducedCoordinate* tree_of(const Build& build,
                                             const std::vector<PathPoint>& points) {
  px::PxArticulationReducedCoordinate* tree = nullptr;
  for (const PathPoint& point : points) {
    if (!build.model.is_link(point.body)) {
      return nullptr;
    }
    px::PxArticulationReducedCoordinate& own =
        static_cast<px::PxArticulationLink*>(build.model.bodies[point.body])->getArticulation();
    if (tree != nullptr && tree != &own) {
      return nullptr;
    }
    tree = &own;
  }
  return tree;
}

void add_spatial(Build& build, const Tendon& source) {
  const std::vector<PathPoint> points = points_of(source);
  px::PxArticulationReducedCoordinate* tree = tree_of(build, points);
  if (points.size() < 2 || tree == nullptr) {
    leave_out(build, source,
              "PhysX has tendons from point to point of links of one articulation only");
    return;
  }
  px::PxArticulationSpatialTendon* tendon = tree->createSpatialTendon();
  px::PxArticulationAttachment* last = nullptr;
  for (const PathPoint& point : points) {
    last = tendon->createAttachment(
        last, to_px(point.coefficient), to_px(point.in_body),
        static_cast<px::PxArticulationLink*>(build.model.bodies[point.body]));
  }
  const TendonLaw law = law_of(build, source, length_at_start(build, points));
  tendon->setOffset(0);
  last->setRestLength(to_px(law.rest));
  last->setLimitParameters(px::PxArticulationTendonLimit(to_px(law.lower), to_px(law.upper)));
  write_law(law, 1, *tendon);
}

}  // namespace

FixedTendon make_fixed_tendon(px::PxArticulationReducedCoordinate& tree,
                              const TendonShares& shares) {
  px::PxArticulationLink* top = nullptr;
  for (const auto& [link, share] : shares) {
    px::PxArticulationLink* parent = &link->getInboundJoint()->getParentArticulationLink();
    top = top == nullptr ? parent : common_link(top, parent);
  }
  px::PxArticulationFixedTendon* tendon = tree.createFixedTendon();
  TendonJoints made;
  made[top] = tendon->createTendonJoint(nullptr, px::PxArticulationAxis::eTWIST, 0, 0, top);
  for (const auto& [link, share] : shares) {
    if (!reach(*tendon, link, shares, made)) {
      tendon->release();
      return {};
    }
  }
  return {tendon, static_cast<double>(made.size() - 1)};
}

void add_tendons(Build& build) {
  for (const Tendon& tendon : build.scene.tendons) {
    if (tendon.joints.empty()) {
      add_spatial(build, tendon);
    } else {
      add_fixed(build, tendon);
    }
  }
}

}  // namespace tenon::engines::physx
