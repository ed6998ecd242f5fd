// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/jolt/run/measured_holder.h"

#include <Jolt/Physics/Body/Body.h>

namespace tenon::engines::jolt {
namespace {

class HolderSettings final : public JPH::ConstraintSettings {};

double inverse_or_none(double inverse) { return inverse > 0 ? 1 / inverse : 0; }

}  // namespace

MeasuredHolder::MeasuredHolder(JPH::TwoBodyConstraint* holder, const Vec3d& point1)
    : Constraint(HolderSettings()), holder_(holder), point1_(point1) {
  const bool first = !holder->GetBody2()->IsDynamic();
  body_ = first ? holder->GetBody1() : holder->GetBody2();
  side_ = first ? -1 : 1;
}

Wrench MeasuredHolder::impulse() const {
  if (!body_->IsDynamic()) {
    return {};
  }
  const JPH::MotionProperties& motion = *body_->GetMotionProperties();
  Wrench result;
  result.force = linear_ * (side_ * inverse_or_none(static_cast<double>(motion.GetInverseMass())));
  const Quatd axes = turned_ * from_jolt(motion.GetInertiaRotation());
  Vec3d own = rotate(conjugate(axes), angular_);
  for (JPH::uint i = 0; i < 3; ++i) {
    own[i] *= inverse_or_none(static_cast<double>(motion.GetInverseInertiaDiagonal()[i]));
  }
  result.torque = rotate(axes, own) * side_ - cross(arm_, result.force);
  return result;
}

MeasuredHolder::Motion MeasuredHolder::motion() const {
  return {body_->GetLinearVelocity(), body_->GetAngularVelocity()};
}

void MeasuredHolder::add(const Motion& before) {
  const Motion after = motion();
  linear_ += from_jolt(after.linear - before.linear);
  angular_ += from_jolt(after.angular - before.angular);
}

// NOLINTBEGIN(readability-identifier-naming): names of Jolt
void MeasuredHolder::SetupVelocityConstraint(float time_step) {
  linear_ = {};
  angular_ = {};
  turned_ = from_jolt(body_->GetRotation());
  const JPH::Body& body1 = *holder_->GetBody2();
  arm_ = from_jolt(body1.GetCenterOfMassPosition()) +
         rotate(from_jolt(body1.GetRotation()), point1_) -
         from_jolt(body_->GetCenterOfMassPosition());
  holder_->SetupVelocityConstraint(time_step);
}

void MeasuredHolder::WarmStartVelocityConstraint(float ratio) {
  const Motion before = motion();
  holder_->WarmStartVelocityConstraint(ratio);
  add(before);
}

bool MeasuredHolder::SolveVelocityConstraint(float time_step) {
  const Motion before = motion();
  const bool pushed = holder_->SolveVelocityConstraint(time_step);
  add(before);
  return pushed;
}

void MeasuredHolder::SaveState(JPH::StateRecorder& stream) const {
  Constraint::SaveState(stream);
  holder_->SaveState(stream);
}

void MeasuredHolder::RestoreState(JPH::StateRecorder& stream) {
  Constraint::RestoreState(stream);
  holder_->RestoreState(stream);
}
// NOLINTEND(readability-identifier-naming)

}  // namespace tenon::engines::jolt
