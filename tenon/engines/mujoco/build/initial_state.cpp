// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Coordinates are read off the relative poses of joint frames; what they cannot express is reported
// (S-90), and an authored joint position replaces them. Velocities go from parents to children: a
// body on a joint gets the joint velocities that come nearest, by least squares, to what its
// parents do not give it already. A tiny diagonal keeps the normal equations solvable and
// directions without effect at rest. mj_forward then derives the rest with the contact filter in
// force.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>

#include "tenon/engines/mujoco/build/build.h"
#include "tenon/engines/mujoco/contact_filter.h"
#include "tenon/engines/mujoco/error_hook.h"
#include "tenon/engines/steering.h"

namespace tenon::engines::mujoco {
namespace {

using scene::Index;
using scene::PhysicsScene;

constexpr double kNoticedGap = 1e-4;   // [m]
constexpr double kNoticedTurn = 1e-3;  // [rad]

Pose world_frame(const PhysicsScene& scene, const std::optional<Index>& body, const Pose& frame) {
  return body.has_value() ? scene.bodies[*body].pose * frame : frame;
}

Pose relative_frames(const PhysicsScene& scene, const scene::Joint& joint) {
  return inverse(world_frame(scene, joint.body0, joint.frame0)) *
         world_frame(scene, joint.body1, joint.frame1);
}

// Frames that do not meet are brought together by the coordinates of the tree (S-90).
void report_gap(const scene::Joint& joint, const Pose& wanted, const Pose& possible,
                Diagnostics& diagnostics) {
  const double gap = length(wanted.position - possible.position);
  const double turn =
      length(rotation_vector(normalized(conjugate(possible.orientation) * wanted.orientation)));
  if (gap <= kNoticedGap && turn <= kNoticedTurn) {
    return;
  }
  char text[128];
  std::snprintf(
      text, sizeof(text),
      "the joint's frames are %.3g mm and %.3g degrees apart at the start; the bodies are "
      "moved together",
      gap * 1000, turn * 180 / M_PI);
  diagnostics.add({Severity::Warning, "joint.frames-apart", text, "", 0, 0, joint.path.str(), "",
                   "correct localPos and localRot, or the poses of the bodies"});
}

void set_coordinates(const scene::Joint& joint, const JointMap& map, const Pose& relative,
                     Diagnostics& diagnostics, double* qpos) {
  std::vector<double> coordinates = coordinates_at(map.dofs, relative);
  report_gap(joint, relative, relative_pose_at(map.dofs, coordinates), diagnostics);
  if (joint.initial_position.has_value() && map.qpos.size() == 1 && map.ball_qpos < 0) {
    coordinates[0] = *joint.initial_position;
  }
  for (std::size_t i = 0; i < map.qpos.size(); ++i) {
    qpos[map.qpos[i]] = coordinates[i];
  }
  if (map.ball_qpos >= 0) {
    const Quatd turn = map.reversed ? conjugate(relative.orientation) : relative.orientation;
    write_quaternion(qpos + map.ball_qpos,
                     normalized(map.child_frame * turn * conjugate(map.child_frame)));
  }
}

void set_positions(const PhysicsScene& scene, Model& model, Diagnostics& diagnostics) {
  for (std::size_t j = 0; j < scene.joints.size(); ++j) {
    const JointMap& map = model.joints[j];
    if (map.in_tree) {
      set_coordinates(scene.joints[j], map, relative_frames(scene, scene.joints[j]), diagnostics,
                      model.data->qpos);
    }
  }
}

void set_free_velocity(const scene::Body& body, const BodyMap& map, mjData* data) {
  write_vector(data->qvel + map.free_dof, body.linear_velocity);
  const Quatd world = body.pose.orientation * map.engine_frame.orientation;
  write_vector(data->qvel + map.free_dof + 3, rotate(conjugate(world), body.angular_velocity));
}

// Velocities x of `count` degrees of freedom such that jacobian x is nearest to `wanted`, by normal
// equations and Gauss elimination; 6 rows. Columns that add nothing stay at rest.
std::vector<double> least_squares(const std::vector<std::array<double, 6>>& columns,
                                  const std::array<double, 6>& wanted) {
  const std::size_t n = columns.size();
  std::vector<std::vector<double>> rows(n, std::vector<double>(n + 1, 0.0));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < 6; ++k) {
      for (std::size_t j = 0; j < n; ++j) {
        rows[i][j] += columns[i][k] * columns[j][k];
      }
      rows[i][n] += columns[i][k] * wanted[k];
    }
    rows[i][i] += 1e-12;
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t r = 0; r < n; ++r) {
      const double factor = r == i ? 0 : rows[r][i] / rows[i][i];
      for (std::size_t c = 0; c <= n; ++c) {
        rows[r][c] -= factor * rows[i][c];
      }
    }
  }
  std::vector<double> result;
  for (std::size_t i = 0; i < n; ++i) {
    result.push_back(rows[i][n] / rows[i][i]);
  }
  return result;
}

// The joint velocities that give a body on a joint its authored velocity, as far as they can.
Result<void> set_joint_velocity(const scene::Body& body, const BodyMap& map, Model& model) {
  mjModel* m = model.model.get();
  mjData* d = model.data.get();
  const auto nv = static_cast<std::size_t>(m->nv);
  std::vector<double> jacobian(6 * nv);
  std::array<double, 6> now{};
  TENON_CHECK(guarded([&] {
    mj_kinematics(m, d);
    mj_comPos(m, d);
    mj_comVel(m, d);
    mj_objectVelocity(m, d, mjOBJ_BODY, map.id, now.data(), 0);
    mj_jacBodyCom(m, d, jacobian.data(), jacobian.data() + 3 * nv, map.id);
  }));
  const Vec3d& v = body.linear_velocity;
  const Vec3d& w = body.angular_velocity;
  const std::array<double, 6> wanted{v[0] - now[3], v[1] - now[4], v[2] - now[5],
                                     w[0] - now[0], w[1] - now[1], w[2] - now[2]};
  const int first = m->body_dofadr[map.id];
  std::vector<std::array<double, 6>> columns(static_cast<std::size_t>(m->body_dofnum[map.id]));
  for (std::size_t i = 0; i < columns.size(); ++i) {
    for (std::size_t k = 0; k < 6; ++k) {
      columns[i][k] = jacobian[k * nv + static_cast<std::size_t>(first) + i];
    }
  }
  const std::vector<double> velocities = least_squares(columns, wanted);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    d->qvel[first + static_cast<int>(i)] = velocities[i];
  }
  return {};
}

bool moves_at_start(const scene::Body& body) {
  return body.linear_velocity != Vec3d{} || body.angular_velocity != Vec3d{};
}

void stop_locked_axes(const scene::Body& body, const BodyMap& map, mjData* data) {
  for (int axis = 0; axis < 3; ++axis) {
    if ((body.settings.locked_translation >> axis & 1) != 0) {
      data->qvel[map.free_dof + axis] = 0;
    }
    if ((body.settings.locked_rotation >> axis & 1) != 0) {
      data->qvel[map.free_dof + 3 + axis] = 0;
    }
  }
}

Result<void> set_velocities(const PhysicsScene& scene, Begin begin, Model& model) {
  for (const Index b : model.plan.forest.order) {
    const scene::Body& body = scene.bodies[b];
    const scene::ForestBody& link = model.plan.forest.bodies[b];
    if (model.plan.bases[b] == BodyBase::Free) {
      set_free_velocity(body, model.bodies[b], model.data.get());
      stop_locked_axes(body, model.bodies[b], model.data.get());
    }
    if (!link.joint) {
      continue;
    }
    const scene::Joint& joint = scene.joints[*link.joint];
    const JointMap& map = model.joints[*link.joint];
    const bool is_link =
        begin == Begin::Start && joint.articulation.has_value() && link.parent.has_value();  // S-32
    const bool moving = moves_at_start(body) ||
                        (link.parent.has_value() && moves_at_start(scene.bodies[*link.parent]));
    if (joint.initial_velocity.has_value() && map.dof.size() == 1) {
      model.data->qvel[map.dof[0]] = *joint.initial_velocity;
    } else if (moving && !is_link) {
      TENON_CHECK(set_joint_velocity(body, model.bodies[b], model));
    }
  }
  return {};
}

void set_controls(const PhysicsScene& scene, Model& model) {
  for (const DriveMap& map : model.drives) {
    if (map.actuator >= 0) {
      const scene::Drive& drive = scene.joints[map.joint].drives[map.drive];
      model.data->ctrl[map.control] = drive.target_position;
      model.data->ctrl[map.control + 1] = drive.target_velocity;
    }
  }
}

// Bodies of further scenes carry the difference as a constant force at their centre of mass.
void set_other_gravities(const PhysicsScene& scene, Model& model) {
  const std::vector<Vec3d> gravity = Steering{}.gravity_of(scene);
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    if (scene.bodies[b].scene != 0 && !scene.bodies[b].kinematic) {
      write_vector(model.data->xfrc_applied + std::ptrdiff_t{6} * model.bodies[b].id,
                   other_gravity(scene.bodies[b], model.bodies[b].mass, gravity));
    }
  }
}

}  // namespace

Vec3d other_gravity(const scene::Body& body, double mass, std::span<const Vec3d> gravity) {
  return body.scene == 0 ? Vec3d{}
                         : (gravity[body.scene] - gravity.front()) * (mass * body.gravity_scale);
}

Result<void> set_initial_state(const PhysicsScene& scene, Begin begin, Model& model,
                               Diagnostics& diagnostics) {
  set_positions(scene, model, diagnostics);
  TENON_CHECK(set_velocities(scene, begin, model));
  set_controls(scene, model);
  set_other_gravities(scene, model);
  mjModel* m = model.model.get();
  mjData* d = model.data.get();
  const FilterScope filter(model.filter);
  return guarded([&] { mj_forward(m, d); });
}

}  // namespace tenon::engines::mujoco
