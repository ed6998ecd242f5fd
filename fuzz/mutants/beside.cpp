// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Files that verbs read beside an asset: tables of commands, saved states, settings, baselines,
// gains, poses and pairs. The asset is always the same arm, for which these files are right before
// they are damaged.
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fuzz/mutants/mutant.h"
#include "fuzz/mutants/zip_parts.h"
#include "fuzz/text_mutations.h"
#include "tenon/base/content_digest.h"
#include "tenon/bytes/byte_writer.h"

namespace tenon::fuzz {
namespace {

constexpr const char* kArm = R"(#usda 1.0
(
    defaultPrim = "arm"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "arm" (
    prepend apiSchemas = ["PhysicsArticulationRootAPI"]
)
{
    def Cube "base" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI"]
    )
    {
        double size = 0.2
    }
    def Cube "tip" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI"]
    )
    {
        double size = 0.1
        double3 xformOp:translate = (0, 0, 0.5)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
    def PhysicsFixedJoint "root"
    {
        rel physics:body1 = </arm/base>
    }
    def PhysicsRevoluteJoint "turn" (
        prepend apiSchemas = ["PhysicsDriveAPI:angular"]
    )
    {
        uniform token physics:axis = "X"
        rel physics:body0 = </arm/base>
        rel physics:body1 = </arm/tip>
        point3f physics:localPos0 = (0, 0, 0.25)
        point3f physics:localPos1 = (0, 0, -0.25)
        float physics:lowerLimit = -90
        float physics:upperLimit = 90
        float drive:angular:physics:damping = 1
        float drive:angular:physics:stiffness = 10
    }
}
)";
constexpr const char* kUrdf = R"(<robot name="arm">
  <link name="base"><inertial><mass value="1"/>
    <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="tip"><inertial><mass value="1"/>
    <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="turn" type="revolute"><parent link="base"/><child link="tip"/>
    <axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
</robot>
)";
constexpr const char* kPairs =
    R"({"pairs": [{"bodyA": "/arm/base", "bodyB": "/arm/tip", "adjacent": true, "class": "never",
"colliderA": "/arm/base", "colliderB": "/arm/tip", "touching": 0, "share": 0.5}]}
)";
constexpr const char* kPoses = R"({"_meta": {"units": "radians"}, "poses": {"bent": {
"joints": {"/arm/turn": 0.5}, "joint_fixed": {"/arm/turn": false}, "valid": true,
"start_link": "/arm/base", "end_link": "/arm/tip", "target_position": [0, 0, 1],
"target_orientation": [1, 0, 0, 0]}, "open": {"joints": {"/arm/turn": 0}}}}
)";
constexpr const char* kBaseline = R"({"tool": "tenon", "schema": "tenon.baseline/1", "findings": [
{"rule": "scene.missing", "file": "arm.usda", "prim": "/arm/base", "property": ""},
{"rule": "drive.max-force-unlimited", "file": "arm.usda", "prim": "/arm/turn", "property": ""}]}
)";
constexpr const char* kSettings = R"(engine = "mujoco"
names = "current"
[check]
profile = "simready"
[check.skip]
"mass.default" = "the simulator sets all masses"
scene.missing = """more
lines"""
)";
constexpr const char* kCommands = R"(time,/arm/turn.target,/arm/turn.effort
0,10,0
0.01,-10,
2e-2,+30,-1
)";

/// One of these files, and the command that reads it.
struct Beside {
  const char* name;
  const char* text;
  Grammar grammar;
  const char* words;
  bool edits = false;
};
constexpr Beside kFiles[] = {
    {"c.csv", kCommands, Grammar::Mesh, "sim {in} --duration 0.03 --commands c.csv"},
    {"c.csv", kCommands, Grammar::Json, "sim {in} --engine jolt --duration 0.03 --commands c.csv"},
    {"tenon.toml", kSettings, Grammar::Json, "check {in}"},
    {"tenon.toml", kSettings, Grammar::Mesh, "sim {in} --duration 0.02"},
    {"b.json", kBaseline, Grammar::Json, "check {in} --baseline b.json"},
    {"p.json", kPoses, Grammar::Json, "pose {in} --import p.json", true},
    {"f.json", kPairs, Grammar::Json, "pairs {in} --sample 3 --filter f.json", true},
    {"f.srdf", "<robot name=\"arm\"><disable_collisions link1=\"base\" link2=\"tip\"/></robot>\n",
     Grammar::Xml, "pairs {in} --sample 3 --filter f.srdf", true},
    {"g.json", "{\"turn\": [10, 1], \"*\": [1e2, 0.5]}\n", Grammar::Json,
     "convert {in} {out} --gains g.json"},
};

template <class Number>
std::string npy(const std::string& type, const std::string& shape,
                const std::vector<Number>& numbers) {
  std::string head =
      "{'descr': '" + type + "', 'fortran_order': False, 'shape': (" + shape + "), }";
  head += std::string(63 - (10 + head.size()) % 64, ' ') + "\n";
  bytes::ByteWriter out;
  out.write_text(std::string_view("\x93NUMPY\1\0", 8));
  out.write(static_cast<std::uint16_t>(head.size()));
  out.write_text(head);
  for (const Number number : numbers) {
    out.write(number);
  }
  return out.take();
}

std::string archive_of_commands(Dice& dice) {
  ZipParts zip;
  zip.parts.resize(3);
  zip.parts[0].name = "time.npy";
  zip.parts[0].bytes = npy<double>("<f8", "2,", {0, 0.01});
  zip.parts[1].name = "columns.npy";
  zip.parts[1].bytes = npy<std::array<char, 16>>(
      "|S16", "1,",
      {{'/', 'a', 'r', 'm', '/', 't', 'u', 'r', 'n', '.', 't', 'a', 'r', 'g', 'e', 't'}});
  zip.parts[2].name = "values.npy";
  zip.parts[2].bytes = npy<float>("<f4", "2, 1", {10, -10});
  for (std::size_t left = dice.below(3); left > 0; --left) {
    mutate_bytes(zip.parts[dice.below(3)].bytes, dice);
  }
  std::string bytes = put_together(zip);
  for (std::size_t left = dice.below(3); left > 0; --left) {
    mutate_bytes(bytes, dice);
  }
  return bytes;
}

std::uint64_t number_at(const std::string& bytes, std::size_t at) {
  std::uint64_t number = 0;
  for (std::size_t i = 8; i > 0 && at + i <= bytes.size(); --i) {
    number = number << 8 | static_cast<unsigned char>(bytes[at + i - 1]);
  }
  return number;
}

}  // namespace

std::string damaged_state(std::string state, Dice& dice) {
  constexpr std::size_t kBeforeTexts = 14;  // the first line
  std::size_t body = kBeforeTexts;
  for (int text = 0; text < 2 && body + 8 <= state.size(); ++text) {  // engine, version
    body += 8 + number_at(state, body) % state.size();
  }
  body += 32;  // scene, time step, digest, length
  const std::size_t changes = dice.below(4);
  if (body >= state.size() || dice.one_in(5)) {
    for (std::size_t left = changes; left > 0; --left) {
      mutate_bytes(state, dice);
    }
    return state;
  }
  std::string inside = state.substr(body);
  for (std::size_t left = changes; left > 0; --left) {
    mutate_bytes(inside, dice);
  }
  bytes::ByteWriter out;
  out.write_text(std::string_view(state).substr(0, body - 16));
  out.write(content_digest(inside));
  out.write(std::uint64_t{inside.size()});
  out.write_text(inside);
  return out.take();
}

Mutant make_beside(const Seeds&, Dice& dice) {
  Mutant mutant;
  mutant.asset = "arm.usda";
  mutant.prim = "/arm";
  mutant.files.push_back({mutant.asset, kArm});
  const std::size_t which = dice.below(std::size(kFiles) + 4);
  if (which < std::size(kFiles)) {
    const Beside& beside = kFiles[which];
    std::string bytes = mutate_text(beside.text, {beside.grammar, kPoses, kLargestMutant}, dice);
    mutant.files.push_back({beside.name, std::move(bytes)});
    mutant.words = beside.words;
    mutant.edits = beside.edits;
    if (mutant.words.starts_with("convert")) {
      mutant.asset = "arm.urdf";
      mutant.files.push_back({mutant.asset, kUrdf});
    }
  } else if (which == std::size(kFiles)) {
    mutant.words = "sim {in} --duration 0.03 --commands c.npz";
    mutant.files.push_back({"c.npz", archive_of_commands(dice)});
  } else {
    const char* const engines[] = {"mujoco", "physx", "jolt"};
    const std::string engine = std::string(" --engine ") + engines[dice.below(3)];
    mutant.before = "sim {in} --duration 0.02 --state-out s.state" + engine;
    mutant.damaged = "s.state";
    mutant.damage = dice.number();
    mutant.words = (dice.one_in(4) ? "pose {in} --state-in s.state"
                                   : "sim {in} --duration 0.02 --state-in s.state") +
                   engine;
  }
  return mutant;
}

}  // namespace tenon::fuzz
