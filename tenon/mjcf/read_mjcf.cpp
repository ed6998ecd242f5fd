// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/mjcf/read_mjcf.h"

#include <cstdlib>
#include <filesystem>
#include <memory>

#include "tenon/engines/mujoco/error_hook.h"
#include "tenon/engines/mujoco/model.h"
#include "tenon/mjcf/mjcf_reader.h"

namespace tenon::mjcf {
namespace {

using engines::mujoco::guarded;
using engines::mujoco::ModelPtr;
using engines::mujoco::SpecPtr;

/// MuJoCo's words with the line that they name, if any.
Error fault(ErrorCode code, std::string words, const std::string& path) {
  for (char& c : words) {
    c = c == '\n' ? ' ' : c;
  }
  const std::size_t at = words.find("line ");
  const auto line = at == std::string::npos ? 0 : std::strtoul(words.c_str() + at + 5, nullptr, 10);
  return Error(code, "MuJoCo: " + words)
      .in_file(path)
      .at(static_cast<std::uint32_t>(line), 0)
      .with_rule("mjcf.parse")
      .with_fix("correct the model; MuJoCo itself refuses it");
}

Result<SpecPtr> parse(const std::string& path) {
  char words[1000] = "";
  mjSpec* spec = nullptr;
  TENON_CHECK(engines::mujoco::open_mujoco());
  const auto parse_xml = reinterpret_cast<decltype(&::mj_parseXML)>(
      engines::mujoco::find_mujoco_function("mj_parseXML"));
  if (parse_xml == nullptr) {
    return fault(ErrorCode::Missing, "it has no mj_parseXML", path);
  }
  TENON_CHECK(guarded([&] { spec = parse_xml(path.c_str(), nullptr, words, sizeof(words)); }));
  if (spec == nullptr) {
    return fault(ErrorCode::Parse, words, path);
  }
  return SpecPtr(spec);
}

/// All of the model, nothing fused or thrown away.
Result<ModelPtr> compile(mjSpec& spec, const std::string& path) {
  spec.compiler.fusestatic = 0;
  spec.compiler.discardvisual = 0;
  mjModel* model = nullptr;
  TENON_CHECK(guarded([&] { model = mj_compile(&spec, nullptr); }));
  if (model == nullptr) {
    return fault(ErrorCode::Invalid, mjs_getError(&spec), path);
  }
  return ModelPtr(model);
}

}  // namespace

Result<robot::RobotModel> read_mjcf(const std::string& path, Diagnostics& diagnostics) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    return Error(ErrorCode::NotFound, "there is no such file").in_file(path);
  }
  TENON_TRY(const SpecPtr spec, parse(path));
  TENON_TRY(const ModelPtr model, compile(*spec, path));
  std::string name = mjs_getString(spec->modelname);
  if (name.empty() || name == "MuJoCo Model") {
    name = std::filesystem::path(path).stem().string();
  }
  return MjcfReader(*spec, *model, path, diagnostics).run(std::move(name));
}

}  // namespace tenon::mjcf
