// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A follower whose leader has no coordinate any more moves on its own, a tendon or an actuator that
// goes along it or along a body that is switched off stops acting, a sensor there reads nothing,
// and tracks of what is masked are dropped, so that none of them switches it on again.
#include <algorithm>

#include "tenon/dynamics/mask_scene.h"

namespace tenon::dynamics {
namespace {

using scene::Joint;

class References {
 public:
  References(const Masked& masked, scene::PhysicsScene& scene, Diagnostics& findings)
      : masked_(masked),
        scene_(scene),
        findings_(findings),
        tendon_off_(scene.tendons.size(), 0),
        actuator_off_(scene.actuators.size(), 0) {}

  void run() {
    free_followers();
    stop_tendons();
    stop_actuators();
    stop_sensors();
    drop_tracks();
    drop_object_tracks();
  }

 private:
  void tell(const Message& message, Path prim) {
    findings_.add({Severity::Info, "mask.skipped", message, prim.str(), {}, {}});
  }

  void free_followers() {
    for (Joint& joint : scene_.joints) {
      std::erase_if(joint.mimics, [&](const scene::Mimic& mimic) {
        const bool goes = masked_.is_masked(mimic.leader);
        if (goes && joint.enabled) {
          tell("the joint does not follow " +
                   named(scene_.joints[mimic.leader].path, RelatedRole::Joint) +
                   " any more, which is masked",
               joint.path);
        }
        return goes;
      });
    }
  }

  bool is_gone(const scene::TendonWrap::Attachment& attachment) const {
    return masked_.is_off(attachment.body);
  }

  void stop_tendons() {
    for (std::size_t t = 0; t < scene_.tendons.size(); ++t) {
      scene::Tendon& tendon = scene_.tendons[t];
      const bool gone =
          std::any_of(tendon.joints.begin(), tendon.joints.end(),
                      [&](Index j) { return masked_.is_masked(j); }) ||
          std::any_of(tendon.wraps.begin(), tendon.wraps.end(), [&](const scene::TendonWrap& wrap) {
            return is_gone(wrap.attachment) || (wrap.side && is_gone(*wrap.side));
          });
      if (gone) {
        tendon_off_[t] = 1;
        tendon.stiffness = tendon.damping = tendon.friction = tendon.armature = 0;
        tendon.range.reset();
        tendon.settings.clear();
        tell("the tendon does not act, because what it goes along is masked", tendon.path);
      }
    }
  }

  bool is_gone(const scene::MujocoActuator& actuator) const {
    using Target = scene::MujocoActuator::Target;
    switch (actuator.kind) {
      case Target::None:
        return false;
      case Target::Joint:
        return masked_.is_masked(actuator.target);
      case Target::Tendon:
        return tendon_off_[actuator.target] != 0;
      case Target::Site:
      case Target::Crank:
        break;
    }
    return is_gone(actuator.site) || (actuator.other_site && is_gone(*actuator.other_site));
  }

  void stop_actuators() {
    for (std::size_t a = 0; a < scene_.actuators.size(); ++a) {
      scene::MujocoActuator& actuator = scene_.actuators[a];
      if (is_gone(actuator)) {
        actuator_off_[a] = 1;
        actuator.kind = scene::MujocoActuator::Target::None;
        actuator.drive.reset();
        actuator.fault = "what it acts on is masked";
        tell("the actuator does not act, because what it acts on is masked", actuator.path);
      }
    }
  }

  void stop_sensors() {
    for (scene::Sensor& sensor : scene_.sensors) {
      const bool of_joint = sensor.kind == scene::SensorKind::Joint;
      const bool gone = masked_.is_off(sensor.body) ||
                        (sensor.joint && masked_.joint_off[*sensor.joint] != 0) ||
                        (of_joint && sensor.joint && masked_.is_masked(*sensor.joint));
      if (gone && sensor.enabled) {
        sensor.enabled = false;
        tell("the sensor reads nothing, because what it measures is masked", sensor.path);
      }
    }
  }

  // ---- what changes over time

  bool stands(const std::optional<Index>& body) const {
    return body && (masked_.is_off(*body) || masked_.anchored[*body] != 0);
  }

  bool is_off_collider(Index collider) const {
    return masked_.collider_off[collider] != 0 || masked_.is_off(scene_.colliders[collider].body);
  }

  bool is_switched(const scene::SwitchTrack& track) const {
    switch (track.what) {
      case scene::Switch::BodyEnabled:
      case scene::Switch::BodyKinematic:
        return stands(track.object);
      case scene::Switch::ColliderEnabled:
        return is_off_collider(track.object);
      case scene::Switch::JointEnabled:
        return masked_.is_masked(track.object);
      case scene::Switch::JointCollision:
        break;
    }
    return false;
  }

  void drop_tracks() {
    const auto of_joint = [this](const auto& track) { return masked_.is_masked(track.joint); };
    std::erase_if(scene_.scalar_tracks, of_joint);
    std::erase_if(scene_.bounds_tracks, of_joint);
    std::erase_if(scene_.switch_tracks,
                  [this](const scene::SwitchTrack& track) { return is_switched(track); });
    std::erase_if(scene_.pose_tracks, [this](const scene::PoseTrack& track) {
      return stands(track.body) || (track.collider && is_off_collider(*track.collider)) ||
             (track.joint && masked_.is_masked(*track.joint));
    });
    std::erase_if(scene_.shapes_tracks,
                  [this](const scene::ShapesTrack& track) { return masked_.is_off(track.body); });
    for (scene::NestingState& state : scene_.nesting_states) {
      std::erase_if(state.merged, [this](const scene::MergedBody& merged) {
        return masked_.is_off(merged.body) || masked_.is_off(merged.into);
      });
    }
  }

  void drop_object_tracks() {
    std::erase_if(scene_.body_tracks,
                  [this](const auto& track) { return masked_.is_off(track.object); });
    std::erase_if(scene_.collider_tracks,
                  [this](const auto& track) { return is_off_collider(track.object); });
    std::erase_if(scene_.joint_tracks,
                  [this](const auto& track) { return masked_.is_masked(track.object); });
    std::erase_if(scene_.tendon_tracks,
                  [this](const auto& track) { return tendon_off_[track.object] != 0; });
    std::erase_if(scene_.actuator_tracks,
                  [this](const auto& track) { return actuator_off_[track.object] != 0; });
  }

  const Masked& masked_;
  scene::PhysicsScene& scene_;
  Diagnostics& findings_;
  std::vector<char> tendon_off_;    // (tendon_count)
  std::vector<char> actuator_off_;  // (actuator_count)
};

}  // namespace

void drop_references(const Masked& masked, scene::PhysicsScene& scene, Diagnostics& findings) {
  References(masked, scene, findings).run();
}

}  // namespace tenon::dynamics
