// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Nothing that a drive, an effort or a wrench does is a change from outside: their work is that of
// the steps that follow.
#include "tenon/engines/steered_simulation.h"

namespace tenon::engines {

using scene::Index;

template <class Values, class Write>
Result<void> SteeredSimulation::set(Values& values, const typename Values::key_type& key,
                                    typename Values::mapped_type value, const Input& input,
                                    const Write& write) {
  const auto [at, is_new] = values.try_emplace(key);
  typename Values::mapped_type before = std::exchange(at->second, std::move(value));
  if (Result<void> done = write(); !done) {
    if (is_new) {
      values.erase(key);
    } else {
      values[key] = std::move(before);
    }
    return done;
  }
  note(input);
  return {};
}

Result<void> SteeredSimulation::set_drive_target(Index joint, Index drive,
                                                 const DriveTarget& target) {
  TENON_CHECK(check_target(*scene_, joint, drive, target));
  return set(steering_.targets, {joint, drive}, target, input_of(joint, drive, target),
             [&] { return write_target(joint, drive); });
}

Result<void> SteeredSimulation::set_joint_efforts(Index joint, std::span<const double> efforts) {
  TENON_CHECK(check_joint(*scene_, joint));
  TENON_CHECK(check_efforts(*scene_, joint, efforts, joint_state(joint).position.size()));
  return set(steering_.efforts, joint, {efforts.begin(), efforts.end()}, input_of(joint, efforts),
             [] { return Result<void>(); });
}

Result<void> SteeredSimulation::set_body_wrench(Index body, const Wrench& wrench) {
  TENON_CHECK(check_wrench(*scene_, body, wrench));
  return set(steering_.wrenches, body, wrench, input_of(body, wrench),
             [&] { return write_wrench(body); });
}

Result<void> SteeredSimulation::move_kinematic(Index body, const Pose& pose) {
  TENON_CHECK(check_pose(*scene_, body, pose));
  return set(steering_.poses, body, {pose.position, normalized(pose.orientation)},
             input_of(body, pose), [&] { return write_pose(body); });
}

Result<void> SteeredSimulation::set_gravity(Index scene, const Vec3d& gravity) {
  TENON_CHECK(check_gravity(*scene_, scene, gravity));
  return accounted([&] {
    return set(steering_.gravity, scene, gravity, input_of(scene, gravity),
               [&] { return write_gravity(); });
  });
}

Result<void> SteeredSimulation::set_parameter(const ParameterKey& key, double value) {
  TENON_CHECK(check_parameter(*scene_, key, value));
  return accounted([&] {
    return set(steering_.parameters, key, value, input_of(key, value),
               [&] { return write_parameter(key, value); });
  });
}

Result<void> SteeredSimulation::set_joint_state(Index joint, const JointState& state) {
  TENON_CHECK(check_joint(*scene_, joint));
  TENON_CHECK(check_joint_state(*scene_, joint, state, joint_state(joint).position.size()));
  return accounted([&]() -> Result<void> {
    TENON_CHECK(write_joint_state(joint, state));
    note(input_of(joint, state));
    return {};
  });
}

Result<void> SteeredSimulation::set_body_state(Index body, const BodyState& state) {
  TENON_CHECK(check_body_state(*scene_, body, state));
  return accounted([&]() -> Result<void> {
    TENON_CHECK(write_body_state(body, state));
    note(input_of(body, state));
    return {};
  });
}

Result<void> SteeredSimulation::write_steering() {
  const auto matters = [](const Result<void>& done) {
    return !done && done.error().code() != ErrorCode::Unsupported;
  };
  for (const auto& [key, value] : steering_.parameters) {
    if (Result<void> done = write_parameter(key, value); matters(done)) {
      return done;
    }
  }
  for (const auto& [at, target] : steering_.targets) {
    if (Result<void> done = write_target(at.first, at.second); matters(done)) {
      return done;
    }
  }
  return steering_.gravity.empty() ? Result<void>() : write_gravity();
}

Result<std::vector<Contact>> SteeredSimulation::contacts() const {
  if (!outputs().contacts) {
    return output_off("contacts");
  }
  return contacts_of_step();
}

Result<std::vector<double>> SteeredSimulation::drive_efforts(Index joint) const {
  if (!outputs().efforts) {
    return output_off("efforts");
  }
  TENON_CHECK(check_joint(*scene_, joint));
  return efforts_of_step(joint);
}

Result<Wrench> SteeredSimulation::joint_reaction(Index joint) const {
  if (!outputs().reactions) {
    return output_off("reactions");
  }
  TENON_CHECK(check_joint(*scene_, joint));
  return reaction_of_step(joint);
}

Result<BodyAcceleration> SteeredSimulation::body_acceleration(Index body) const {
  if (!outputs().accelerations) {
    return output_off("accelerations");
  }
  TENON_CHECK(check_body(*scene_, body));
  return body_acceleration_of_step(body);
}

Result<std::vector<double>> SteeredSimulation::joint_acceleration(Index joint) const {
  if (!outputs().accelerations) {
    return output_off("accelerations");
  }
  TENON_CHECK(check_joint(*scene_, joint));
  return joint_acceleration_of_step(joint);
}

Result<Work> SteeredSimulation::work() const {
  if (!can(Ability::Work)) {
    return no_ability(Ability::Work);
  }
  if (!outputs().work) {
    return output_off("work");
  }
  return work_of_run();
}

Error SteeredSimulation::not_steerable(const Path& prim, const std::string& why) const {
  return Error(ErrorCode::Unsupported, why).with_rule(rule("not-steerable")).with_prim(prim.str());
}

std::string SteeredSimulation::rule(const char* name) const {
  return std::string(engine_objects().engine) + "." + name;
}

bool is_of_drive(Parameter what) {
  return what == Parameter::DriveStiffness || what == Parameter::DriveDamping ||
         what == Parameter::DriveMaxForce;
}

scene::Body with_mass(scene::Body body, double mass) {
  const double ratio = mass / body.mass;
  body.mass = mass;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      body.inertia[i][k] *= ratio;
    }
  }
  return body;
}

std::vector<double> mean_acceleration(const std::vector<JointState>& before, Index joint,
                                      const JointState& now, double time_step) {
  std::vector<double> result = now.velocity;
  const bool known = joint < before.size() && before[joint].velocity.size() == result.size();
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] = known ? (result[i] - before[joint].velocity[i]) / time_step : 0;
  }
  return result;
}

BodyAcceleration mean_acceleration(const std::vector<BodyState>& before, Index body,
                                   const BodyState& now, double time_step) {
  if (body >= before.size()) {
    return {};
  }
  return {(now.linear_velocity - before[body].linear_velocity) * (1 / time_step),
          (now.angular_velocity - before[body].angular_velocity) * (1 / time_step)};
}

}  // namespace tenon::engines
