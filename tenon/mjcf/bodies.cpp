// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "tenon/base/file_finding.h"
#include "tenon/engines/mujoco/model.h"
#include "tenon/math/inertia.h"
#include "tenon/mjcf/mjcf_reader.h"

namespace tenon::mjcf {

using engines::mujoco::read_quaternion;
using engines::mujoco::read_vector;
using robot::Index;

void MjcfReader::report(const char* rule, std::string message, Severity severity,
                        std::uint32_t line) {
  diagnostics_.add(file_finding(severity, rule, std::move(message), file_, line));
}

std::string MjcfReader::name_of(mjtObj kind, int id) const {
  const char* name = mj_id2name(&model_, kind, id);
  return name == nullptr ? "" : name;
}

/// MuJoCo's names are unique in their kind; things without one get a number.
std::string MjcfReader::unique_name(mjtObj kind, int id, const std::string& fallback) {
  const std::string name = name_of(kind, id);
  return name.empty() ? fallback + "_" + std::to_string(id) : name;
}

robot::RobotModel MjcfReader::run(std::string name) {
  robot_.name = std::move(name);
  robot_.file = file_;
  link_of_body_.resize(static_cast<std::size_t>(model_.nbody));
  joint_of_joint_.resize(static_cast<std::size_t>(model_.njnt));
  read_meshes();
  read_materials();
  read_bodies();
  read_geoms();
  report_materials();
  read_sites();
  read_excluded_pairs();
  read_tendons();
  read_actuators();
  read_equalities();
  read_keyframes();
  read_scene();
  report_left_out();
  return std::move(robot_);
}

void MjcfReader::read_inertial(int body, robot::Link& link) const {
  const std::size_t at = static_cast<std::size_t>(body);
  if (!(model_.body_mass[at] > 0)) {
    return;
  }
  robot::Inertial& inertial = link.inertial.emplace();
  inertial.mass = model_.body_mass[at];
  inertial.center_of_mass = read_vector(model_.body_ipos + 3 * at);
  inertial.axes = read_quaternion(model_.body_iquat + 4 * at);
  inertial.inertia = diagonal_matrix(read_vector(model_.body_inertia + 3 * at));
}

void MjcfReader::read_body(int body) {
  const auto at = static_cast<std::size_t>(body);
  robot::Link link;
  link.name = body == 0 ? "world" : unique_name(mjOBJ_BODY, body, "body");
  if (body != 0) {
    read_inertial(body, link);
  }
  if (model_.body_mocapid[at] >= 0) {
    report("mjcf.left-out", "the body \"" + link.name + "\" is moved by mocap; it is held instead");
  }
  if (model_.body_gravcomp[at] != 0) {
    report("mjcf.left-out", "the gravity compensation of body \"" + link.name + "\" is left out");
  }
  const Pose origin{read_vector(model_.body_pos + 3 * at),
                    read_quaternion(model_.body_quat + 4 * at)};
  const auto number = static_cast<Index>(robot_.links.size());
  link_of_body_[at] = number;
  robot_.links.push_back(std::move(link));
  if (body != 0) {
    const auto parent = static_cast<std::size_t>(model_.body_parentid[at]);
    add_joints(body, link_of_body_[parent], number, origin);
  }
}

void MjcfReader::read_bodies() {
  for (int body = 0; body < model_.nbody; ++body) {
    read_body(body);
  }
}

void MjcfReader::read_sites() {
  for (int site = 0; site < model_.nsite; ++site) {
    const auto at = static_cast<std::size_t>(site);
    const auto body = static_cast<std::size_t>(model_.site_bodyid[at]);
    robot_.links[link_of_body_[body]].sites.push_back(
        {unique_name(mjOBJ_SITE, site, "site"),
         {read_vector(model_.site_pos + 3 * at), read_quaternion(model_.site_quat + 4 * at)}});
  }
}

void MjcfReader::read_excluded_pairs() {
  for (int pair = 0; pair < model_.nexclude; ++pair) {
    const auto signature = static_cast<std::uint32_t>(model_.exclude_signature[pair]);
    const std::size_t first = signature >> 16u;
    const std::size_t second = signature & 0xFFFFu;
    if (first < link_of_body_.size() && second < link_of_body_.size()) {
      robot_.excluded_pairs.push_back({link_of_body_[first], link_of_body_[second]});
    }
  }
}

}  // namespace tenon::mjcf
