// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/mutants/verbs.h"

#include <iterator>
#include <sstream>
#include <utility>

namespace tenon::fuzz {
namespace {

/// {in} the asset, {out} the output, {prim} a prim of it. Verbs that have no row are about no asset
/// (new, help, doctor and the like), start a browser (record) or are Python (sweep, excite,
/// identify).
struct Row {
  const char* words;
  Leaves leaves = Leaves::Text;
  const char* output = "";
  bool edits = false;
  const char* before = "";  ///< a command that is run first
};

constexpr Row kForLayers[] = {
    {"info {in}"},
    {"info {in} --json"},
    {"cat {in}"},
    {"cat {in} --flatten"},
    {"cat {in} --flatten-layer-stack"},
    {"cat {in} -o {out}", Leaves::Layer, "out.usda"},
    {"cat {in} -o {out}", Leaves::Layer, "out.usdc"},
    {"cat {in} --flatten -o {out}", Leaves::Layer, "out.usdc"},
    {"cat {in} --flatten-layer-stack -o {out}", Leaves::Layer, "out.usda"},
    {"tree {in} -a -m"},
    {"tree {in} --mask {prim}"},
    {"check {in}", Leaves::Nothing},
    {"check {in} --json"},
    {"check {in} --sarif {out}", Leaves::Log, "out.sarif"},
    {"physics {in}", Leaves::Nothing},
    {"physics {in} --json"},
    {"physics {in} --mass", Leaves::Nothing},
    {"dump {in} --xforms"},
    {"dump {in} --stacks --builtins"},
    {"dump {in} -o {out}", Leaves::File, "out.json"},
    {"dump-index {in}", Leaves::Nothing},
    {"explain {in} {prim}"},
    {"where {in} {prim}", Leaves::Nothing},
    {"variant {in}", Leaves::Nothing},
    {"test-runner layer {in}"},
    {"diff {in} /dev/null", Leaves::Nothing},
    {"diff /dev/null {in} --composed", Leaves::Nothing},
    {"structure {in} -o {out}", Leaves::Folder, "out"},
    {"zip {in} -o {out}", Leaves::Layer, "out.usdz"},
    {"bake {in} -o {out} --duration 0.05 --dt 0.01", Leaves::Layer, "out.usda"},
    {"sim {in} --duration 0.05 --dt 0.01"},
    {"sim {in} --duration 0.05 --dt 0.01 -o {out} --json", Leaves::File, "out.jsonl"},
    {"convert {in} {out}", Leaves::File, "out.urdf"},
    {"convert {in} {out}", Leaves::File, "out.xml"},
    {"convert {in} {out}", Leaves::File, "out.sdf"},
    {"convert {in} {out}", Leaves::File, "out.srdf"},
    {"convert {in} {out} --format isaaclab", Leaves::File, "out.py"},
    {"cat {in} -o {out}", Leaves::Layer, "out.usdz"},
    {"bake {in} -o {out} --duration 0.02", Leaves::File, "out.glb"},
    {"sim {in} --duration 0.02 --engine physx"},
    {"sim {in} --duration 0.02 --engine jolt --log contacts,energy -o {out}", Leaves::File,
     "out.npz"},
    {"compare {in} --duration 0.02 --engines mujoco,physx,jolt -o {out}", Leaves::File, "out.json"},
    {"benchmark {in} --tests mimic_joint,drive_gain_validation --json"},
    {"bench {in} --duration 0.01 --envs 2 --threads 1"},
    {"report {in} --duration 0.02 -o {out}", Leaves::File, "out.html"},
    {"pairs {in} --sample 5 --json"},
    {"pairs {in} --sample 5 --srdf {out}", Leaves::File, "out.srdf"},
    {"pose {in} --json"},
    {"pose {in} --ik {prim}=0,0,0.1 --starts 3", Leaves::Nothing},
    {"inertia {in} --matrix --json"},
    {"drives {in} --json"},
    {"tune {in} -o {out}", Leaves::File, "out.json"},
    {"colliders {in} --json"},
    {"view {in} --for 0", Leaves::Nothing},
};
/// What packages do not have: files that can be edited.
constexpr Row kForEdits[] = {
    {"check {in} --fix", Leaves::Nothing, "", true},
    {"strip {in} -o {out}", Leaves::Layer, "out.usda"},
    {"set {in} {prim}.physics:mass=2 --type float", Leaves::Nothing, "", true},
    {"set {in} --apply {prim}=PhysicsRigidBodyAPI", Leaves::Nothing, "", true},
    {"rename {in} {prim} zz", Leaves::Nothing, "", true},
    {"remove {in} {prim}", Leaves::Nothing, "", true},
    {"add {in} {prim}/zz=sphere,collider", Leaves::Nothing, "", true},
    {"drives {in} --stiffness 10 --damping 1", Leaves::Nothing, "", true},
    {"tune {in} --frequency 9 --damping-ratio 1 --save", Leaves::Nothing, "", true},
    {"colliders {in} --budget 64 --gap 1 --save", Leaves::Nothing, "", true},
    {"pairs {in} --sample 5 --filter default", Leaves::Nothing, "", true},
    {"pose {in} --save open", Leaves::Nothing, "", true},
    {"strip {in} --in-place", Leaves::Nothing, "", true},
    {"undo {in}", Leaves::Nothing, "", true, "set {in} {prim}.zz=1 --type int"},
};
constexpr Row kForTextures[] = {
    {"bake {in} -o {out} --duration 0.01", Leaves::File, "out.glb"},
    {"report {in} --duration 0.01 -o {out}", Leaves::File, "out.html"},
    {"check {in} --profile simready", Leaves::Nothing},
    {"zip {in} -o {out}", Leaves::Layer, "out.usdz"},
};
constexpr Row kForPackages[] = {
    {"zip {in} --list", Leaves::Nothing},
    {"zip {in} --extract {out}", Leaves::Nothing, "out"},  // a package may be empty
    {"zip {in} --list --json"},
};
constexpr Row kForMotion[] = {
    {"dump {in} --xforms"},
    {"dump {in}"},
    {"cat {in} --flatten -o {out}", Leaves::Layer, "out.usdc"},
    {"test-runner value {in} {prim}.s 0 1 5 14 1e300 default"},
    {"test-runner value {in} {prim}.t 0 1 5 14 1e300 default"},
};
constexpr Row kForArcs[] = {
    {"variant {in} v=a --prim {prim} -o {out}", Leaves::Layer, "out.usda"},
    {"dump-index {in} {prim}", Leaves::Nothing},
    {"cat {in} --flatten --mask {prim}"},
};
constexpr Row kForRobots[] = {
    {"convert {in} {out}", Leaves::Folder, "out"},
    {"convert {in} {out}", Leaves::Folder, "out"},
    {"convert {in} {out}", Leaves::Layer, "out.usda"},
    {"convert {in} {out}", Leaves::Layer, "out.usdc"},
    {"convert {in} {out} --merge-fixed --flat", Leaves::Folder, "out"},
    {"convert {in} {out} --scene", Leaves::Folder, "out"},
};

std::string replaced(const std::string& word, const Mutant& mutant, const std::string& output) {
  std::string text = word;
  const std::pair<std::string_view, const std::string&> values[] = {
      {"{in}", mutant.asset}, {"{out}", output}, {"{prim}", mutant.prim}};
  for (const auto& [name, value] : values) {
    const std::size_t at = text.find(name);
    if (at != std::string::npos) {
      text.replace(at, name.size(), value);
    }
  }
  return text;
}

std::vector<std::string> words_of(const std::string& row, const Mutant& mutant,
                                  const std::string& output) {
  std::vector<std::string> found;
  std::istringstream words(row);
  for (std::string word; words >> word;) {
    found.push_back(replaced(word, mutant, output));
  }
  return found;
}

Command command_of(const Row& row, const Mutant& mutant) {
  Command command;
  command.row = row.words;
  if (*row.output != '\0') {
    command.row += std::string(" (") + row.output + ")";
  }
  command.output = row.output;
  command.leaves = row.leaves;
  command.edits = row.edits;
  command.words = words_of(row.words, mutant, command.output);
  command.before = words_of(row.before, mutant, command.output);
  return command;
}

template <std::size_t count>
const Row& one_of(const Row (&rows)[count], Dice& dice) {
  return rows[dice.below(count)];
}

}  // namespace

Command command_for(const Mutant& mutant, Dice& dice) {
  const auto is = [&](const char* suffix) { return mutant.asset.ends_with(suffix); };
  if (!mutant.words.empty()) {
    const bool writes = mutant.words.find("{out}") != std::string::npos;
    return command_of({mutant.words.c_str(), writes ? Leaves::Layer : Leaves::Nothing,
                       writes ? "out.usda" : "", mutant.edits, mutant.before.c_str()},
                      mutant);
  }
  if (mutant.format == "textures") {
    return command_of(one_of(kForTextures, dice), mutant);
  }
  if (is(".urdf") || is(".xml") || is(".sdf")) {
    return command_of(one_of(kForRobots, dice), mutant);
  }
  if (is(".usdz")) {
    return command_of(dice.one_in(3) ? one_of(kForPackages, dice) : one_of(kForLayers, dice),
                      mutant);
  }
  if (mutant.format == "splines and clips" && dice.one_in(2)) {
    return command_of(one_of(kForMotion, dice), mutant);
  }
  if (mutant.format == "graphs of arcs" && dice.one_in(4)) {
    return command_of(one_of(kForArcs, dice), mutant);
  }
  return command_of(dice.one_in(8) ? one_of(kForEdits, dice) : one_of(kForLayers, dice), mutant);
}

}  // namespace tenon::fuzz
