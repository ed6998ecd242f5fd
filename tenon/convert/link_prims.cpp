// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/convert/link_prims.h"

#include "tenon/base/limits/limits.h"
#include "tenon/convert/prepare_joints.h"

namespace tenon::convert {

using robot::Index;
using robot::JointKind;

namespace {

/// The nesting that a text layer allows, less the levels above and below links.
constexpr std::size_t kNestedLinks = limits::kTextNestingDepth - 20;

/// Of a robot that is to float: the first link with mass that fixed joints hold to a root without.
/// ROS's own reader takes no inertia at the root, so robots begin with an empty link.
std::optional<Index> find_carried(const Source& source) {
  if (!source.options.float_base) {
    return std::nullopt;
  }
  const auto& [model, tree, options] = source;
  std::vector<bool> is_part(model.links.size(), false);
  is_part[tree.root] = true;
  for (const Index link : tree.order) {
    const std::optional<Index> above = tree.joint_to_parent[link];
    if (above && is_part[model.joints[*above].parent] &&
        model.joints[*above].kind == JointKind::Fixed) {
      if (has_mass(model.links[link])) {
        return link;
      }
      is_part[link] = true;
    }
  }
  return std::nullopt;
}

LinkRole role_of(const Source& source, Index link, bool root_moves) {
  const robot::Link& described = source.model.links[link];
  if (has_mass(described)) {
    return LinkRole::Body;
  }
  const std::optional<Index> above = source.tree.joint_to_parent[link];
  if (!above) {
    const bool weighs = source.options.float_base && !described.colliders.empty();
    return root_moves || weighs ? LinkRole::Body : LinkRole::Static;
  }
  return source.model.joints[*above].kind == JointKind::Fixed ? LinkRole::Frame : LinkRole::Body;
}

/// Whose mass each link shares (LinkPrim::mass_of): upward for what hangs on it, then downward.
void find_shares(const Source& source, LinkPrims& links) {
  const auto& [model, tree, options] = source;
  for (auto at = tree.order.rbegin(); at != tree.order.rend(); ++at) {
    LinkPrim& prim = links.prims[*at];
    if (has_mass(model.links[*at])) {
      prim.mass_of = *at;
    }
    if (const std::optional<Index> above = tree.joint_to_parent[*at]; above && prim.mass_of) {
      links.prims[model.joints[*above].parent].mass_of = prim.mass_of;
    }
  }
  for (const Index link : tree.order) {
    LinkPrim& prim = links.prims[link];
    const std::optional<Index> above = tree.joint_to_parent[link];
    prim.carries_mass = prim.mass_of.has_value();
    if (!prim.mass_of && above) {
      prim.mass_of = links[model.joints[*above].parent].mass_of;
    }
  }
}

/// A link without its path; `links` has those above it.
LinkPrim placed_link(const Source& source, Index link, const LinkPrims& links) {
  LinkPrim prim;
  prim.role = role_of(source, link, links.carried.has_value());
  prim.host = link;
  prim.in_robot = source.model.root_pose;
  if (const std::optional<Index> above = source.tree.joint_to_parent[link]) {
    const robot::Joint& joint = source.model.joints[*above];
    const LinkPrim& parent = links[joint.parent];
    prim.in_robot = parent.in_robot * start_in_parent(source.model, joint, source.options.start);
    if (prim.role == LinkRole::Frame) {
      prim.host = parent.host;
      prim.in_host = parent.in_host * joint.origin;
    }
  }
  return prim;
}

/// `flat`: links are side by side already, and only frames, which weigh nothing, are nested.
Error too_deep(const robot::RobotModel& model, const robot::Link& link, bool flat) {
  return Error(ErrorCode::Limit, "the link \"" + link.name + "\" is nested deeper than " +
                                     std::to_string(kNestedLinks) + " links")
      .in_file(model.file)
      .at(link.place.line, link.place.column)
      .until(link.place.end_line, link.place.end_column)
      .with_rule("convert.too-deep")
      .with_fix(flat ? "give links of the chain an inertial: those without one are nested"
                     : "convert with --flat");
}

}  // namespace

Result<LinkPrims> place_links(const Source& source, Path robot) {
  const auto& [model, tree, options] = source;
  NameScope names;
  for (const char* taken : {"Geometry", "Materials", "Physics"}) {
    names.make(taken);
  }
  LinkPrims links;
  links.prims.resize(model.links.size());
  links.carried = find_carried(source);
  for (const Index link : tree.order) {
    LinkPrim prim = placed_link(source, link, links);
    const std::optional<Index> above = tree.joint_to_parent[link];
    Path parent = above ? links[model.joints[*above].parent].path : robot.child("Geometry");
    if (options.flat && prim.role != LinkRole::Frame) {
      parent = robot;
    }
    if (parent.depth() > kNestedLinks) {
      return too_deep(model, model.links[link], options.flat);
    }
    prim.path = parent.child(names.make(model.links[link].name));
    links.prims[link] = prim;
  }
  find_shares(source, links);
  return links;
}

void define_links(const Source& source, const LinkPrims& links, RobotLayer& layer) {
  if (!source.options.flat) {
    layer.builder().define(layer.robot(), "Geometry", "Scope");
  }
  for (const Index link : source.tree.order) {
    const Path path = links[link].path;
    layer.builder().define(path.parent(), path.name(), "Xform");
    layer.show_name(path, source.model.links[link].name);
  }
}

}  // namespace tenon::convert
