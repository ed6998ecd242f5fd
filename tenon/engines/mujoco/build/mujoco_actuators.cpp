// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Actuators of MuJoCo's schema that are no drives of joints: on tendons, sites, cranks and balls,
// or with dynamics of their own. Their controls are 0 until something sets them.
#include <string>

#include "tenon/engines/mujoco/build/actuator_words.h"
#include "tenon/engines/mujoco/build/build.h"

namespace tenon::engines::mujoco {
namespace {

using scene::MujocoActuator;
using Target = MujocoActuator::Target;

class ActuatorPass {
 public:
  explicit ActuatorPass(Build& build) : build_(build) {}

  void add(const MujocoActuator& from) {
    const std::string why = from.fault.empty() ? transmission(from) : from.fault;
    mjsActuator* made = why.empty() ? mjs_addActuator(build_.spec.get(), nullptr) : nullptr;
    if (made == nullptr || !set_actuator_kinds(from, *made)) {
      build_.report(from.path, "mjc:target",
                    (why.empty() ? "MuJoCo has no such gain, bias or dynamics" : why) +
                        "; the actuator is skipped");
      if (made != nullptr) {
        mjs_delete(build_.spec.get(), made->element);
      }
      return;
    }
    mjs_setName(made->element, from.path.str().c_str());
    made->trntype = type_;
    mjs_setString(made->target, target_.c_str());
    if (from.kind == Target::Site && from.other_site) {
      mjs_setString(made->refsite, site_at(build_, *from.other_site).c_str());
    } else if (from.kind == Target::Crank) {
      mjs_setString(made->slidersite, site_at(build_, *from.other_site).c_str());
      made->cranklength = from.crank_length;
    }
    set_actuator_numbers(from, *made);
  }

 private:
  bool exists(mjtObj kind) const {
    return mjs_findElement(build_.spec.get(), kind, target_.c_str()) != nullptr;
  }

  /// Why it acts on nothing; else `type_` and `target_` say on what.
  std::string transmission(const MujocoActuator& from) {
    const char* const missing = "its target is not in the model";
    switch (from.kind) {
      case Target::None:
        return missing;
      case Target::Joint: {
        const scene::Joint& joint = build_.scene.joints[from.target];
        const bool ball = joint.kind == scene::JointKind::Spherical;
        type_ = from.in_parent ? mjTRN_JOINTINPARENT : mjTRN_JOINT;
        target_ = joint.path.str() + "." + (ball ? "ball" : std::string(dof_name(joint.dof())));
        return exists(mjOBJ_JOINT) ? "" : missing;
      }
      case Target::Tendon:
        type_ = mjTRN_TENDON;
        target_ = build_.scene.tendons[from.target].path.str();
        return exists(mjOBJ_TENDON) ? "" : missing;
      case Target::Site:
      case Target::Crank:
        type_ = from.kind == Target::Site ? mjTRN_SITE : mjTRN_SLIDERCRANK;
        target_ = site_at(build_, from.site);
        return from.kind == Target::Site || from.other_site ? "" : missing;
    }
    return missing;
  }

  Build& build_;
  mjtTrn type_ = mjTRN_JOINT;
  std::string target_;
};

}  // namespace

void add_mujoco_actuators(Build& build) {
  ActuatorPass pass(build);
  for (const MujocoActuator& actuator : build.scene.actuators) {
    if (build.refused.contains(actuator.path)) {
      build.report(actuator.path, "mjc:target", "MuJoCo refuses the actuator; skipped");
    } else {
      pass.add(actuator);
    }
  }
}

}  // namespace tenon::engines::mujoco
