// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "tenon/engines/mujoco/build.h"
#include "tenon/engines/mujoco/contact_filter.h"
#include "tenon/engines/mujoco/error_hook.h"
#include "tenon/engines/mujoco/mujoco_simulation.h"

// What the asset changes about the scene while it runs: switches, bounds, gravity, groups, and
// joints that break. MuJoCo takes bounds and gravity as they come; for the others the model is made
// anew from the scene as it is now, and poses, velocities and joint coordinates go over (S-28).
namespace tenon::engines::mujoco {
namespace {

using physics::Index;
using physics::PhysicsScene;
using physics::Switch;

constexpr double kSameTime = 1e-9;  // [s] a sample this much ahead counts already

bool can_break(const physics::Joint& joint) {
  return joint.break_force < physics::kUnlimited || joint.break_torque < physics::kUnlimited;
}

bool changes(const PhysicsScene& scene) {
  return !scene.switch_tracks.empty() || !scene.bounds_tracks.empty() ||
         !scene.gravity_tracks.empty() || !scene.shapes_tracks.empty() ||
         !scene.group_states.empty() || !scene.nesting_states.empty() ||
         std::any_of(scene.joints.begin(), scene.joints.end(), can_break) ||
         std::any_of(scene.pose_tracks.begin(), scene.pose_tracks.end(),
                     [](const physics::PoseTrack& track) { return track.joint.has_value(); });
}

// A joint side that moves by itself hangs on a kinematic body of its own (S-86).
void add_anchors(PhysicsScene& scene) {
  for (physics::PoseTrack& track : scene.pose_tracks) {
    if (!track.joint.has_value() || track.poses.empty()) {
      continue;
    }
    physics::Joint& joint = scene.joints[*track.joint];
    physics::Body anchor;
    anchor.path = joint.path.child(Token("anchor" + std::to_string(track.side)));
    anchor.kinematic = true;
    anchor.pose = track.poses.front();
    const std::optional<Index>& other = track.side == 0 ? joint.body1 : joint.body0;
    anchor.scene = other.has_value() ? scene.bodies[*other].scene : 0;
    const auto index = static_cast<Index>(scene.bodies.size());
    (track.side == 0 ? joint.body0 : joint.body1) = index;
    (track.side == 0 ? joint.frame0 : joint.frame1) = {};
    track.body = index;
    track.joint.reset();
    scene.bodies.push_back(std::move(anchor));
  }
}

std::unique_ptr<PhysicsScene> changing_copy(const PhysicsScene& scene) {
  if (!changes(scene)) {
    return nullptr;
  }
  auto copy = std::make_unique<PhysicsScene>(scene);
  add_anchors(*copy);
  return copy;
}

bool is_on(const PhysicsScene& scene, const physics::SwitchTrack& track) {
  switch (track.what) {
    case Switch::BodyEnabled:
      return scene.bodies[track.object].enabled;
    case Switch::BodyKinematic:
      return scene.bodies[track.object].kinematic;
    case Switch::ColliderEnabled:
      return scene.colliders[track.object].enabled;
    case Switch::JointEnabled:
      return scene.joints[track.object].enabled;
    case Switch::JointCollision:
      break;
  }
  return scene.joints[track.object].collision_enabled;
}

bool same_shape(const JointDofs& a, const JointDofs& b) {
  if (a.free.size() != b.free.size() || a.ball != b.ball) {
    return false;
  }
  for (std::size_t i = 0; i < a.free.size(); ++i) {
    if (a.free[i].dof != b.free[i].dof) {
      return false;
    }
  }
  return length(a.locked.position - b.locked.position) < 1e-9 &&
         length(rotation_vector(conjugate(a.locked.orientation) * b.locked.orientation)) < 1e-9;
}

void set_bounds_of(physics::Joint& joint, const physics::JointBounds& bounds) {
  joint.lower = bounds.lower;
  joint.upper = bounds.upper;
  joint.cone_angle0 = bounds.cone_angle0;
  joint.cone_angle1 = bounds.cone_angle1;
  joint.limits = bounds.limits;
}

void set_range(mjModel& m, int joint, const FreeDof& dof, const physics::MujocoSoftness& softness) {
  constexpr double kOpenEnd = 1e10;
  const bool limited = dof.lower > -physics::kUnlimited || dof.upper < physics::kUnlimited;
  if (limited && m.jnt_limited[joint] == 0) {
    mjtNum* solref = m.jnt_solref + mjNREF * joint;
    mjtNum* solimp = m.jnt_solimp + mjNIMP * joint;
    make_hard(m.opt.timestep, solref, solimp);
    std::copy(softness.solref_limit.begin(), softness.solref_limit.end(), solref);
    std::copy(softness.solimp_limit.begin(), softness.solimp_limit.end(), solimp);
  }
  m.jnt_limited[joint] = limited ? 1 : 0;
  m.jnt_range[2 * joint] = std::max(dof.lower, -kOpenEnd);
  m.jnt_range[2 * joint + 1] = std::min(dof.upper, kOpenEnd);
}

}  // namespace

Result<std::unique_ptr<MujocoSimulation>> MujocoSimulation::make(const PhysicsScene& scene,
                                                                 const SimulationOptions& options,
                                                                 Diagnostics& diagnostics) {
  std::unique_ptr<PhysicsScene> own = changing_copy(scene);
  BodyNesting nesting = own == nullptr ? BodyNesting() : BodyNesting(*own);
  TENON_TRY(Model model, build_model(own == nullptr ? scene : *own, options, diagnostics));
  return std::unique_ptr<MujocoSimulation>(
      new MujocoSimulation(scene, std::move(own), std::move(nesting), std::move(model)));
}

void MujocoSimulation::collect_changes() {
  tracked_bounds_.clear();
  if (own_ == nullptr) {
    return;
  }
  // A new model leaves the switches where they are. The scene may say other than they do: disabled
  // bodies are kinematic, broken joints disabled.
  if (switches_.empty()) {
    for (const physics::SwitchTrack& track : own_->switch_tracks) {
      switches_.push_back({&track, is_on(*own_, track)});
    }
  }
  const mjModel* m = model_.model.get();
  for (const physics::BoundsTrack& track : own_->bounds_tracks) {
    const std::string name = own_->joints[track.joint].path.str();
    TrackedBounds tracked{&track};
    tracked.tendon_max = mj_name2id(m, mjOBJ_TENDON, (name + ".distance.max").c_str());
    tracked.tendon_min = mj_name2id(m, mjOBJ_TENDON, (name + ".distance.min").c_str());
    tracked.tendon_cone = mj_name2id(m, mjOBJ_TENDON, (name + ".cone").c_str());
    if (tracked.tendon_cone >= 0) {
      const double angle = circular_cone(own_->joints[track.joint]);
      tracked.cone_reach = m->tendon_range[2 * tracked.tendon_cone + 1] / std::sin(angle / 2);
    }
    tracked_bounds_.push_back(tracked);
  }
}

Result<void> MujocoSimulation::follow_changes() {
  follow_gravity();
  // Every one of them must run.
  const bool switched = follow_switches();
  const bool regrouped = follow_groups();
  const bool reshaped = follow_bounds();
  const bool moved = follow_shapes();
  const bool nested = nesting_.apply(*own_, model_.data->time + kSameTime);
  return switched || regrouped || reshaped || moved || nested ? rebuild() : Result<void>();
}

void MujocoSimulation::set_switch(const physics::SwitchTrack& track, bool on) {
  switch (track.what) {
    case Switch::BodyEnabled:
      own_->bodies[track.object].enabled = on;
      break;
    case Switch::BodyKinematic:
      own_->bodies[track.object].kinematic = on;
      break;
    case Switch::ColliderEnabled:
      own_->colliders[track.object].enabled = on;
      break;
    case Switch::JointEnabled:
      own_->joints[track.object].enabled = on && broken_[track.object] == 0;
      break;
    case Switch::JointCollision:
      own_->joints[track.object].collision_enabled = on;
      break;
  }
}

bool MujocoSimulation::follow_switches() {
  const double now = model_.data->time + kSameTime;
  bool changed = false;
  for (SwitchState& state : switches_) {
    const bool on = state.track->at(now);
    changed = changed || on != state.on;
  }
  if (!changed) {
    return false;
  }
  for (SwitchState& state : switches_) {
    state.on = state.track->at(now);
    set_switch(*state.track, state.on);
  }
  for (const SwitchState& state : switches_) {  // what is disabled stands still
    if (state.track->what == Switch::BodyEnabled && !state.on) {
      own_->bodies[state.track->object].kinematic = true;
    }
  }
  return true;
}

bool MujocoSimulation::follow_groups() {
  const auto& states = own_->group_states;
  std::size_t wanted = group_state_;
  while (wanted < states.size() && states[wanted].time <= model_.data->time + kSameTime) {
    ++wanted;
  }
  if (wanted == group_state_) {
    return false;
  }
  group_state_ = wanted;
  physics::CollisionFilter& filter = own_->filter;
  const physics::GroupState& state = states[wanted - 1];
  const bool changed =
      filter.group_pair_off != state.group_pair_off || filter.ungrouped_off != state.ungrouped_off;
  filter.group_pair_off = state.group_pair_off;
  filter.ungrouped_off = state.ungrouped_off;
  return changed;
}

// Bounds on coordinates and tendons that there are; false where the model lacks one.
bool MujocoSimulation::set_bounds(const TrackedBounds& tracked) {
  mjModel& m = *model_.model;
  const physics::Joint& joint = own_->joints[tracked.track->joint];
  JointMap& map = model_.joints[tracked.track->joint];
  const JointDofs dofs = joint_dofs(joint);
  if (!same_shape(dofs, map.dofs)) {
    return false;
  }
  for (std::size_t i = 0; map.in_tree && i < dofs.free.size(); ++i) {
    set_range(m, m.dof_jntid[map.dof[i]], dofs.free[i], joint.mujoco);
  }
  const physics::Limit distance = distance_limit(joint);
  const double cone = circular_cone(joint);
  const bool fits = (distance.upper < physics::kUnlimited) == (tracked.tendon_max >= 0) &&
                    (distance.lower > -physics::kUnlimited) == (tracked.tendon_min >= 0) &&
                    (cone < M_PI) == (tracked.tendon_cone >= 0);
  if (!fits) {
    return false;
  }
  if (tracked.tendon_max >= 0) {
    m.tendon_range[2 * tracked.tendon_max + 1] = std::max(distance.upper, 1e-9);
  }
  if (tracked.tendon_min >= 0) {
    m.tendon_range[2 * tracked.tendon_min] = distance.lower;
  }
  if (tracked.tendon_cone >= 0) {
    m.tendon_range[2 * tracked.tendon_cone + 1] = tracked.cone_reach * std::sin(cone / 2);
  }
  return true;
}

bool MujocoSimulation::follow_bounds() {
  bool reshaped = false;
  for (const TrackedBounds& tracked : tracked_bounds_) {
    physics::Joint& joint = own_->joints[tracked.track->joint];
    set_bounds_of(joint, tracked.track->at(model_.data->time));
    if (joint.enabled && !set_bounds(tracked)) {
      reshaped = true;
    }
  }
  return reshaped;
}

// S-37: shapes that move inside bodies, and the mass that moves with them. The body moves on as it
// did: keep_state() takes the velocity of the new centre of mass, a point of the old model's body.
bool MujocoSimulation::follow_shapes() {
  const auto& tracks = own_->shapes_tracks;
  shape_states_.resize(tracks.size(), 0);
  bool moved = false;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const physics::ShapesTrack& track = tracks[i];
    const std::size_t wanted = track.at(model_.data->time + kSameTime);
    if (wanted == shape_states_[i] || wanted >= track.shapes.size()) {
      continue;
    }
    shape_states_[i] = wanted;
    moved = true;
    const physics::BodyShapes& now = track.shapes[wanted];
    for (std::size_t k = 0; k < track.colliders.size(); ++k) {
      own_->colliders[track.colliders[k]].pose = now.poses[k];
      own_->colliders[track.colliders[k]].shape = now.shapes[k];
    }
    physics::Body& body = own_->bodies[track.body];
    body.mass = now.mass;
    body.center_of_mass = now.center_of_mass;
    body.inertia = now.inertia;
  }
  return moved;
}

void MujocoSimulation::follow_gravity() {
  if (own_->gravity_tracks.empty()) {
    return;
  }
  for (const physics::GravityTrack& track : own_->gravity_tracks) {
    own_->scenes[track.scene].gravity = track.at(model_.data->time);
  }
  write_vector(model_.model->opt.gravity, own_->scenes.front().gravity);
  set_other_gravities(*own_, model_);
  for (DampedBody& damped : damped_bodies_) {
    damped.constant_force = read_vector(model_.data->xfrc_applied + 6 * damped.body->id);
  }
}

// Poses and velocities of now become the start of the scene that the next model is made from.
void MujocoSimulation::keep_state() {
  for (std::size_t b = 0; b < own_->bodies.size(); ++b) {
    physics::Body& body = own_->bodies[b];
    const BodyState state = body_state(static_cast<Index>(b));
    const bool moved = length(state.pose.position - body.pose.position) > 1e-9 ||
                       length(state.linear_velocity) + length(state.angular_velocity) > 1e-9;
    body.starts_asleep = body.starts_asleep && !moved;
    body.pose = state.pose;
    body.linear_velocity = state.linear_velocity;
    body.angular_velocity = state.angular_velocity;
  }
  for (physics::Joint& joint : own_->joints) {
    joint.initial_position.reset();
    joint.initial_velocity.reset();
  }
}

// Coordinates of joints that are in both trees: they know turns that poses do not.
void MujocoSimulation::restore_joints(Model& next) const {
  const mjData& from = *model_.data;
  mjData& to = *next.data;
  for (std::size_t j = 0; j < next.joints.size(); ++j) {
    const JointMap& old_map = model_.joints[j];
    const JointMap& map = next.joints[j];
    if (!old_map.in_tree || !map.in_tree || !same_shape(old_map.dofs, map.dofs)) {
      continue;
    }
    for (std::size_t i = 0; i < map.qpos.size(); ++i) {
      to.qpos[map.qpos[i]] = from.qpos[old_map.qpos[i]];
      to.qvel[map.dof[i]] = from.qvel[old_map.dof[i]];
    }
    if (map.ball_qpos >= 0 && old_map.ball_qpos >= 0 && map.reversed == old_map.reversed) {
      std::copy_n(from.qpos + old_map.ball_qpos, 4, to.qpos + map.ball_qpos);
      std::copy_n(from.qvel + old_map.ball_dof, 3, to.qvel + map.ball_dof);
    }
  }
}

Result<void> MujocoSimulation::rebuild() {
  keep_state();
  const std::vector<physics::CarriedBody> joined = nesting_.attach(*own_);
  own_->update_joint_pairs();
  Diagnostics silent;  // what there is to say was said at the start
  TENON_TRY(Model next, build_model(*own_, {.time_step = time_step()}, silent, Begin::Middle));
  restore_joints(next);
  next.data->time = model_.data->time;
  model_ = std::move(next);
  connect();
  const FilterScope filter(model_.filter);
  return guarded([&] {
    mj_forward(model_.model.get(), model_.data.get());
    for (const physics::CarriedBody& part : joined) {
      const physics::Body& body = own_->bodies[part.body];
      join_momentum(body, model_.bodies[part.body], body.linear_velocity, body.angular_velocity,
                    *model_.model, *model_.data);
    }
    if (!joined.empty()) {
      mj_forward(model_.model.get(), model_.data.get());
    }
  });
}

}  // namespace tenon::engines::mujoco
