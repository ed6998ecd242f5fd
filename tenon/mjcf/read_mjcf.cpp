// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// MuJoCo itself parses and compiles the model, so that a description means what it means there; the
// tables of the compiled model are then read, each kind of object in turn. Nothing is fused or
// dropped by the compiler, and the text itself is kept, for the way back.
#include "tenon/mjcf/read_mjcf.h"

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string_view>
#include <system_error>

#include "tenon/engines/mujoco/error_hook.h"
#include "tenon/engines/mujoco/model.h"
#include "tenon/mjcf/actuators.h"
#include "tenon/mjcf/bodies.h"
#include "tenon/mjcf/contact_classes.h"
#include "tenon/mjcf/equalities.h"
#include "tenon/mjcf/excluded_pairs.h"
#include "tenon/mjcf/keep_source.h"
#include "tenon/mjcf/keyframes.h"
#include "tenon/mjcf/left_out.h"
#include "tenon/mjcf/mjcf_source.h"
#include "tenon/mjcf/mujoco_scene.h"
#include "tenon/mjcf/seen/cameras.h"
#include "tenon/mjcf/sensors/sensors.h"
#include "tenon/mjcf/shapes/geoms.h"
#include "tenon/mjcf/shapes/material_table.h"
#include "tenon/mjcf/shapes/meshes.h"
#include "tenon/mjcf/tendons.h"

namespace tenon::mjcf {
namespace {

using engines::mujoco::guarded;
using engines::mujoco::ModelPtr;
using engines::mujoco::SpecPtr;

/// Where MuJoCo looked for a file that it says it cannot open, where there is none; else empty.
std::string missing_file(const std::string& words, const std::string& model) {
  constexpr std::string_view kWords = "Error opening file '";
  const std::size_t at = words.find(kWords);
  const std::size_t name = at + kWords.size();
  const std::size_t end = at == std::string::npos ? at : words.find('\'', name);
  if (end == std::string::npos) {
    return {};
  }
  const std::filesystem::path place =
      (std::filesystem::path(model).parent_path() / words.substr(name, end - name))
          .lexically_normal();
  std::error_code failed;
  return std::filesystem::exists(place, failed) || failed ? std::string() : place.string();
}

/// MuJoCo's words with the line that they name, if any.
Error fault(ErrorCode code, std::string words, const std::string& path) {
  for (char& c : words) {
    c = c == '\n' ? ' ' : c;
  }
  if (const std::string missing = missing_file(words, path); !missing.empty()) {
    return Error(ErrorCode::NotFound, "the model names a file that is not there: " + missing)
        .in_file(path)
        .with_rule("mjcf.missing-file")
        .with_fix("put it there, or correct `file`, or `meshdir` or `assetdir` of the compiler");
  }
  const std::size_t at = words.find("line ");
  const auto line = at == std::string::npos ? 0 : std::strtoul(words.c_str() + at + 5, nullptr, 10);
  return Error(code, "MuJoCo: " + words)
      .in_file(path)
      .at(static_cast<std::uint32_t>(line), 0)
      .with_rule("mjcf.parse")
      .with_fix("correct the model; MuJoCo itself refuses it");
}

/// MuJoCo says this of good numbers where another call set errno while it read them. Read once
/// more, they are good.
bool by_chance(std::string_view words) {
  return words.find("unknown error in attribute") != std::string_view::npos;
}

Result<SpecPtr> parse(const std::string& path) {
  constexpr int kMostReadings = 4;
  char words[1000] = "";
  mjSpec* spec = nullptr;
  TENON_CHECK(engines::mujoco::open_mujoco());
  const auto parse_xml = reinterpret_cast<decltype(&::mj_parseXML)>(
      engines::mujoco::find_mujoco_function("mj_parseXML"));
  if (parse_xml == nullptr) {
    return fault(ErrorCode::Missing, "it has no mj_parseXML", path);
  }
  for (int i = 0; i < kMostReadings && spec == nullptr && (i == 0 || by_chance(words)); ++i) {
    TENON_CHECK(guarded([&] { spec = parse_xml(path.c_str(), nullptr, words, sizeof(words)); }));
  }
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
  const WithoutArena small(spec);
  TENON_CHECK(guarded([&] { model = mj_compile(&spec, nullptr); }));
  if (model == nullptr) {
    return fault(ErrorCode::Invalid, mjs_getError(&spec), path);
  }
  return ModelPtr(model);
}

void attach_shapes(std::vector<BodyShapes> shapes, BodyTree& tree) {
  for (std::size_t body = 0; body < shapes.size(); ++body) {
    robot::Link& link = tree.links[tree.link_of_body[body]];
    link.visuals = std::move(shapes[body].visuals);
    link.colliders = std::move(shapes[body].colliders);
  }
}

/// From a compiled model to a robot: each function reads one table, with its part of the robot and
/// its findings.
robot::RobotModel read_model(MjcfSource& source) {
  robot::RobotModel robot;
  robot.meshes = read_meshes(source);
  MaterialTable materials(source);
  BodyTree tree = read_bodies(source);
  ContactClasses contacts = find_contact_classes(source);
  attach_shapes(read_geoms(source, robot.meshes, contacts, materials), tree);
  robot.contact_classes = std::move(contacts.classes);
  robot.materials = materials.take();
  robot.excluded_pairs = read_excluded_pairs(source.model(), tree);
  Tendons tendons = read_tendons(source, tree);
  Actuators actuators = read_actuators(source, tree, tendons);
  Equalities equalities = read_equalities(source, tree);
  attach_drives(actuators, tree.joints);
  attach_mimics(equalities, tree.joints);
  robot.mujoco.sensors = read_sensors(source, tree);
  read_cameras_and_lights(source, tree);
  robot.mujoco.keyframes = read_keyframes(source, actuators, tree.joints);
  robot.mujoco.scene = read_scene(source);
  report_left_out(source);
  robot.links = std::move(tree.links);
  robot.joints = std::move(tree.joints);
  robot.loops = std::move(equalities.loops);
  robot.mujoco.tendons = std::move(tendons.tendons);
  robot.mujoco.actuators = std::move(actuators.motors);
  return robot;
}

}  // namespace

Result<robot::RobotModel> read_mjcf(const std::string& path, Diagnostics& diagnostics) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    return Error(ErrorCode::NotFound, "there is no such file").in_file(path);
  }
  TENON_TRY(const SpecPtr spec, parse(path));
  const Simplified simplified{spec->compiler.fusestatic != 0, spec->compiler.discardvisual != 0};
  TENON_TRY(const ModelPtr model, compile(*spec, path));
  std::string name = mjs_getString(spec->modelname);
  if (name.empty() || name == "MuJoCo Model") {
    name = std::filesystem::path(path).stem().string();
  }
  MjcfSource source(*spec, *model, path, diagnostics);
  robot::RobotModel robot = read_model(source);
  robot.mujoco.source = keep_source(source, *spec, simplified);
  robot.name = std::move(name);
  robot.file = path;
  return robot;
}

}  // namespace tenon::mjcf
