// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Which keys contradict each other is looked at before any of them is used, so that each number has
// one way to come about.
#include "tenon/asset/drives/spec_limits.h"

#include <cmath>

#include "tenon/math/angle.h"
#include "tenon/scene/joint_dofs.h"
#include "tenon/stage/transform_at.h"

namespace tenon {
namespace {

using Dimension = SpecNumber::Dimension;

/// One spec on one drive.
class SpecReader {
 public:
  SpecReader(const MotorSpec& spec, const std::string& file, const stage::Stage& stage,
             const scene::PhysicsScene& scene, const scene::Joint& joint, scene::Dof dof)
      : spec_(spec), file_(file), stage_(stage), scene_(scene), joint_(joint), dof_(dof) {}

  Result<SpecLimits> read() const {
    SpecLimits limits;
    TENON_CHECK(check_ways());
    TENON_TRY(limits.effort, effort());
    TENON_TRY(limits.speed, speed());
    return limits;
  }

 private:
  bool turns() const { return is_angular(dof_); }

  Error wrong(const std::string& message, const std::string& fix) const {
    return Error(ErrorCode::Invalid, joint_.path.str() + ": " + message)
        .in_file(file_)
        .at(spec_.line, 0)
        .with_rule("drives.specs")
        .with_fix(fix);
  }

  Result<void> check_ways() const {
    const int efforts = (spec_.max_effort ? 1 : 0) + (spec_.tip_force ? 1 : 0) +
                        (spec_.motor_torque ? 1 : 0) + (spec_.torque_constant ? 1 : 0);
    if (efforts > 1) {
      return wrong("several keys give the effort",
                   "keep one of max_effort, tip_force, motor_torque and torque_constant");
    }
    if (spec_.max_speed && spec_.motor_speed) {
      return wrong("max_speed and motor_speed both give the speed", "keep one of them");
    }
    if (spec_.torque_constant.has_value() != spec_.max_current.has_value()) {
      return wrong("torque_constant and max_current belong together", "give both");
    }
    if (spec_.lever_arm && spec_.tip) {
      return wrong("lever_arm and tip both give the lever arm", "keep one of them");
    }
    if ((spec_.lever_arm || spec_.tip) && !spec_.tip_force) {
      return wrong("a lever arm without tip_force", "give tip_force, too");
    }
    if (!turns() && (spec_.motor_torque || spec_.torque_constant || spec_.lever_arm || spec_.tip ||
                     spec_.motor_speed)) {
      return wrong("the joint slides, and the motor of the file turns",
                   "give max_effort or tip_force, and max_speed");
    }
    return {};
  }

  Result<std::optional<double>> effort() const {
    if (spec_.max_effort) {
      const Dimension fitting = turns() ? Dimension::Torque : Dimension::Force;
      if (spec_.max_effort->dimension != Dimension::None &&
          spec_.max_effort->dimension != fitting) {
        return wrong("max_effort is in the wrong unit", turns() ? "write N m" : "write N");
      }
      return std::optional(spec_.max_effort->value);
    }
    if (spec_.tip_force) {
      double arm = 1;
      if (turns()) {
        TENON_TRY(arm, lever_arm());
      }
      return std::optional(spec_.tip_force->value * arm * spec_.chain_factor);
    }
    const double gear = spec_.gear_ratio * spec_.efficiency;
    if (spec_.motor_torque) {
      return std::optional(spec_.motor_torque->value * gear);
    }
    if (spec_.torque_constant) {
      return std::optional(spec_.torque_constant->value * spec_.max_current->value * gear);
    }
    return std::optional<double>();
  }

  Result<double> lever_arm() const {
    if (spec_.lever_arm) {
      return spec_.lever_arm->value;
    }
    if (!spec_.tip) {
      return wrong("tip_force without a lever arm",
                   "give lever_arm = \"84 mm\", or tip, the path of the prim at the tip");
    }
    const stage::Prim tip = stage_.prim(*spec_.tip);
    if (!tip) {
      return Error(ErrorCode::NotFound, "no prim <" + spec_.tip->str() + ">")
          .in_file(file_)
          .at(spec_.line, 0)
          .with_rule("drives.no-tip")
          .with_fix("tenon tree ASSET lists the prims; lever_arm does without one");
    }
    const Mat4d world = local_to_world(tip, stage::Time(scene_.start_time_code));
    const Vec3d place = Vec3d{{world[3][0], world[3][1], world[3][2]}} * scene_.meters_per_unit;
    const Pose frame =
        joint_.body0 ? scene_.bodies[*joint_.body0].pose * joint_.frame0 : joint_.frame0;
    const Vec3d axis =
        rotate(frame.orientation, scene::unit_axis(static_cast<scene::Axis>(scene::axis_of(dof_))));
    const double arm = length(cross(place - frame.position, axis));
    if (!(arm > 0)) {
      return wrong("the tip <" + spec_.tip->str() + "> is on the axis", "give lever_arm");
    }
    return arm;
  }

  Result<std::optional<double>> speed() const {
    if (spec_.motor_speed) {
      const double unit = spec_.motor_speed->dimension == Dimension::None ? kRadians : 1;
      return std::optional(spec_.motor_speed->value * unit / spec_.gear_ratio);
    }
    if (!spec_.max_speed) {
      return std::optional<double>();
    }
    const Dimension fitting = turns() ? Dimension::TurnRate : Dimension::Speed;
    if (spec_.max_speed->dimension == Dimension::None) {
      return std::optional(spec_.max_speed->value * (turns() ? kRadians : 1));
    }
    if (spec_.max_speed->dimension != fitting) {
      return wrong("max_speed is in the wrong unit", turns() ? "write deg/s" : "write m/s");
    }
    return std::optional(spec_.max_speed->value);
  }

  const MotorSpec& spec_;
  const std::string& file_;
  const stage::Stage& stage_;
  const scene::PhysicsScene& scene_;
  const scene::Joint& joint_;
  scene::Dof dof_;
};

}  // namespace

Result<SpecLimits> limits_of(const MotorSpec& spec, const std::string& file,
                             const stage::Stage& stage, const scene::PhysicsScene& scene,
                             const scene::Joint& joint, scene::Dof dof) {
  return SpecReader(spec, file, stage, scene, joint, dof).read();
}

}  // namespace tenon
