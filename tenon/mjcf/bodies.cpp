// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/mjcf/bodies.h"

#include "tenon/engines/mujoco/build/sensor_fields.h"
#include "tenon/engines/mujoco/model.h"
#include "tenon/math/inertia.h"
#include "tenon/mjcf/joints.h"

namespace tenon::mjcf {

using engines::mujoco::read_quaternion;
using engines::mujoco::read_vector;
using robot::Index;

namespace {

constexpr double kBetween = 1e-6;  // of the body's mass, for links between joints of one body

std::optional<robot::Inertial> read_inertial(const mjModel& model, int body) {
  const std::size_t at = static_cast<std::size_t>(body);
  if (body == 0 || !(model.body_mass[at] > 0)) {
    return std::nullopt;
  }
  robot::Inertial inertial;
  inertial.mass = model.body_mass[at];
  inertial.center_of_mass = read_vector(model.body_ipos + 3 * at);
  inertial.axes = read_quaternion(model.body_iquat + 4 * at);
  inertial.inertia = diagonal_matrix(read_vector(model.body_inertia + 3 * at));
  return inertial;
}

robot::Link read_link(MjcfSource& source, int body) {
  const mjModel& model = source.model();
  robot::Link link;
  link.name = body == 0 ? "world" : source.name(mjOBJ_BODY, body, "body");
  link.inertial = read_inertial(model, body);
  if (model.body_mocapid[body] >= 0) {
    source.left_out("the body \"" + link.name + "\" is moved by mocap; it is held instead");
  }
  link.gravity_scale = 1 - model.body_gravcomp[body];
  return link;
}

/// Between two joints of the body that `link` is.
robot::Link link_between(const robot::Link& link, const std::string& joint) {
  robot::Link between;
  between.name = link.name + "_" + joint;
  if (link.inertial) {
    robot::Inertial& inertial = between.inertial.emplace(*link.inertial);
    inertial.mass *= kBetween;
    for (std::size_t k = 0; k < 3; ++k) {
      inertial.inertia[k][k] *= kBetween;
    }
  }
  return between;
}

robot::Joint fixed_joint(const robot::Link& link, Index parent, Index child, const Pose& origin) {
  robot::Joint joint;
  joint.name = link.name + "_fixed";
  joint.parent = parent;
  joint.child = child;
  joint.origin = origin;
  return joint;
}

/// Hangs the link of a body on that of its parent: by its joints, each but the last with a link of
/// its own, or firmly.
void hang_link(MjcfSource& source, int body, Index link, BodyTree& tree) {
  const mjModel& model = source.model();
  const auto at = static_cast<std::size_t>(body);
  const int count = model.body_jntnum[at];
  const Index parent = tree.link_of_body[static_cast<std::size_t>(model.body_parentid[at])];
  const Pose origin{read_vector(model.body_pos + 3 * at),
                    read_quaternion(model.body_quat + 4 * at)};
  if (count == 0) {
    tree.joints.push_back(fixed_joint(tree.links[link], parent, link, origin));
    return;
  }
  if (count > 1) {
    source.report(Severity::Info, "mjcf.several-joints",
                  "the body \"" + tree.links[link].name + "\" has " + std::to_string(count) +
                      " joints: links with a millionth of its mass are put between");
  }
  Index above = parent;
  for (int i = 0; i < count; ++i) {
    const int number = model.body_jntadr[at] + i;
    robot::Joint joint = read_joint(source, number);
    joint.parent = above;
    joint.origin = i == 0 ? origin : Pose{};
    joint.child = link;
    if (i + 1 < count) {
      joint.child = static_cast<Index>(tree.links.size());
      tree.links.push_back(link_between(tree.links[link], joint.name));
    }
    above = joint.child;
    tree.joint_of_joint[static_cast<std::size_t>(number)] = static_cast<Index>(tree.joints.size());
    tree.joints.push_back(std::move(joint));
  }
}

/// None: MuJoCo's default.
std::optional<robot::MujocoVolume> site_volume(const mjModel& model, std::size_t site) {
  mjsSite usual{};
  mjs_defaultSite(&usual);
  const mjtNum* size = model.site_size + 3 * site;
  const std::string word = engines::mujoco::site_shape_word(model.site_type[site]);
  if (word.empty() || (model.site_type[site] == usual.type && size[0] == usual.size[0])) {
    return std::nullopt;
  }
  return robot::MujocoVolume{word, {size[0], size[1], size[2]}};
}

void add_sites(const MjcfSource& source, BodyTree& tree) {
  const mjModel& model = source.model();
  for (int site = 0; site < model.nsite; ++site) {
    const auto at = static_cast<std::size_t>(site);
    const auto body = static_cast<std::size_t>(model.site_bodyid[at]);
    tree.links[tree.link_of_body[body]].sites.push_back(
        {source.name(mjOBJ_SITE, site, "site"),
         {read_vector(model.site_pos + 3 * at), read_quaternion(model.site_quat + 4 * at)},
         {},
         site_volume(model, at)});
  }
}

}  // namespace

BodyTree read_bodies(MjcfSource& source) {
  const mjModel& model = source.model();
  BodyTree tree;
  tree.link_of_body.resize(static_cast<std::size_t>(model.nbody));
  tree.joint_of_joint.resize(static_cast<std::size_t>(model.njnt));
  for (int body = 0; body < model.nbody; ++body) {
    const auto link = static_cast<Index>(tree.links.size());
    tree.link_of_body[static_cast<std::size_t>(body)] = link;
    tree.links.push_back(read_link(source, body));
    if (body != 0) {
      hang_link(source, body, link, tree);
    }
  }
  add_sites(source, tree);
  return tree;
}

}  // namespace tenon::mjcf
