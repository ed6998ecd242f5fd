// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdlib>
#include <string_view>

#include "tenon/engines/mujoco/option_fields.h"
#include "tenon/mjcf/mjcf_reader.h"

namespace tenon::mjcf {
namespace {

/// MuJoCo keeps "line N" with each element that it has read from a file.
const mjString* info_of(mjsElement* element, mjtObj kind) {
  switch (kind) {
    case mjOBJ_ACTUATOR:
      return mjs_asActuator(element)->info;
    case mjOBJ_EQUALITY:
      return mjs_asEquality(element)->info;
    case mjOBJ_TENDON:
      return mjs_asTendon(element)->info;
    case mjOBJ_SENSOR:
      return mjs_asSensor(element)->info;
    case mjOBJ_KEY:
      return mjs_asKey(element)->info;
    case mjOBJ_CAMERA:
      return mjs_asCamera(element)->info;
    case mjOBJ_LIGHT:
      return mjs_asLight(element)->info;
    case mjOBJ_PAIR:
      return mjs_asPair(element)->info;
    case mjOBJ_MATERIAL:
      return mjs_asMaterial(element)->info;
    case mjOBJ_GEOM:
      return mjs_asGeom(element)->info;
    default:
      return nullptr;
  }
}

std::uint32_t line_in(const mjString* info) {
  const std::string_view text = info == nullptr ? "" : mjs_getString(info);
  const std::size_t at = text.find("line ");
  return at == std::string_view::npos
             ? 0
             : static_cast<std::uint32_t>(std::strtoul(text.data() + at + 5, nullptr, 10));
}

}  // namespace

/// Of all elements of a kind, in the order of their numbers; 0 where it is not known.
std::vector<std::uint32_t> MjcfReader::lines_of(mjtObj kind) const {
  std::vector<std::uint32_t> lines;
  for (mjsElement* at = mjs_firstElement(&spec_, kind); at != nullptr;
       at = mjs_nextElement(&spec_, at)) {
    lines.push_back(line_in(info_of(at, kind)));
  }
  return lines;
}

std::uint32_t MjcfReader::line_of(mjtObj kind, int id) {
  const auto [at, is_new] = lines_.try_emplace(kind);
  if (is_new) {
    for (mjsElement* element = mjs_firstElement(&spec_, kind); element != nullptr;
         element = mjs_nextElement(&spec_, element)) {
      at->second.emplace(mjs_getId(element), line_in(info_of(element, kind)));
    }
  }
  const auto line = at->second.find(id);
  return line == at->second.end() ? 0 : line->second;
}

/// ": lines 3, 5", or nothing where no line is known.
std::string MjcfReader::lines_text(const std::vector<std::uint32_t>& lines) {
  std::string text;
  for (const std::uint32_t line : lines) {
    if (line != 0) {
      text += (text.empty() ? ": lines " : ", ") + std::to_string(line);
    }
  }
  return text;
}

/// What a RobotModel has no word for, by kind and number, with its lines.
void MjcfReader::report_left_out() {
  struct Row {
    mjtSize count;
    const char* what;
    mjtObj kind;
  };
  const Row rows[] = {
      {model_.nsensor, "sensors", mjOBJ_SENSOR}, {model_.ncam, "cameras", mjOBJ_CAMERA},
      {model_.nlight, "lights", mjOBJ_LIGHT},    {model_.nflex, "deformables", mjOBJ_UNKNOWN},
      {model_.nskin, "skins", mjOBJ_UNKNOWN},    {model_.nplugin, "plugins", mjOBJ_UNKNOWN}};
  for (const Row& row : rows) {
    if (row.count <= 0) {
      continue;
    }
    std::string text = std::to_string(row.count) + " " + row.what + " are left out";
    const std::vector<std::uint32_t> lines =
        row.kind == mjOBJ_UNKNOWN ? std::vector<std::uint32_t>() : lines_of(row.kind);
    text += lines_text(lines);
    report("mjcf.left-out", std::move(text), Severity::Warning, lines.empty() ? 0 : lines.front());
  }
}

/// Gravity, time step and options; the converter decides what becomes of them.
void MjcfReader::read_scene() {
  robot::MujocoScene& scene = robot_.mujoco.scene.emplace();
  std::copy_n(model_.opt.gravity, 3, scene.gravity.begin());
  scene.time_step = model_.opt.timestep;
  std::vector<std::string> unnamed;
  for (const auto& setting : engines::mujoco::settings_of(model_.opt, unnamed)) {
    scene.settings.push_back({setting.name, setting.numbers, setting.token});
  }
  for (const std::string& option : unnamed) {
    report("mjcf.left-out", "of the options, " + option + " has no name in MuJoCo's schema");
  }
}

}  // namespace tenon::mjcf
