// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// All actuators are added and compiled at once, which is enough when MuJoCo takes them. It names
// only its first fault, so after a refusal they are taken out and put back one by one, with a
// compile for each. Those that fail are skipped, with MuJoCo's message, and the others stay. A site
// that an actuator needs is named after its prim and made once, placed in MuJoCo's frame of its
// body. An actuator that runs take as the drive of a joint is written all the same, with its own
// gains, ranges and name; the model is made without that drive.
#include "tenon/mjcf/write_actuators.h"

#include <algorithm>

#include "tenon/engines/mujoco/build/actuator_words.h"
#include "tenon/engines/mujoco/error_hook.h"
#include "tenon/mjcf/write_elements.h"

namespace tenon::mjcf {
namespace {

using engines::mujoco::guarded;
using scene::MujocoActuator;
using Target = MujocoActuator::Target;
using Attachment = scene::TendonWrap::Attachment;

class ActuatorWriter {
 public:
  ActuatorWriter(const scene::PhysicsScene& scene, const engines::mujoco::Model& model,
                 mjSpec& spec)
      : scene_(scene), model_(model), spec_(spec) {}

  /// Why the actuator cannot be said; empty: `made` is there.
  std::string add(const MujocoActuator& from, mjsActuator*& made) {
    made = mjs_addActuator(&spec_, nullptr);
    std::string why = set_transmission(from, *made);
    if (why.empty() && !engines::mujoco::set_actuator_kinds(from, *made)) {
      why = "MuJoCo has no such gain, bias or dynamics";
    }
    if (!why.empty()) {
      mjs_delete(&spec_, made->element);
      made = nullptr;
      return why;
    }
    mjs_setName(made->element, from.path.str().c_str());
    engines::mujoco::set_actuator_numbers(from, *made);
    return {};
  }

 private:
  std::string set_transmission(const MujocoActuator& from, mjsActuator& to) {
    switch (from.kind) {
      case Target::None:
        return from.fault;
      case Target::Joint:
        return set_joint(from, to);
      case Target::Tendon:
        to.trntype = mjTRN_TENDON;
        return set_target(mjOBJ_TENDON, scene_.tendons[from.target].path.str(), to);
      case Target::Site:
        to.trntype = mjTRN_SITE;
        mjs_setString(to.target, site(from.site).c_str());
        if (from.other_site) {
          mjs_setString(to.refsite, site(*from.other_site).c_str());
        }
        return {};
      case Target::Crank:
        to.trntype = mjTRN_SLIDERCRANK;
        to.cranklength = from.crank_length;
        mjs_setString(to.target, site(from.site).c_str());
        mjs_setString(to.slidersite, site(*from.other_site).c_str());
        return {};
    }
    return from.fault;
  }

  std::string set_target(mjtObj kind, const std::string& name, mjsActuator& to) {
    if (name.empty() || mjs_findElement(&spec_, kind, name.c_str()) == nullptr) {
      return "its target is not in the model";
    }
    mjs_setString(to.target, name.c_str());
    return {};
  }

  std::string set_joint(const MujocoActuator& from, mjsActuator& to) {
    const scene::Joint& joint = scene_.joints[from.target];
    const bool ball = joint.kind == scene::JointKind::Spherical;
    if (ball && model_.joints[from.target].reversed) {
      return "its ball is reversed in the model";
    }
    to.trntype = from.in_parent ? mjTRN_JOINTINPARENT : mjTRN_JOINT;
    return set_target(mjOBJ_JOINT, joint_element(spec_, joint), to);
  }

  /// Named after its prim; tendons may have made it.
  std::string site(const Attachment& place) {
    std::string name = place.path.str();
    const std::string body = place.body ? scene_.bodies[*place.body].path.str() : "world";
    const Pose frame = place.body ? inverse(model_.bodies[*place.body].engine_frame) : Pose{};
    named_site(spec_, mjs_findBody(&spec_, body.c_str()), name, frame * place.pose);
    return name;
  }

  const scene::PhysicsScene& scene_;
  const engines::mujoco::Model& model_;
  mjSpec& spec_;
};

/// False where MuJoCo refuses the model.
Result<bool> compiles(mjSpec& spec) {
  mjModel* model = nullptr;
  TENON_CHECK(guarded([&] { model = mj_compile(&spec, nullptr); }));
  mj_deleteModel(model);
  return model != nullptr;
}

void take_out(mjSpec& spec, mjsActuator*& made) {
  mjs_delete(&spec, made->element);
  made = nullptr;
}

// After a refusal: `added` once more, one by one, without those that MuJoCo refuses.
Result<void> add_one_by_one(const std::vector<MujocoActuator>& actuators,
                            const std::vector<std::size_t>& added, ActuatorWriter& writer,
                            mjSpec& spec, std::vector<mjsActuator*>& made,
                            Diagnostics& diagnostics) {
  for (const std::size_t i : added) {
    take_out(spec, made[i]);
  }
  for (const std::size_t i : added) {
    if (!writer.add(actuators[i], made[i]).empty()) {
      continue;
    }
    TENON_TRY(const bool fits, compiles(spec));
    if (!fits) {
      std::string words = mjs_getError(&spec);
      std::replace(words.begin(), words.end(), '\n', ' ');
      report_left_out(diagnostics, actuators[i].path, "", "MuJoCo refuses the actuator: " + words);
      take_out(spec, made[i]);
    }
  }
  TENON_CHECK(compiles(spec));
  return {};
}

}  // namespace

void report_left_out(Diagnostics& diagnostics, const Path& prim, const char* property,
                     std::string message) {
  Diagnostic finding;
  finding.severity = Severity::Warning;
  finding.rule = "mjcf.left-out";
  finding.message = std::move(message);
  finding.prim = prim.str();
  finding.property = property;
  diagnostics.add(std::move(finding));
}

Result<std::vector<mjsActuator*>> write_actuators(const scene::PhysicsScene& scene,
                                                  const std::vector<MujocoActuator>& actuators,
                                                  const engines::mujoco::Model& model, mjSpec& spec,
                                                  Diagnostics& diagnostics) {
  ActuatorWriter writer(scene, model, spec);
  std::vector<mjsActuator*> made(actuators.size(), nullptr);
  std::vector<std::size_t> added;
  for (std::size_t i = 0; i < actuators.size(); ++i) {
    const std::string why = writer.add(actuators[i], made[i]);
    if (!why.empty()) {
      report_left_out(diagnostics, actuators[i].path, "mjc:target",
                      why + "; the actuator is skipped");
      continue;
    }
    added.push_back(i);
  }
  TENON_TRY(const bool all, added.empty() ? Result<bool>(true) : compiles(spec));
  if (!all) {
    TENON_CHECK(add_one_by_one(actuators, added, writer, spec, made, diagnostics));
  }
  return made;
}

}  // namespace tenon::mjcf
