// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/foreign_settings.h"

#include <string>

namespace tenon::engines {
namespace {

class Reporter {
 public:
  explicit Reporter(std::vector<NotMapped>& list) : list_(list) {}

  void physx(const Path& prim, const std::string& space,
             const std::vector<scene::VendorSetting>& settings) {
    for (const scene::VendorSetting& setting : settings) {
      list_.push_back({prim, space + setting.name, "a setting of PhysX's solver"});
    }
  }

  /// `says`: the asset authors it.
  void mujoco(const Path& prim, const std::string& name, bool says) {
    if (says) {
      list_.push_back({prim, "mjc:" + name, "a setting of MuJoCo's solver"});
    }
  }

 private:
  std::vector<NotMapped>& list_;
};

}  // namespace

void report_physx_settings(const scene::PhysicsScene& scene, std::vector<NotMapped>& list) {
  Reporter reporter(list);
  for (const scene::Scene& each : scene.scenes) {
    reporter.physx(each.path, "physxScene:", each.parts.physx);
  }
  for (const scene::Body& body : scene.bodies) {
    reporter.physx(body.path, "physxRigidBody:", body.parts.physx);
  }
  for (const scene::Articulation& articulation : scene.articulations) {
    reporter.physx(articulation.path, "physxArticulation:", articulation.parts.physx);
  }
}

void report_mujoco_settings(const scene::PhysicsScene& scene, std::vector<NotMapped>& list) {
  Reporter reporter(list);
  for (const scene::Scene& each : scene.scenes) {
    for (const scene::VendorSetting& setting :
         each.parts.mujoco.value_or(std::vector<scene::VendorSetting>())) {
      reporter.mujoco(each.path, setting.name, true);
    }
  }
  for (const scene::Collider& collider : scene.colliders) {
    const scene::MujocoContact& contact = collider.parts.mujoco;
    reporter.mujoco(collider.path, "condim", contact.condim.has_value());
    reporter.mujoco(collider.path, "priority", contact.priority.has_value());
    reporter.mujoco(collider.path, "solmix", contact.solmix.has_value());
    reporter.mujoco(collider.path, "solref", !contact.solref.empty());
    reporter.mujoco(collider.path, "solimp", !contact.solimp.empty());
  }
  for (const scene::Joint& joint : scene.joints) {
    const scene::MujocoSoftness& softness = joint.parts.mujoco;
    reporter.mujoco(joint.path, "solreflimit", !softness.solref_limit.empty());
    reporter.mujoco(joint.path, "solimplimit", !softness.solimp_limit.empty());
    reporter.mujoco(joint.path, "solreffriction", !softness.solref_friction.empty());
    reporter.mujoco(joint.path, "solimpfriction", !softness.solimp_friction.empty());
    const scene::MujocoLoop& loop = joint.parts.mujoco_loop;
    reporter.mujoco(joint.path, "solref", !loop.solref.empty());
    reporter.mujoco(joint.path, "solimp", !loop.solimp.empty());
    reporter.mujoco(joint.path, "torqueScale", loop.torque_scale.has_value());
    for (const scene::Mimic& mimic : joint.mimics) {
      reporter.mujoco(joint.path, "solref", !mimic.parts.mujoco.solref.empty());
      reporter.mujoco(joint.path, "solimp", !mimic.parts.mujoco.solimp.empty());
    }
  }
}

}  // namespace tenon::engines
