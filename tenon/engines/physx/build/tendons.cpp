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

/// The joint above a link, if it has a coordinate.
std::optional<Index> coordinate_of(const Model& model, const px::PxArticulationLink* link) {
  for (Index j = 0; j < model.joints.size(); ++j) {
    const JointMap& map = model.joints[j];
    if (map.role == JointRole::Reduced && !map.dofs.ball && map.dofs.free.size() == 1 &&
        &map.link_joint->getChildArticulationLink() == link) {
      return j;
    }
  }
  return std::nullopt;
}

/// Makes the tendon joints from below `top` down to `link` where they are missing.
using PartOfLink = std::map<px::PxArticulationLink*, std::size_t>;
bool reach(const Model& model, px::PxArticulationTendonJoint* top, px::PxArticulationLink* top_link,
           px::PxArticulationLink* link, const std::vector<TendonShare>& shares, PartOfLink& made,
           FixedTendonLaw& law) {
  std::vector<px::PxArticulationLink*> missing;
  for (px::PxArticulationLink* at : way_up(link)) {
    if (at == top_link || made.contains(at)) {
      break;
    }
    missing.push_back(at);
  }
  std::reverse(missing.begin(), missing.end());
  for (px::PxArticulationLink* at : missing) {
    const std::optional<Index> joint = coordinate_of(model, at);
    if (!joint) {
      return false;
    }
    TendonPart part;
    part.joint = *joint;
    part.axis = model.joints[*joint].axis;
    const auto share = std::find_if(shares.begin(), shares.end(),
                                    [&](const TendonShare& each) { return each.joint == *joint; });
    part.share = share != shares.end() ? share->coefficient : 0;
    const auto above = made.find(&at->getInboundJoint()->getParentArticulationLink());
    px::PxArticulationTendonJoint* parent = top;
    if (above != made.end()) {
      part.above = above->second;
      parent = law.parts[above->second].made;
    }
    part.made =
        law.tendon->createTendonJoint(parent, part.axis, to_px(part.share), to_px(part.share), at);
    made[at] = law.parts.size();
    law.parts.push_back(part);
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

/// PhysX shares a stiffness out among `count` joints.
void write_law(const TendonLaw& law, double count, px::PxArticulationTendon& tendon) {
  tendon.setStiffness(to_px(law.stiffness * count));
  tendon.setDamping(to_px(law.damping * count));
  tendon.setLimitStiffness(to_px(law.limit_stiffness * count));
}

void leave_out(Build& build, const Tendon& tendon, const char* why) {
  build.report(tendon.path, "", std::string(why) + "; the tendon is skipped");
}

void add_fixed(Build& build, const Tendon& source) {
  std::vector<TendonShare> shares;
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
    shares.push_back({joint, source.coefficients[i]});
    Diagnostics silent;
    start += source.coefficients[i] *
             start_coordinates(build.scene, build.scene.joints[joint], map.dofs, silent).front();
  }
  FixedTendonLaw made = make_fixed_tendon(build, *tree, shares);
  if (made.tendon == nullptr) {
    leave_out(build, source, "a joint on the way of the tendon has no coordinate of its own");
    return;
  }
  const TendonLaw law = law_of(build, source, start);
  made.tendon->setOffset(0);
  made.tendon->setRestLength(to_px(law.rest));
  made.tendon->setLimitParameters(
      px::PxArticulationTendonLimit(to_px(law.lower), to_px(law.upper)));
  write_law(law, static_cast<double>(made.parts.size()), *made.tendon);
  made.stiffness = law.stiffness > 0 || law.damping > 0 ? law.stiffness : law.limit_stiffness;
  made.damping = law.damping;
  build.model.tendons.push_back(std::move(made));
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

FixedTendonLaw make_fixed_tendon(Build& build, std::size_t tree,
                                 const std::vector<TendonShare>& shares) {
  const auto link_of = [&](const TendonShare& share) {
    return &build.model.joints[share.joint].link_joint->getChildArticulationLink();
  };
  px::PxArticulationLink* top = nullptr;
  for (const TendonShare& share : shares) {
    px::PxArticulationLink* parent =
        &link_of(share)->getInboundJoint()->getParentArticulationLink();
    top = top == nullptr ? parent : common_link(top, parent);
  }
  FixedTendonLaw law;
  law.tendon = build.model.trees[tree].articulation->createFixedTendon();
  px::PxArticulationTendonJoint* first =
      law.tendon->createTendonJoint(nullptr, px::PxArticulationAxis::eTWIST, 0, 0, top);
  PartOfLink made;
  for (const TendonShare& share : shares) {
    if (!reach(build.model, first, top, link_of(share), shares, made, law)) {
      law.tendon->release();
      return {};
    }
  }
  return law;
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
