// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The model of a run as MuJoCo's own text. MuJoCo writes what its specification held when it was
// compiled, so that numbers which follow from the compiled model (soft bounds) are compiled in once
// more. Forces that tenon applies from step to step are not part of a model: they are listed, since
// the text would otherwise silently move differently.
#include "tenon/engines/mujoco/write_mjcf.h"

#include <algorithm>
#include <mutex>

#include "tenon/engines/mujoco/build/build.h"
#include "tenon/engines/mujoco/build/option_fields.h"
#include "tenon/engines/mujoco/build/stiffness.h"
#include "tenon/engines/mujoco/error_hook.h"
#include "tenon/engines/mujoco/mujoco_library.h"
#include "tenon/engines/mujoco/writable_model.h"

namespace tenon::engines::mujoco {
namespace {

constexpr int kWordsSize = 1000;

void report_not_mapped(const Model& model, Diagnostics& diagnostics) {
  for (const NotMapped& part : model.not_mapped) {
    Diagnostic finding;
    finding.severity = Severity::Info;
    finding.rule = "mujoco.not-mapped";
    finding.message = part.why;
    finding.prim = part.prim.str();
    finding.property = part.property;
    diagnostics.add(std::move(finding));
  }
}

void report_lost(const Path& prim, const char* property, const char* what,
                 Diagnostics& diagnostics) {
  Diagnostic finding;
  finding.severity = Severity::Warning;
  finding.rule = "mujoco.not-mapped";
  finding.message = std::string(what) + " no part of MuJoCo's models; tenon's own runs have them";
  finding.prim = prim.str();
  finding.property = property;
  diagnostics.add(std::move(finding));
}

void report_bodies(const scene::PhysicsScene& scene, Diagnostics& diagnostics) {
  for (const scene::Body& body : scene.bodies) {
    const scene::BodySettings& settings = body.settings;
    if (!settings.forces.empty()) {
      report_lost(body.path, "forces", "constant forces are", diagnostics);
    }
    if (settings.max_linear_velocity < scene::kUnlimited ||
        settings.max_angular_velocity < scene::kUnlimited) {
      report_lost(body.path, "maxLinearVelocity", "limits of speed are", diagnostics);
    }
    if ((settings.locked_translation | settings.locked_rotation) != 0) {
      report_lost(body.path, "lockedTranslation", "locked axes are", diagnostics);
    }
    if (body.linear_damping > 0 || body.angular_damping > 0) {
      report_lost(body.path, "linearDamping", "the damping of bodies is", diagnostics);
    }
    if (!settings.gyroscopic) {
      report_lost(body.path, "gyroscopic", "bodies without gyroscopic torque are", diagnostics);
    }
  }
}

/// What runs of tenon do from step to step, beside the model.
void report_what_runs_do(const scene::PhysicsScene& scene, Diagnostics& diagnostics) {
  report_bodies(scene, diagnostics);
  for (const scene::Joint& joint : scene.joints) {
    const auto by_mass = [](const scene::Drive& drive) { return drive.acceleration; };
    if (std::any_of(joint.drives.begin(), joint.drives.end(), by_mass)) {
      report_lost(joint.path, "physics:type", "gains by unit of effective mass are", diagnostics);
    }
    if (joint.velocity_limit < scene::kUnlimited) {
      report_lost(joint.path, "velocityLimit", "limits of velocity are", diagnostics);
    }
    for (const scene::Drive& drive : joint.drives) {
      if (drive.envelope.max_velocity < scene::kUnlimited ||
          drive.envelope.velocity_resistance > 0) {
        report_lost(joint.path, "maxVelocity", "performance envelopes are", diagnostics);
      }
    }
  }
  for (const scene::Collider& collider : scene.colliders) {
    if (collider.settings.trigger) {
      report_lost(collider.path, "trigger", "what triggers tell is", diagnostics);
    }
    if (collider.settings.torsional_patch > 0 || collider.settings.min_torsional_patch > 0) {
      report_lost(collider.path, "torsionalPatchRadius", "torsional patches are", diagnostics);
    }
  }
  for (const scene::Material& material : scene.materials) {
    if (material.compliance.stiffness > 0) {
      report_lost(material.path, "compliance", "contacts as springs are", diagnostics);
    }
  }
}

/// Where a drive of the scene acts, in a model that may be without its actuator; -1: nowhere.
int dof_of_drive(const scene::PhysicsScene& scene, const Model& model, const DriveMap& map) {
  const JointMap& joint = model.joints[map.joint];
  const scene::Drive& drive = scene.joints[map.joint].drives[map.drive];
  for (std::size_t i = 0; i < joint.dofs.free.size() && i < joint.dof.size(); ++i) {
    if (joint.dofs.free[i].dof == drive.dof && drive.max_force > 0) {
      return joint.dof[i];
    }
  }
  return -1;
}

bool has_springs(const scene::PhysicsScene& scene) {
  return std::any_of(scene.joints.begin(), scene.joints.end(),
                     [](const auto& joint) { return !joint.limit_springs.empty(); }) ||
         std::any_of(scene.tendons.begin(), scene.tendons.end(),
                     [](const auto& tendon) { return tendon.limit_stiffness > 0; });
}

/// Text is made of what was compiled.
Result<void> compile_again(mjSpec& spec) {
  mjModel* model = nullptr;
  TENON_CHECK(guarded([&] { model = mj_compile(&spec, nullptr); }));
  mj_deleteModel(model);
  return {};
}

/// Where the asset authors MuJoCo's options, unauthored ones are MuJoCo's defaults, not those of
/// simulations.
Result<void> restore_options(const scene::PhysicsScene& scene, mjSpec& spec) {
  const bool speaks = scene.scenes.front().parts.mujoco.has_value();
  if (!speaks && !has_springs(scene)) {
    return {};
  }
  if (!speaks) {
    return compile_again(spec);
  }
  mjOption option;
  mj_defaultOption(&option);
  option.timestep = spec.option.timestep;
  std::copy_n(spec.option.gravity, 3, option.gravity);
  for (const scene::VendorSetting& setting : *scene.scenes.front().parts.mujoco) {
    apply_setting(setting, option);  // what it does not take is reported by now
  }
  spec.option = option;
  return compile_again(spec);
}

}  // namespace

/// MuJoCo writes six digits unless it is told otherwise, by a function without a place in its
/// headers. One text is written at a time, as the number is one for the whole process.
class FullPrecision {
 public:
  FullPrecision() : lock_(mutex()) { set(kDigits); }
  FullPrecision(const FullPrecision&) = delete;
  FullPrecision& operator=(const FullPrecision&) = delete;
  ~FullPrecision() { set(kUsual); }

 private:
  static constexpr int kDigits = 17;  // enough for every double
  static constexpr int kUsual = 6;

  static std::mutex& mutex() {
    static std::mutex held;
    return held;
  }
  static void set(int digits) {
    void* const found = find_mujoco_function("_mjPRIVATE__set_xml_precision");
    if (found != nullptr) {
      reinterpret_cast<void (*)(int)>(found)(digits);
    }
  }
  std::lock_guard<std::mutex> lock_;
};

/// MuJoCo answers how much room the text needs where it is given too little.
Result<std::string> text_of(const mjSpec& spec) {
  char words[kWordsSize] = "";
  std::string text(std::size_t{1} << 20u, '\0');
  int missing = 0;
  const FullPrecision precision;
  const auto save = [&] {
    missing =
        mj_saveXMLString(&spec, text.data(), static_cast<int>(text.size()), words, kWordsSize);
  };
  TENON_CHECK(guarded(save));
  if (missing > 0) {
    text.assign(static_cast<std::size_t>(missing) + 1, '\0');
    TENON_CHECK(guarded(save));
  }
  if (missing != 0) {
    return Error(ErrorCode::Invalid, std::string("MuJoCo cannot write the model: ") + words)
        .with_rule("mujoco.write");
  }
  text.resize(text.find('\0'));
  return text;
}

void report_choices_of_runs(const scene::PhysicsScene& scene, const SpecAndModel& built,
                            Diagnostics& diagnostics) {
  const Model& model = built.model;
  const double time_step = model.model->opt.timestep;
  if (names_integrator(scene)) {
    return;
  }
  std::vector<int> stiff;
  for (std::size_t i = 0; i < model.drives.size(); ++i) {
    DriveMap map = model.drives[i];
    map.dof = dof_of_drive(scene, model, map);
    if (map.dof >= 0 && is_stiff_drive(scene, model, map, time_step)) {
      stiff.push_back(static_cast<int>(i));
    }
  }
  report_drives(scene, model, stiff,
                {Severity::Warning, "mujoco.not-mapped",
                 "the drive is stiff for the step: tenon's own runs solve it together with the "
                 "constraints, and the model has it as an actuator, which moves otherwise",
                 "drive"},
                diagnostics);
  if (const std::optional<scene::Index> spring = stiff_spring(model, time_step)) {
    diagnostics.add({Severity::Warning, "mujoco.not-mapped",
                     "the spring is stiff for the step: tenon's own runs take MuJoCo's integrator "
                     "discrete, which older versions do not know; the model has implicitfast",
                     scene.joints[*spring].path.str(), "stiffness", kOwnIntegrator});
  }
}

Result<SpecAndModel> writable_model(const scene::PhysicsScene& scene,
                                    const SimulationOptions& options, Diagnostics& diagnostics) {
  SimulationOptions exact = options;
  if (exact.time_step <= 0 && !scene.scenes.empty()) {
    exact.time_step = scene.scenes.front().time_step.value_or(0);
  }
  TENON_TRY(SpecAndModel built, build_spec(scene, exact, diagnostics, Begin::Start, Purpose::Text));
  report_not_mapped(built.model, diagnostics);
  report_what_runs_do(scene, diagnostics);
  TENON_CHECK(restore_options(scene, *built.spec));
  return built;
}

Result<std::string> write_mjcf(const scene::PhysicsScene& scene, const SimulationOptions& options,
                               Diagnostics& diagnostics) {
  TENON_TRY(const SpecAndModel built, writable_model(scene, options, diagnostics));
  report_choices_of_runs(scene, built, diagnostics);
  return text_of(*built.spec);
}

}  // namespace tenon::engines::mujoco
