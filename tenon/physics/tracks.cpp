// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What follows authored time samples while the simulation runs: drives, kinematic bodies, static
// colliders (S-116, S-117). Stage time t becomes (t - start) / timeCodesPerSecond seconds.
#include <algorithm>
#include <cmath>

#include "tenon/base/limits/limits.h"
#include "tenon/physics/joints/drives.h"
#include "tenon/physics/read_state.h"
#include "tenon/physics/switches.h"
#include "tenon/physics/world_pose.h"
#include "tenon/stage/transform_at.h"

namespace tenon::physics {
namespace {

constexpr double kPosesPerFrame = 4;  ///< between authored poses, whose rotation is not linear

class TrackReader {
 public:
  explicit TrackReader(ReadState& state) : state_(state) {}

  void run() {
    for (const DriveInstance& drive : state_.drive_instances) {
      add_drive(drive);
    }
    for (Index i = 0; i < state_.scene.bodies.size(); ++i) {
      add_body(i);
    }
    for (Index i = 0; i < state_.scene.colliders.size(); ++i) {
      if (!state_.scene.colliders[i].body) {
        add_static(i);
      }
    }
    for (Index i = 0; i < state_.scene.joints.size(); ++i) {
      add_anchor(i, 0);
      add_anchor(i, 1);
    }
    report_dynamic();
    if (is_coarse_) {
      state_.scene.not_read.push_back(
          {Path::absolute_root(), "timeSamples",
           "poses between the authored samples of motions are sampled more coarsely than four in a "
           "frame: there are more than " +
               std::to_string(limits::kTrackSamples) + " (kTrackSamples)"});
    }
  }

 private:
  double seconds(double code) const { return state_.seconds(code); }

  /// Codes from the first to the last of `authored`, these included, at least four per frame as
  /// long as all tracks of the scene together have not too many.
  std::vector<double> dense(std::vector<double> authored) {
    const double span = authored.empty() ? 0 : authored.back() - authored.front();
    if (authored.size() < 2 || samples_left_ == 0 || !std::isfinite(span)) {
      is_coarse_ = is_coarse_ || authored.size() > 1;
      return authored;
    }
    const double fps = state_.stage.frames_per_second();
    const double frame = fps > 0 ? state_.scene.time_codes_per_second / fps : 1;
    const double step = std::max(frame / kPosesPerFrame, span / static_cast<double>(samples_left_));
    const double first = authored.front();
    const std::size_t count =
        std::min(static_cast<std::size_t>(std::max(span / step, 0.0)), samples_left_);
    is_coarse_ = is_coarse_ || step > frame / kPosesPerFrame || count == samples_left_;
    samples_left_ -= count;
    authored.reserve(authored.size() + count);
    for (std::size_t i = 1; i <= count; ++i) {
      authored.push_back(first + static_cast<double>(i) * step);
    }
    std::sort(authored.begin(), authored.end());
    authored.erase(std::unique(authored.begin(), authored.end()), authored.end());
    return authored;
  }

  std::vector<double> sample_codes(const stage::Attribute& attribute) {
    std::vector<double> codes = attribute.time_samples();
    if (codes.empty()) {  // a spline
      codes = dense({state_.scene.start_time_code, state_.scene.end_time_code});
    }
    return codes;
  }

  void add_scalar(const DriveInstance& drive, Token name, Animated what, double unit) {
    const stage::Prim& prim = state_.prim_of_joint(drive.joint).prim;
    const stage::Attribute attribute = prim.attribute(name);
    if (!attribute.is_animated()) {
      return;
    }
    state_.follow(prim, name);
    ScalarTrack track;
    track.what = what;
    track.joint = drive.joint;
    track.drive = drive.drive;
    track.held = state_.readings.held_samples == HeldSamples::Held;
    for (const double code : sample_codes(attribute)) {
      const std::optional<double> value = number_of(attribute.get(stage::Time(code)));
      if (value && !std::isnan(*value)) {
        track.times.push_back(seconds(code));
        track.values.push_back(unlimited_or(*value) * unit);
      }
    }
    if (!track.times.empty()) {
      state_.scene.scalar_tracks.push_back(std::move(track));
    }
  }

  void add_drive(const DriveInstance& instance) {
    const Drive& drive = state_.scene.joints[instance.joint].drives[instance.drive];
    const DriveNames names = drive_names(instance.instance);
    const DriveUnits unit = drive_units(state_, drive.dof, drive.acceleration);
    add_scalar(instance, names.target_position, Animated::DriveTargetPosition, unit.position);
    add_scalar(instance, names.target_velocity, Animated::DriveTargetVelocity, unit.velocity);
    if (!(drive.source == state_.scene.joints[instance.joint].path)) {
      return;  // an actuator gives gains and limits
    }
    add_scalar(instance, names.stiffness, Animated::DriveStiffness, unit.stiffness);
    add_scalar(instance, names.damping, Animated::DriveDamping, unit.damping);
    add_scalar(instance, names.max_force, Animated::DriveMaxForce, unit.force);
  }

  /// World poses of a prim, followed by the constant pose `X_PC` of what hangs on it.
  PoseTrack poses(const stage::Prim& prim, const std::vector<double>& codes, const Pose& fixed) {
    PoseTrack track;
    track.held = state_.readings.held_samples == HeldSamples::Held;
    for (const double code : track.held ? codes : dense(codes)) {
      const Mat4d world = stage::local_to_world(prim, stage::Time(code));
      track.times.push_back(seconds(code));
      track.poses.push_back(world_pose(world, state_.units) * fixed);
    }
    return track;
  }

  void add_body(Index i) {
    const PhysicsPrim& found = state_.prim_of_body(i);
    const std::vector<double> codes = stage::transform_samples(found.prim);
    if (codes.size() < 2 || found.instance != kNone) {
      return;  // instances of point instancers stay in their arrays' first place
    }
    const Body& body = state_.scene.bodies[i];
    const bool at_times = found.prim.attribute(state_.tokens.kinematic).is_animated();
    const bool kinematic =
        at_times || (body.enabled ? body.kinematic
                                  : state_.values.flag(found.prim, state_.tokens.kinematic, false));
    if (!kinematic) {
      ++dynamic_count_;
      first_dynamic_ = std::min(first_dynamic_, i);
      return;
    }
    PoseTrack track = poses(found.prim, codes, {});
    track.body = i;
    state_.scene.pose_tracks.push_back(std::move(track));
  }

  void add_static(Index i) {
    const PhysicsPrim& found = state_.prim_of_collider(i);
    const std::vector<double> codes = stage::transform_samples(found.prim);
    if (codes.size() < 2 || found.instance != kNone) {
      return;
    }
    const Pose start = world_pose(found.world, state_.units);
    PoseTrack track = poses(found.prim, codes, inverse(start) * state_.scene.colliders[i].pose);
    track.collider = i;
    state_.scene.pose_tracks.push_back(std::move(track));
  }

  // S-86: the frame in the world moves as the prim does.
  void add_anchor(Index i, int side) {
    const Joint& joint = state_.scene.joints[i];
    const Path target = side == 0 ? joint.target0 : joint.target1;
    if ((side == 0 ? joint.body0 : joint.body1) || target.empty()) {
      return;
    }
    const stage::Prim prim = state_.stage.prim(target);
    const std::vector<double> codes = stage::transform_samples(prim);
    if (codes.size() < 2) {
      return;
    }
    const Pose start = world_pose(stage::local_to_world(prim, state_.values.start()), state_.units);
    PoseTrack track =
        poses(prim, codes, inverse(start) * (side == 0 ? joint.frame0 : joint.frame1));
    track.joint = i;
    track.side = side;
    state_.scene.pose_tracks.push_back(std::move(track));
  }

  // S-117
  void report_dynamic() const {
    if (dynamic_count_ > 0) {
      state_.report(state_.prim_of_body(first_dynamic_).prim, Severity::Warning,
                    "body.animated-dynamic",
                    "the transforms of " + std::to_string(dynamic_count_) +
                        " dynamic bodies are animated; they count at the start only",
                    "author physics:kinematicEnabled to have a body follow its animation");
    }
  }

  ReadState& state_;
  std::size_t samples_left_ = limits::kTrackSamples;  // between authored ones
  bool is_coarse_ = false;
  std::size_t dynamic_count_ = 0;
  Index first_dynamic_ = kNone;
};

}  // namespace

void read_tracks(ReadState& state) {
  if (state.values.stage_is_animated()) {
    TrackReader(state).run();
    read_switches(state);
  }
}

}  // namespace tenon::physics
