// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/mujoco/write_mjcf.h"

#include "tenon/engines/mujoco/build.h"
#include "tenon/engines/mujoco/error_hook.h"

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

}  // namespace

Result<std::string> write_mjcf(const physics::PhysicsScene& scene, const SimulationOptions& options,
                               Diagnostics& diagnostics) {
  TENON_TRY(const SpecAndModel built, build_spec(scene, options, diagnostics));
  report_not_mapped(built.model, diagnostics);
  return text_of(*built.spec);
}

}  // namespace tenon::engines::mujoco
