// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tenon/engines/engines.h"
#include "tenon/physics/read_physics.h"
#include "tenon/physics/vendors/vendor_attributes.h"
#include "tenon/scene/fields/same_fields.h"
#include "tenon/schema/registry.h"
#include "tenon/stage/test_stage.h"

/// No setting of a vendor's schema is ignored silently: each property that the schema table knows
/// is authored in turn, in a scene where it could matter, and is found to act on an engine's run,
/// named as not read or not mapped, or harmless.
namespace tenon::engines {
namespace {

using physics::VendorUse;

constexpr int kSteps = 100;

/// Where a property is authored in the text of a SettingScene.
constexpr const char* kPropertyMark = "# property";

/// A scene in which the properties of a schema can matter. A property is authored at the mark,
/// without the line that authors it already, if there is one.
struct SettingScene {
  std::string schema;
  std::string instance;  ///< of schemas that are applied several times
  std::string text;      ///< without its first line
};

/// Those of tests/physics/vendor_settings; a file is named SCHEMA-INSTANCE-NUMBER.usda.
std::vector<SettingScene> setting_scenes() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(TENON_SOURCE_DIR) +
                                                               "/tests/physics/vendor_settings")) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<SettingScene> scenes;
  for (const std::filesystem::path& file : files) {
    std::ifstream stream(file);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    const std::string name = file.stem().string();
    const std::size_t first = name.find('-');
    const std::size_t last = name.rfind('-');
    scenes.push_back({name.substr(0, first), name.substr(first + 1, last - first - 1),
                      text.substr(text.find('\n') + 1)});
  }
  return scenes;
}

struct Reading {
  scene::PhysicsScene scene;
  std::set<std::string> named;  ///< properties that are listed as not read
};

/// A decomposition that shows what it was asked for, in no time.
std::vector<scene::TriangleMesh> one_piece(const scene::TriangleMesh& mesh,
                                           const scene::Decomposition& how) {
  scene::TriangleMesh piece = mesh;
  for (Vec3d& point : piece.points) {
    point = point * (1 + how.concavity + 0.001 * how.most + 0.001 * how.vertices);
  }
  return {piece};
}

Reading read(const std::string& text) {
  const stage::Stage stage = stage::open_text(text);
  physics::ReadOptions options;
  options.mesh_tools.emplace().decompose = [](const scene::TriangleMesh& mesh,
                                              const scene::Decomposition& how) {
    return std::optional(one_piece(mesh, how));
  };
  Diagnostics findings;
  Reading result{physics::read_physics(stage, options, findings), {}};
  for (const scene::NotRead& part : result.scene.not_read) {
    result.named.insert(part.property);
  }
  result.scene.not_read.clear();
  return result;
}

/// What a run shows: numbers of bodies, and what was told.
struct Trace {
  std::vector<double> numbers;
  std::set<std::string> named;  ///< properties that the engine lists as not mapped
};

Trace trace(const Engine& engine, const scene::PhysicsScene& scene) {
  Diagnostics findings;
  Trace result;
  std::vector<double>& numbers = result.numbers;
  auto made = engine.make(scene, {}, findings);
  if (!made.has_value()) {
    return {{-1}, {}};
  }
  Simulation& sim = **made;
  for (const NotMapped& part : sim.not_mapped()) {
    result.named.insert(part.property);
  }
  for (int i = 0; i < kSteps && sim.step().has_value(); ++i) {
  }
  for (scene::Index b = 0; b < scene.bodies.size(); ++b) {
    const BodyState state = sim.body_state(b);
    numbers.insert(numbers.end(), state.pose.position.v.begin(), state.pose.position.v.end());
    numbers.insert(numbers.end(), state.linear_velocity.v.begin(), state.linear_velocity.v.end());
    numbers.insert(numbers.end(), state.angular_velocity.v.begin(), state.angular_velocity.v.end());
  }
  numbers.push_back(static_cast<double>(sim.events().size()));
  numbers.push_back(sim.time());
  return result;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

/// Lines of `text` without the one that authors `name` on the prim of the mark; that line, or
/// nothing.
std::pair<std::string, std::string> without(const std::string& text, const std::string& name) {
  std::pair<std::string, std::string> result;
  const std::size_t marker = text.find(kPropertyMark);
  const std::size_t first = text.rfind('{', marker);
  const std::size_t last = text.find('}', marker);
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1);
    const std::string line = text.substr(at, end - at + 1);
    const bool own = line.find(" " + name + " =") != std::string::npos && at > first && at < last;
    (own ? result.second : result.first) += line;
    at = end + 1;
  }
  return result;
}

/// Values of a type of which one gives most properties a meaning.
const std::vector<std::string>& values_of(const std::string& type) {
  static const std::vector<std::string> whole{"4", "1", "200", "0"};
  static const std::vector<std::string> three{"(0.3, 0.4, 0.5)"};
  static const std::vector<std::string> real{"0.3", "3", "40", "-1", "0.001"};
  static const std::vector<std::string> list{"[0.3]", "[0.3, 0.4]", "[0.8, 0.9, 0.01, 0.4, 2]",
                                             "[0.1, 0.3, 0.4, 0.5, 0.6, 0.7]"};
  static const std::map<std::string, std::vector<std::string>> values{
      {"bool", {"0", "1"}},     {"int", whole},
      {"uint", whole},          {"uchar", whole},
      {"uint64", whole},        {"vector3f", three},
      {"point3f", three},       {"float3[]", {"[(0.3, 0.4, 0.5)]"}},
      {"float3", three},        {"double3", three},
      {"float", real},          {"double", real},
      {"float[]", list},        {"double[]", list},
      {"int[]", {"[1]"}},       {"uint[]", {"[1]"}},
      {"string", {"\"word\""}}, {"token[]", {"[\"word\"]"}}};
  static const std::vector<std::string> none;
  const auto found = values.find(type);
  return found == values.end() ? none : found->second;
}

/// Lines that could give the property a meaning.
std::vector<std::string> candidates(const schema::PropertyDefinition& property,
                                    const std::string& name) {
  if (property.is_relationship) {
    return {"rel " + name + " = </B>"};
  }
  const std::string type = property.type_name.str();
  const std::string start =
      (property.variability == layer::Variability::Uniform ? "uniform " : "") + type + " " + name +
      " = ";
  std::vector<std::string> lines;
  for (const std::string& value : values_of(type)) {
    lines.push_back(start + value);
  }
  if (type == "token") {
    for (const Token token : property.allowed_tokens) {
      lines.push_back(start + "\"" + token.str() + "\"");
    }
    lines.push_back(start + "\"auto\"");
  }
  return lines;
}

/// What a property does.
struct Effect {
  bool reads = false;  ///< the description differs
  bool runs = false;   ///< the engine's run differs
  bool named = false;  ///< some of its values are listed as not read, or as not mapped
};

/// Readings and runs of texts that come again and again.
class Known {
 public:
  explicit Known(const Engine& engine) : engine_(engine) {}
  const Engine& engine() const { return engine_; }
  const Reading& reading(const std::string& text) {
    const auto [at, is_new] = readings_.try_emplace(text);
    if (is_new) {
      at->second = read(text);
    }
    return at->second;
  }
  const Trace& run(const std::string& text) {
    const auto [at, is_new] = runs_.try_emplace(text);
    if (is_new) {
      at->second = trace(engine_, reading(text).scene);
    }
    return at->second;
  }

 private:
  Engine engine_;
  std::map<std::string, Reading> readings_;
  std::map<std::string, Trace> runs_;
};

void look(const SettingScene& scene, const schema::PropertyDefinition& property,
          const std::string& name, bool run, Known& known, Effect& effect) {
  const auto [text, own] = without(scene.text, name);
  std::vector<std::string> lines = candidates(property, name);
  if (!own.empty()) {
    lines.insert(lines.begin(), own);
  }
  const std::string base = replaced(text, kPropertyMark, "");
  for (const std::string& line : lines) {
    const Reading with = read(replaced(text, kPropertyMark, line));
    effect.named = effect.named || with.named.contains(name);
    if (scene::same_fields(known.reading(base).scene, with.scene)) {
      continue;
    }
    effect.reads = true;
    if (!run) {
      return;
    }
    const Trace made = trace(known.engine(), with.scene);
    const Trace& without_it = known.run(base);
    effect.runs = effect.runs || made.numbers != without_it.numbers;
    // A whole prim that is not mapped has no property there.
    effect.named = effect.named || made.named != without_it.named || made.named.contains("");
    if (effect.runs) {
      return;
    }
  }
}

bool is_prim(const schema::Schema& schema) {
  return schema.vendor &&
         (schema.is_applied_api() || schema.kind == schema::SchemaKind::ConcreteTyped);
}

/// The property without a value on a prim of the schema by itself.
std::string alone(const schema::Schema& schema, const schema::PropertyDefinition& property,
                  const std::string& name) {
  const bool multiple = schema.kind == schema::SchemaKind::MultipleApplyApi;
  const std::string type = !schema.is_applied_api()           ? schema.name.str()
                           : schema.can_only_apply_to.empty() ? "Xform"
                                                              : schema.can_only_apply_to[0].str();
  const std::string apis = schema.is_applied_api() ? " (apiSchemas = [\"" + schema.name.str() +
                                                         (multiple ? ":rotX" : "") + "\"])"
                                                   : "";
  return "def " + type + " \"P\"" + apis + " {\n" +
         (property.is_relationship ? "rel " : property.type_name.str() + " ") + name + "\n}\n";
}

VendorUse use_of(const schema::Schema& schema, const schema::PropertyDefinition& property,
                 const std::string& name) {
  const stage::Stage stage = stage::open_text(alone(schema, property, name));
  return physics::use_of_vendor_attribute(stage::at(stage, "/P"), Token(name));
}

/// What became of all properties.
struct Tally {
  std::map<std::string, int> physx;
  std::map<std::string, int> others;
  std::set<std::string> physx_runs;  ///< "SCHEMA PROPERTY"
  std::string silent;                ///< properties that nothing becomes of
  std::string idle;                  ///< read, without a change of the run and not named
};

/// Whose properties are run on the engine: those of PhysX's schemas, or of all.
enum class Runs : std::uint8_t { Physx, All };

void count(const schema::Schema& schema, const schema::PropertyDefinition& property,
           const std::vector<SettingScene>& scenes, Runs runs, Known& known, Tally& tally) {
  const bool physx =
      schema.name.view().starts_with("Physx") || schema.name == "PhysicsJointStateAPI";
  std::map<std::string, int>& counts = physx ? tally.physx : tally.others;
  const std::string name = replaced(property.name.str(), "__INSTANCE_NAME__", "rotX");
  const VendorUse use = use_of(schema, property, name);
  if (use == VendorUse::Harmless) {
    ++counts["harmless"];
    return;
  }
  if (use == VendorUse::NotRead) {
    ++counts["named"];
    if (!read(alone(schema, property, name)).named.contains(name)) {
      tally.silent += schema.name.str() + " " + name + "\n";
    }
    return;
  }
  Effect effect;
  const bool run = physx || runs == Runs::All;
  for (const SettingScene& scene : scenes) {
    if (scene.schema == schema.name.str() && !(run ? effect.runs : effect.reads)) {
      look(scene, property, replaced(property.name.str(), "__INSTANCE_NAME__", scene.instance), run,
           known, effect);
    }
  }
  ++counts[effect.reads ? "acts" : "named"];
  if (physx && effect.runs) {
    tally.physx_runs.insert(schema.name.str() + " " + property.name.str());
  }
  if (!effect.reads && !effect.named) {
    tally.silent += schema.name.str() + " " + name + "\n";
  } else if (run && effect.reads && !effect.runs && !effect.named) {
    tally.idle += schema.name.str() + " " + name + "\n";
  }
}

inline Tally tally_of(const Engine& engine, Runs runs) {
  const std::vector<SettingScene> scenes = setting_scenes();
  Known known(engine);
  Tally tally;
  for (const schema::Schema* schema : schema::Registry::instance().schemas()) {
    for (const schema::PropertyDefinition& property : schema->properties) {
      if (is_prim(*schema)) {
        count(*schema, property, scenes, runs, known, tally);
      }
    }
  }
  return tally;
}

}  // namespace
}  // namespace tenon::engines
