// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tenon/base/wire.h"
#include "tenon/engines/engines.h"
#include "tenon/engines/simulation.h"
#include "tenon/engines/state_bytes.h"
#include "tenon/engines/steering.h"
#include "tenon/scene/fields/wire_form.h"

/// A second engine, for the tests of the interface only: rigid bodies that touch nothing and hang
/// on nothing, v' = v + dt (g + F / m), x' = x + dt v', the same for spherical inertias.
namespace tenon::engines {

struct FreeBodiesState {
  std::vector<BodyState> bodies;  ///< positions are those of the centres of mass
  std::vector<double> masses;     ///< [kg]
  Steering steering;
  double time = 0;  ///< [s]
  Work work;
};

class FreeBodies final : public Simulation {
 public:
  FreeBodies(const scene::PhysicsScene& scene, const SimulationOptions& options)
      : scene_(scene), options_(options), step_(options.time_step > 0 ? options.time_step : 0.01) {
    start();
  }

  Result<void> step() override {
    const std::vector<Vec3d> gravity = now_.steering.gravity_of(scene_);
    accelerations_.assign(scene_.bodies.size(), {});
    for (scene::Index b = 0; b < scene_.bodies.size(); ++b) {
      BodyState& state = now_.bodies[b];
      if (scene_.bodies[b].kinematic) {
        follow_pose(b);
        continue;
      }
      const auto set = now_.steering.wrenches.find(b);
      const Wrench wrench = set == now_.steering.wrenches.end() ? Wrench{} : set->second;
      const double ratio = now_.masses[b] / scene_.bodies[b].mass;
      const double moment = scene_.bodies[b].inertia[0][0] * ratio;
      const Vec3d force = wrench.force * (1 / now_.masses[b]);
      accelerations_[b] = {gravity[scene_.bodies[b].scene] + force, wrench.torque * (1 / moment)};
      const Vec3d linear = state.linear_velocity;
      const Vec3d angular = state.angular_velocity;
      state.linear_velocity += accelerations_[b].linear * step_;
      state.angular_velocity += accelerations_[b].angular * step_;
      now_.work.applied += step_ *
                           (dot(wrench.force, linear + state.linear_velocity) +
                            dot(wrench.torque, angular + state.angular_velocity)) /
                           2;
      state.pose.position += state.linear_velocity * step_;
      const double angle = length(state.angular_velocity) * step_;
      if (angle > 0) {
        state.pose.orientation = normalized(
            rotation_about(normalized(state.angular_velocity), angle) * state.pose.orientation);
      }
    }
    now_.time += step_;
    return {};
  }
  double time() const override { return now_.time; }
  double time_step() const override { return step_; }
  BodyState body_state(scene::Index body) const override { return now_.bodies[body]; }
  JointState joint_state(scene::Index) const override { return {}; }
  Energy energy() const override {
    Energy result;
    const std::vector<Vec3d> gravity = now_.steering.gravity_of(scene_);
    for (scene::Index b = 0; b < scene_.bodies.size(); ++b) {
      const BodyState& state = now_.bodies[b];
      const double mass = scene_.bodies[b].kinematic ? 0 : now_.masses[b];
      const double moment = scene_.bodies[b].inertia[0][0] * mass / scene_.bodies[b].mass;
      result.kinetic += mass * dot(state.linear_velocity, state.linear_velocity) / 2 +
                        moment * dot(state.angular_velocity, state.angular_velocity) / 2;
      result.potential -= mass * dot(gravity[scene_.bodies[b].scene], state.pose.position);
    }
    return result;
  }
  std::size_t contact_count() const override { return 0; }
  std::size_t dof_count() const override { return 6 * scene_.bodies.size(); }
  const std::vector<NotMapped>& not_mapped() const override { return not_mapped_; }
  std::vector<scene::VendorSetting> settings() const override { return {}; }
  const std::vector<Event>& events() const override { return events_; }
  Vec3d center_of_mass(scene::Index body) const override { return now_.bodies[body].pose.position; }
  bool can(Ability ability) const override {
    switch (ability) {
      case Ability::DriveTargets:
      case Ability::JointEfforts:
      case Ability::Contacts:
      case Ability::DriveEfforts:
      case Ability::JointReactions:
        return false;
      default:
        return true;
    }
  }
  EngineObjects engine_objects() const override { return {"free", "1", this, nullptr}; }
  Vec3d gravity(scene::Index scene) const override {
    return now_.steering.gravity_of(scene_)[scene];
  }
  const Outputs& outputs() const override { return options_.outputs; }

  Result<void> set_body_wrench(scene::Index body, const Wrench& wrench) override {
    TENON_CHECK(check_wrench(scene_, body, wrench));
    now_.steering.wrenches[body] = wrench;
    return {};
  }
  Result<void> move_kinematic(scene::Index body, const Pose& pose) override {
    TENON_CHECK(check_pose(scene_, body, pose));
    now_.steering.poses[body] = {pose.position, normalized(pose.orientation)};
    return {};
  }
  Result<void> set_gravity(scene::Index scene, const Vec3d& gravity) override {
    TENON_CHECK(check_gravity(scene_, scene, gravity));
    const double before = energy().total();
    now_.steering.gravity[scene] = gravity;
    now_.work.changes += energy().total() - before;
    return {};
  }
  Result<void> set_parameter(const ParameterKey& key, double value) override {
    TENON_CHECK(check_parameter(scene_, key, value));
    if (key.what == Parameter::BodyMass) {
      const double before = energy().total();
      now_.masses[key.object] = value;
      now_.work.changes += energy().total() - before;
    }
    now_.steering.parameters[key] = value;
    return {};
  }
  Result<void> set_joint_state(scene::Index joint, const JointState& state) override {
    return check_joint_state(scene_, joint, state, 0);
  }
  Result<void> set_body_state(scene::Index body, const BodyState& state) override {
    TENON_CHECK(check_body_state(scene_, body, state));
    const double before = energy().total();
    now_.bodies[body] = state;
    now_.work.changes += energy().total() - before;
    return {};
  }
  Result<void> reset() override {
    start();
    return {};
  }
  Result<std::string> save_state() const override {
    return seal_state(owner(), wire::encoded(now_));
  }
  Result<void> restore_state(std::string_view bytes) override {
    TENON_TRY(const std::string body, open_state(owner(), bytes));
    auto state = wire::decoded<FreeBodiesState>(body);
    if (!state || state->bodies.size() != scene_.bodies.size() ||
        state->masses.size() != scene_.bodies.size()) {
      return bad_state("it does not fit the scene");
    }
    TENON_CHECK(
        check_steering(scene_, state->steering, std::vector<std::size_t>(scene_.joints.size(), 0)));
    now_ = *std::move(state);
    return {};
  }
  Result<BodyAcceleration> body_acceleration(scene::Index body) const override {
    if (!options_.outputs.accelerations) {
      return output_off("accelerations");
    }
    return body < accelerations_.size() ? accelerations_[body] : BodyAcceleration{};
  }
  Result<std::vector<double>> joint_acceleration(scene::Index) const override {
    if (!options_.outputs.accelerations) {
      return output_off("accelerations");
    }
    return std::vector<double>();
  }
  Result<Work> work() const override {
    if (!options_.outputs.work) {
      return output_off("work");
    }
    return now_.work;
  }

 private:
  StateOwner owner() const { return {"free", "1", scene::scene_hash(scene_), step_}; }
  void start() {
    now_ = {};
    accelerations_.clear();
    for (const scene::Body& body : scene_.bodies) {
      now_.bodies.push_back({body.pose, body.linear_velocity, body.angular_velocity});
      now_.masses.push_back(body.mass);
    }
  }
  void follow_pose(scene::Index body) {
    BodyState& state = now_.bodies[body];
    const auto set = now_.steering.poses.find(body);
    const Pose wanted = set == now_.steering.poses.end() ? state.pose : set->second;
    state.linear_velocity = (wanted.position - state.pose.position) * (1 / step_);
    state.pose = wanted;
  }

  const scene::PhysicsScene& scene_;
  SimulationOptions options_;
  double step_;
  FreeBodiesState now_;
  std::vector<BodyAcceleration> accelerations_;
  std::vector<NotMapped> not_mapped_;
  std::vector<Event> events_;
};

inline Result<std::unique_ptr<Simulation>> make_free_bodies(const scene::PhysicsScene& scene,
                                                            const SimulationOptions& options,
                                                            Diagnostics& /*diagnostics*/) {
  return std::unique_ptr<Simulation>(std::make_unique<FreeBodies>(scene, options));
}

inline Engine free_bodies_engine() {
  return {[] { return EngineInfo{"free", "1", true, ""}; }, &make_free_bodies, nullptr};
}

}  // namespace tenon::engines
