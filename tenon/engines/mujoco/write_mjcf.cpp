// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/mujoco/write_mjcf.h"

#include <algorithm>

#include "tenon/engines/mujoco/build/build.h"
#include "tenon/engines/mujoco/build/option_fields.h"
#include "tenon/engines/mujoco/error_hook.h"
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

/// Where the asset speaks of MuJoCo's options, what it does not say is MuJoCo's default, not that
/// of simulations.
Result<void> restore_options(const scene::PhysicsScene& scene, mjSpec& spec) {
  if (!scene.scenes.front().parts.mujoco) {
    return {};
  }
  mjOption option;
  mj_defaultOption(&option);
  option.timestep = spec.option.timestep;
  std::copy_n(spec.option.gravity, 3, option.gravity);
  for (const scene::MujocoSetting& setting : *scene.scenes.front().parts.mujoco) {
    apply_setting(setting, option);  // what it does not take is reported by now
  }
  spec.option = option;
  mjModel* model = nullptr;  // text is made of what was compiled
  TENON_CHECK(guarded([&] { model = mj_compile(&spec, nullptr); }));
  mj_deleteModel(model);
  return {};
}

}  // namespace

/// MuJoCo answers how much room the text needs where it is given too little.
Result<std::string> text_of(const mjSpec& spec) {
  char words[kWordsSize] = "";
  std::string text(std::size_t{1} << 20u, '\0');
  int missing = 0;
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

Result<SpecAndModel> writable_model(const scene::PhysicsScene& scene,
                                    const SimulationOptions& options, Diagnostics& diagnostics) {
  SimulationOptions exact = options;
  if (exact.time_step <= 0 && !scene.scenes.empty()) {
    exact.time_step = scene.scenes.front().time_step.value_or(0);
  }
  TENON_TRY(SpecAndModel built, build_spec(scene, exact, diagnostics));
  report_not_mapped(built.model, diagnostics);
  TENON_CHECK(restore_options(scene, *built.spec));
  return built;
}

Result<std::string> write_mjcf(const scene::PhysicsScene& scene, const SimulationOptions& options,
                               Diagnostics& diagnostics) {
  TENON_TRY(const SpecAndModel built, writable_model(scene, options, diagnostics));
  return text_of(*built.spec);
}

}  // namespace tenon::engines::mujoco
