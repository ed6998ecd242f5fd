// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Each term is a row of the solver: it looks for the impulse with which
//   speed + softness * impulse = wanted
// at the end of the step, within its bounds. Softness 0 is hard; that of a spring is 1 / (dt d),
// and what it wants is the speed at which damper and spring are at rest. Numbers are in double
// precision, except Jolt's states of bodies.
#include "tenon/engines/jolt/run/coordinate_law.h"

#include <cmath>
#include <utility>

#include <Jolt/Physics/Body/BodyManager.h>
#include <Jolt/Physics/IslandBuilder.h>
#include <Jolt/Physics/LargeIslandSplitter.h>
#include <Jolt/Physics/StateRecorder.h>

#include "tenon/scene/motion/joint_motion.h"

namespace tenon::engines::jolt {
namespace {

constexpr double kNothing = 1e-30;  ///< an impulse moves less than anything

class LawSettings final : public JPH::ConstraintSettings {};

Pose mass_pose(const JPH::Body& body) {
  return {from_jolt(body.GetCenterOfMassPosition()), from_jolt(body.GetRotation())};
}

/// The change of angular velocity by an impulse about an axis, in double precision.
Vec3d inverse_inertia(const JPH::Body& body, const Vec3d& impulse) {
  const JPH::MotionProperties& motion = *body.GetMotionProperties();
  const Quatd axes = from_jolt(body.GetRotation()) * from_jolt(motion.GetInertiaRotation());
  const Vec3d inverse = from_jolt(motion.GetInverseInertiaDiagonal());
  Vec3d own = rotate(conjugate(axes), impulse);
  for (std::size_t i = 0; i < 3; ++i) {
    own[i] *= inverse[i];
  }
  Vec3d turn = rotate(axes, own);
  const auto allowed = static_cast<unsigned>(motion.GetAllowedDOFs()) >> 3U;
  for (std::size_t i = 0; i < 3; ++i) {
    turn[i] = (allowed >> i & 1U) != 0 ? turn[i] : 0;
  }
  return turn;
}

/// x of matrix x = right, for a symmetric matrix that nothing is negative of; what it leaves open
/// is 0.
std::vector<double> solved(std::vector<std::vector<double>> matrix, std::vector<double> right) {
  const std::size_t count = right.size();
  std::vector<double> largest(count);
  for (std::size_t i = 0; i < count; ++i) {
    largest[i] = matrix[i][i];
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (matrix[i][i] <= 1e-12 * largest[i]) {
      matrix[i][i] = 0;
      continue;
    }
    for (std::size_t r = i + 1; r < count; ++r) {
      const double share = matrix[r][i] / matrix[i][i];
      for (std::size_t c = i; share != 0 && c < count; ++c) {
        matrix[r][c] -= share * matrix[i][c];
      }
      right[r] -= share * right[i];
    }
  }
  std::vector<double> result(count, 0);
  for (std::size_t i = count; i-- > 0;) {
    double rest = right[i];
    for (std::size_t c = i + 1; c < count; ++c) {
      rest -= matrix[i][c] * result[c];
    }
    result[i] = matrix[i][i] > 0 ? rest / matrix[i][i] : 0;
  }
  return result;
}

/// The force that a term has left at a speed.
double bound_at(const LawTerm& term, double speed) {
  const scene::DriveEnvelope& envelope = term.envelope;
  double most = term.max_force - envelope.velocity_resistance * speed;
  if (speed >= envelope.max_velocity) {
    return 0;
  }
  if (envelope.speed_effort_gradient > 0) {
    most = std::min(most, (envelope.max_velocity - speed) / envelope.speed_effort_gradient);
  }
  return std::max(most, 0.0);
}

/// The speed of a coordinate is its direction's product with the difference of velocities: for
/// several turns about axes that are not at right angles, each direction must exclude the others.
Vec3d turn_direction(const std::vector<Vec3d>& turns, std::size_t index) {
  if (turns.size() == 1) {
    return turns[0];
  }
  const Vec3d& own = turns[index];
  const Vec3d& next = turns[(index + 1) % turns.size()];
  const Vec3d last = turns.size() == 3 ? turns[(index + 2) % 3] : cross(own, next);
  const Vec3d across = cross(next, last);
  const double share = dot(own, across);
  return std::abs(share) < 1e-6 ? own : across * (1 / share);
}

double unwrapped(double angle, double before) {
  return angle + 2 * M_PI * std::round((before - angle) / (2 * M_PI));
}

bool is_turn(const CoordinateOf& part) {
  return part.index < part.dofs->free.size() && is_angular(part.dofs->free[part.index].dof);
}

double now_at(const CoordinateOf& part, const Pose& frame0, const Pose& frame1) {
  const double found = coordinates_at(*part.dofs, inverse(frame0) * frame1)[part.index];
  return is_turn(part) ? unwrapped(found, part.position) : found;
}

}  // namespace

CoordinateLaw::CoordinateLaw(std::vector<CoordinateOf> parts)
    : Constraint(LawSettings()), parts_(std::move(parts)) {}

std::size_t CoordinateLaw::share_of(JPH::Body* body, std::size_t among) {
  const auto end = shares_.begin() + static_cast<std::ptrdiff_t>(std::min(among, shares_.size()));
  const auto found =
      std::find_if(shares_.begin(), end, [&](const Share& share) { return share.body == body; });
  if (found == end) {
    shares_.push_back({body, {}, {}, {}, {}});
    return shares_.size() - 1;
  }
  return static_cast<std::size_t>(found - shares_.begin());
}

void CoordinateLaw::add_share(JPH::Body* body, const Vec3d& linear, const Vec3d& angular) {
  if (body->IsDynamic()) {
    Share& share = shares_[share_of(body)];
    share.linear += linear;
    share.angular += angular;
  }
}

void CoordinateLaw::add_held(JPH::Body* body, const Vec3d& linear, const Vec3d& angular,
                             Direction& held) {
  if (body->IsDynamic()) {
    const std::size_t at = share_of(body);
    held.linear.resize(std::max(held.linear.size(), at + 1));
    held.angular.resize(std::max(held.angular.size(), at + 1));
    held.linear[at] = linear;
    held.angular[at] = angular;
  }
}

void CoordinateLaw::add_part(std::size_t index) {
  CoordinateOf& part = parts_[index];
  const double coefficient = slope(index);
  const Pose place0 = mass_pose(*part.body0);
  const Pose place1 = mass_pose(*part.body1);
  const Pose frame0 = place0 * part.frame0;
  const Pose frame1 = place1 * part.frame1;
  part.position = now_at(part, frame0, frame1);
  const scene::JointMotion motion = joint_motion(*part.dofs, frame0, frame1);
  const std::size_t slides = motion.slides.size();
  const Vec3d arm0 = motion.point - place0.position;
  const Vec3d arm1 = motion.point - place1.position;
  if (part.index < slides) {
    const Vec3d along = motion.slides[part.index] * coefficient;
    add_share(part.body0, -along, -cross(arm0, along));
    add_share(part.body1, along, cross(arm1, along));
    part.push = {along, {}};
  } else {
    const Vec3d about = turn_direction(motion.turns, part.index - slides) * coefficient;
    add_share(part.body0, {}, -about);
    add_share(part.body1, {}, about);
    part.push = {{}, about};
  }
  if (tree_ != nullptr) {
    return;  // which holds it
  }
  for (const Vec3d& along : scene::directions_across(motion.slides)) {
    held_.push_back({index, {along, {}}, {}, {}});
    add_held(part.body0, -along, -cross(arm0, along), held_.back());
    add_held(part.body1, along, cross(arm1, along), held_.back());
  }
  for (const Vec3d& about : scene::directions_across(motion.turns)) {
    held_.push_back({index, {{}, about}, {}, {}});
    add_held(part.body0, {}, -about, held_.back());
    add_held(part.body1, {}, about, held_.back());
  }
}

// An impulse along the coordinate alone tears at the joint, which its holder then has to correct
// over many iterations, and moves a light link as if it were free. So it goes along with the
// impulses with which the joint stays whole: j' = j + sum x h, where h M^-1 j' = 0 for all that is
// held.
void CoordinateLaw::keep_joints_whole() {
  const std::size_t count = held_.size();
  Direction along;
  for (const Share& share : shares_) {
    along.linear.push_back(share.linear);
    along.angular.push_back(share.angular);
  }
  const auto answer = [&](const Direction& of) {
    Direction result = of;
    for (std::size_t i = 0; i < of.linear.size(); ++i) {
      const JPH::Body& body = *shares_[i].body;
      const double inverse = static_cast<double>(body.GetMotionProperties()->GetInverseMass());
      result.linear[i] = of.linear[i] * inverse;
      result.angular[i] = inverse_inertia(body, of.angular[i]);
    }
    return result;
  };
  const auto product = [](const Direction& one, const Direction& other) {
    double sum = 0;
    for (std::size_t i = 0; i < std::min(one.linear.size(), other.linear.size()); ++i) {
      sum += dot(one.linear[i], other.linear[i]) + dot(one.angular[i], other.angular[i]);
    }
    return sum;
  };
  std::vector<std::vector<double>> matrix(count);
  std::vector<double> wanted(count);
  for (std::size_t r = 0; r < count; ++r) {
    const Direction moved = answer(held_[r]);
    for (std::size_t c = 0; c < count; ++c) {
      matrix[r].push_back(product(moved, held_[c]));
    }
    wanted[r] = -product(moved, along);
  }
  const std::vector<double> impulses = solved(std::move(matrix), std::move(wanted));
  for (std::size_t r = 0; r < count; ++r) {
    Wrench& push = parts_[held_[r].part].push;
    push.force += held_[r].push.force * impulses[r];
    push.torque += held_[r].push.torque * impulses[r];
    for (std::size_t i = 0; i < held_[r].linear.size(); ++i) {
      shares_[i].linear += held_[r].linear[i] * impulses[r];
      shares_[i].angular += held_[r].angular[i] * impulses[r];
    }
  }
}

void CoordinateLaw::find_answers() {
  answer_ = 0;
  for (Share& share : shares_) {
    const JPH::MotionProperties& motion = *share.body->GetMotionProperties();
    share.linear_answer = share.linear * static_cast<double>(motion.GetInverseMass());
    share.angular_answer = inverse_inertia(*share.body, share.angular);
    answer_ += dot(share.linear, share.linear_answer) + dot(share.angular, share.angular_answer);
  }
}

void CoordinateLaw::find_tree_answers() {
  std::vector<Along> sum;
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    sum.push_back({parts_[part].joint, parts_[part].index, slope(part)});
  }
  in_tree_ = tree_->answer(sum);
  answer_ = in_tree_.speed;
  for (std::size_t i = 0; i < in_tree_.bodies.size(); ++i) {
    // A tree has each body once.
    Share& share = shares_[share_of(in_tree_.bodies[i], speaking_)];
    share.linear_answer = in_tree_.velocities[i].move;
    share.angular_answer = in_tree_.velocities[i].turn;
  }
}

double CoordinateLaw::total_impulse() const {
  double sum = 0;
  for (const LawTerm& term : terms) {
    sum += term.impulse;
  }
  return sum;
}

void CoordinateLaw::note_impulse() const {
  if (tree_ != nullptr && !shares_.empty()) {
    tree_->note(in_tree_, total_impulse());
  }
}

double CoordinateLaw::value() const {
  double sum = -offset;
  for (const CoordinateOf& part : parts_) {
    sum += part.coefficient * part.position;
  }
  double power = parts_.size() > 1 ? parts_[1].position : 0;
  for (const double coefficient : powers) {
    power *= parts_.size() > 1 ? parts_[1].position : 0;
    sum -= coefficient * power;
  }
  return sum;
}

Wrench CoordinateLaw::impulse(std::size_t part) const {
  const double sum = total_impulse();
  return {parts_[part].push.force * sum, parts_[part].push.torque * sum};
}

double CoordinateLaw::speed() const {
  double sum = 0;
  for (std::size_t i = 0; i < speaking_; ++i) {
    const Share& share = shares_[i];
    sum += dot(share.linear, from_jolt(share.body->GetLinearVelocity())) +
           dot(share.angular, from_jolt(share.body->GetAngularVelocity()));
  }
  return sum;
}

double CoordinateLaw::inertia() const {
  double armature = 0;
  for (const LawTerm& term : terms) {
    armature += term.kind == TermKind::Armature ? term.inertia : 0;
  }
  return answer_ > kNothing ? 1 / answer_ + armature : scene::kUnlimited;
}

double CoordinateLaw::slope(std::size_t part) const {
  double slope = parts_[part].coefficient;
  double power = 1;
  for (std::size_t i = 0; part == 1 && i < powers.size(); ++i) {
    power *= parts_[1].position;
    slope -= powers[i] * static_cast<double>(i + 2) * power;
  }
  return slope;
}

void CoordinateLaw::count_turns() {
  for (CoordinateOf& part : parts_) {
    part.position =
        now_at(part, mass_pose(*part.body0) * part.frame0, mass_pose(*part.body1) * part.frame1);
  }
}

LawTerm* CoordinateLaw::own_term(Parameter what) {
  const auto is_it = [&](const LawTerm& term) {
    switch (what) {
      case Parameter::JointDamping:
        return term.kind == TermKind::Spring && term.own;
      case Parameter::JointFriction:
        return term.kind == TermKind::Friction;
      case Parameter::JointArmature:
        return term.kind == TermKind::Armature;
      default:
        return false;
    }
  };
  const auto found = std::find_if(terms.begin(), terms.end(), is_it);
  return found == terms.end() ? nullptr : &*found;
}

void CoordinateLaw::prepare(double time_step) {
  shares_.clear();
  held_.clear();
  if (terms.empty()) {
    count_turns();
    return;
  }
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    add_part(part);
  }
  speaking_ = shares_.size();
  if (tree_ != nullptr) {
    find_tree_answers();
  } else {
    keep_joints_whole();
    find_answers();
  }
  position_ = value();
  const double now = speed();
  for (LawTerm& term : terms) {
    prepare_term(term, time_step, now);
    term.acts = term.acts && answer_ > kNothing;
    term.mass = 1 / (answer_ + term.softness);
    term.impulse = term.acts ? std::clamp(term.impulse, term.least, term.most) : 0;
  }
}

// The spring where the step begins, the damper where it ends: impulse = dt (k (x* - x) + d (v* -
// v')). A spring with less damping than k dt is damped by that, as it would gain energy else.
void CoordinateLaw::set_spring(LawTerm& term, double time_step) const {
  const double moved = term.acceleration && answer_ > kNothing ? inertia() : 1;
  const double stiffness = term.stiffness * moved;
  const double damping = term.damping * moved;
  const double effective = std::max(damping, stiffness * time_step);
  term.acts = effective > 0;
  term.softness = term.acts ? 1 / (time_step * effective) : 0;
  const double force =
      stiffness * (term.target_position - position_) + damping * term.target_velocity;
  term.wanted = term.acts ? force / effective : 0;
}

// A bound that is reached within the step is held where it is; one that is passed is left to the
// solver of positions.
void CoordinateLaw::prepare_bound(LawTerm& term, double time_step, double speed) {
  const double side = term.kind == TermKind::Lower ? 1 : -1;
  const double room = side * (position_ - term.target_position);
  term.least = side > 0 ? 0 : -scene::kUnlimited;
  term.most = side > 0 ? scene::kUnlimited : 0;
  if (term.stiffness > 0) {
    set_spring(term, time_step);
    term.acts = term.acts && room < 0;
    return;
  }
  term.acts = true;
  const bool meets = room + side * speed * time_step <= 0;
  const bool rebounds =
      meets && term.restitution > 0 && side * speed < -std::max(term.bounce_threshold, 0.0);
  term.wanted = rebounds ? -term.restitution * speed : -side * std::max(room, 0.0) / time_step;
}

void CoordinateLaw::prepare_term(LawTerm& term, double time_step, double speed) {
  term.acts = true;
  term.softness = 0;
  term.wanted = 0;
  const double bound = bound_at(term, std::abs(speed));
  term.least = -bound * time_step;
  term.most = bound * time_step;
  switch (term.kind) {
    case TermKind::Spring:
      set_spring(term, time_step);
      break;
    case TermKind::Force: {
      set_spring(term, time_step);
      const double moved = term.acceleration ? inertia() : 1;
      const double force = moved * (term.stiffness * (term.target_position - position_) +
                                    term.damping * (term.target_velocity - speed));
      term.least = term.most = time_step * std::clamp(force, -bound, bound);
      break;
    }
    case TermKind::Lower:
    case TermKind::Upper:
      prepare_bound(term, time_step, speed);
      break;
    case TermKind::Friction:
      break;
    case TermKind::Armature:
      term.softness = 1 / term.inertia;
      term.wanted = speed;
      break;
    case TermKind::Slowest:
      term.least = 0;
      term.wanted = term.target_velocity;
      break;
    case TermKind::Fastest:
      term.most = 0;
      term.wanted = term.target_velocity;
      break;
    case TermKind::Equal:
      if (term.stiffness > 0) {
        set_spring(term, time_step);
      }
      break;
  }
}

void CoordinateLaw::push(double impulse) const {
  for (const Share& share : shares_) {
    JPH::MotionProperties& motion = *share.body->GetMotionProperties();
    motion.AddLinearVelocityStep(to_jolt(share.linear_answer * impulse));
    motion.AddAngularVelocityStep(to_jolt(share.angular_answer * impulse));
  }
}

// NOLINTBEGIN(readability-identifier-naming): names of Jolt
void CoordinateLaw::ResetWarmStart() {
  for (LawTerm& term : terms) {
    term.impulse = 0;
  }
}

bool CoordinateLaw::IsActive() const {
  if (!GetEnabled()) {
    return false;
  }
  return std::any_of(shares_.begin(), shares_.end(),
                     [](const Share& share) { return share.body->IsActive(); });
}

void CoordinateLaw::WarmStartVelocityConstraint(float ratio) {
  double sum = 0;
  for (LawTerm& term : terms) {
    term.impulse *= static_cast<double>(ratio);
    sum += term.impulse;
  }
  if (sum != 0) {
    push(sum);
  }
}

bool CoordinateLaw::SolveVelocityConstraint(float /*time_step*/) {
  double now = speed();
  double sum = 0;
  for (LawTerm& term : terms) {
    if (!term.acts) {
      continue;
    }
    const double missing = term.wanted - now - term.softness * term.impulse;
    const double total = std::clamp(term.impulse + term.mass * missing, term.least, term.most);
    const double change = total - term.impulse;
    term.impulse = total;
    now += answer_ * change;
    sum += change;
  }
  if (sum != 0) {
    push(sum);
  }
  return sum != 0;
}

bool CoordinateLaw::SolvePositionConstraint(float /*time_step*/, float baumgarte) {
  bool looked = false;
  double wrong = 0;
  for (const LawTerm& term : terms) {
    const bool holds = term.kind == TermKind::Lower || term.kind == TermKind::Upper ||
                       term.kind == TermKind::Equal;
    if (!holds || term.stiffness > 0 || !term.acts) {
      continue;
    }
    if (!looked) {
      count_turns();
      looked = true;
    }
    const double off = value() - term.target_position;
    const bool allowed =
        (term.kind == TermKind::Lower && off >= 0) || (term.kind == TermKind::Upper && off <= 0);
    wrong = allowed ? wrong : off;
  }
  if (wrong == 0) {
    return false;
  }
  const double impulse = -static_cast<double>(baumgarte) * wrong / answer_;
  for (const Share& share : shares_) {
    share.body->AddPositionStep(to_jolt(share.linear_answer * impulse));
    share.body->AddRotationStep(to_jolt(share.angular_answer * impulse));
  }
  return true;
}

void CoordinateLaw::BuildIslands(JPH::uint32 index, JPH::IslandBuilder& islands,
                                 JPH::BodyManager& bodies) {
  for (const Share& share : shares_) {
    if (!share.body->IsActive()) {
      const JPH::BodyID id = share.body->GetID();
      bodies.ActivateBodies(&id, 1);
    }
  }
  const JPH::uint32 first = shares_.front().body->GetIndexInActiveBodiesInternal();
  for (const Share& share : shares_) {
    islands.LinkBodies(first, share.body->GetIndexInActiveBodiesInternal());
  }
  islands.LinkConstraint(index, first, first);
}

// Large islands are not split here: steps run on one thread.
JPH::uint CoordinateLaw::BuildIslandSplits(JPH::LargeIslandSplitter& /*islands*/) const {
  return JPH::LargeIslandSplitter::cNonParallelSplitIdx;
}

void CoordinateLaw::SaveState(JPH::StateRecorder& stream) const {
  Constraint::SaveState(stream);
  for (const CoordinateOf& part : parts_) {
    stream.Write(part.position);
  }
  for (const LawTerm& term : terms) {
    stream.Write(term.impulse);
  }
}

void CoordinateLaw::RestoreState(JPH::StateRecorder& stream) {
  Constraint::RestoreState(stream);
  for (CoordinateOf& part : parts_) {
    stream.Read(part.position);
  }
  for (LawTerm& term : terms) {
    stream.Read(term.impulse);
  }
}
// NOLINTEND(readability-identifier-naming)

}  // namespace tenon::engines::jolt
