// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Which forms an asset has is seen on its stages: as it opens, and under the variants of engines.
#include "tenon/asset/drives/limit_edits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "tenon/asset/edit_request.h"
#include "tenon/base/text/text_number.h"
#include "tenon/physics/units.h"
#include "tenon/scene/joint_dofs.h"
#include "tenon/structure/layout.h"

namespace tenon {
namespace {

struct NamedStage {
  std::string variant;  // empty: as it opens
  stage::Stage stage;
};

Result<std::vector<NamedStage>> stages_of(const std::string& path, const OpenOptions& open) {
  Diagnostics ignored;  // the drives were read before
  std::vector<NamedStage> stages;
  TENON_TRY(stage::Stage first, tenon::open(path, open, ignored));
  const stage::Prim root = first.default_prim();
  const std::vector<std::string> variants =
      root ? root.variant_names(std::string(structure::kPhysicsSet)) : std::vector<std::string>();
  stages.push_back({"", std::move(first)});
  for (const char* engine : {"physx", "mujoco", "newton"}) {
    if (open.physics_variant.empty() &&
        std::find(variants.begin(), variants.end(), engine) != variants.end()) {
      OpenOptions chosen = open;
      chosen.physics_variant = engine;
      TENON_TRY(stage::Stage stage, tenon::open(path, chosen, ignored));
      stages.push_back({engine, std::move(stage)});
    }
  }
  return stages;
}

AssetEdit set_number(const Path& prim, const std::string& property, double value,
                     const std::string& engine) {
  AssetEdit edit;
  edit.kind = AssetEdit::Kind::SetProperty;
  edit.object = prim.property(Token(property));
  edit.value = shortest(static_cast<float>(value));
  edit.engine = engine;
  return edit;
}

AssetEdit apply_api(const Path& prim, const char* api, const std::string& engine) {
  AssetEdit edit;
  edit.kind = AssetEdit::Kind::ApplyApi;
  edit.object = prim;
  edit.api = Token(api);
  edit.engine = engine;
  return edit;
}

std::optional<float> number_of(const stage::Prim& prim, const std::string& property) {
  return prim.attribute(Token(property)).get_as<float>();
}

/// The forms of a speed limit that a joint has on one stage.
std::vector<std::string> speed_properties(const stage::Prim& joint, bool turns) {
  std::vector<std::string> found;
  if (joint.attribute(Token("newton:velocityLimit")).is_authored()) {
    found.emplace_back("newton:velocityLimit");
  }
  if (joint.has_api(Token("PhysxJointAPI"))) {
    found.emplace_back("physxJoint:maxJointVelocity");
  }
  const std::string instance = turns ? "angular" : "linear";
  if (joint.has_api(Token("PhysxJointAxisAPI:" + instance))) {
    found.emplace_back("physxJointAxis:" + instance + ":maxJointVelocity");
  }
  return found;
}

void add_speed(const std::vector<NamedStage>& stages, const DriveDemand& drive, double value,
               std::vector<AssetEdit>& edits) {
  std::vector<std::string> set;
  bool with_physx = false;
  for (const NamedStage& named : stages) {
    with_physx = with_physx || named.variant == "physx";
    const stage::Prim prim = named.stage.prim(drive.joint);
    for (const std::string& property :
         prim ? speed_properties(prim, is_angular(drive.dof)) : std::vector<std::string>()) {
      if (std::find(set.begin(), set.end(), property) == set.end()) {
        set.push_back(property);
        if (number_of(prim, property) != static_cast<float>(value)) {
          edits.push_back(set_number(drive.joint, property, value, named.variant));
        }
      }
    }
  }
  if (!set.empty()) {
    return;
  }
  edits.push_back(apply_api(drive.joint, "NewtonJointAPI", ""));
  edits.push_back(set_number(drive.joint, "newton:velocityLimit", value, ""));
  if (with_physx) {
    edits.push_back(apply_api(drive.joint, "PhysxJointAPI", "physx"));
    edits.push_back(set_number(drive.joint, "physxJoint:maxJointVelocity", value, "physx"));
  }
}

/// False where the joint has no mimic of PhysX.
bool add_compliance(const stage::Prim& joint, const std::array<double, 2>& numbers,
                    const std::string& variant, std::vector<AssetEdit>& edits) {
  const std::vector<Token> instances = joint.api_instances(Token("PhysxMimicJointAPI"));
  for (const Token& instance : instances) {
    const std::string prefix = "physxMimicJoint:" + instance.str() + ":";
    // Either of the two at 0 makes a mimic rigid, so that one alone may change nothing.
    const std::size_t wish = edits.size();
    edits.push_back(set_number(joint.path(), prefix + "naturalFrequency", numbers[0], variant));
    edits.push_back(set_number(joint.path(), prefix + "dampingRatio", numbers[1], variant));
    edits[wish].wish = wish;
    edits[wish + 1].wish = wish;
  }
  return !instances.empty();
}

}  // namespace

Result<std::vector<AssetEdit>> limit_edits(const std::string& path, const OpenOptions& open,
                                           const DrivesOfAsset& found) {
  EditRequest request;
  request.all_engines = true;
  TENON_TRY(const std::vector<NamedStage> stages, stages_of(path, open));
  Diagnostics ignored;  // the drives were read before
  const physics::Units units = physics::read_units(stages.front().stage, ignored);
  std::vector<AssetEdit> speeds;
  for (const DriveDemand& drive : found.drives) {
    const bool turns = is_angular(drive.dof);
    if (drive.new_effort) {
      const double authored = *drive.new_effort / (turns ? units.torque() : units.force());
      const stage::Prim prim = stages.front().stage.prim(drive.joint);
      const bool one_axis = prim && (prim.type_name() == "PhysicsRevoluteJoint" ||
                                     prim.type_name() == "PhysicsPrismaticJoint");
      request.drive.push_back(drive.joint.str() +
                              (one_axis ? "" : ":" + std::string(dof_name(drive.dof))) +
                              "=maxForce:" + shortest(static_cast<float>(authored)));
    }
    if (drive.new_speed) {
      add_speed(stages, drive, *drive.new_speed / (turns ? kRadians : units.length), speeds);
    }
  }
  std::vector<AssetEdit> edits;
  if (!request.drive.empty()) {
    EditOptions options;
    options.open = open;
    TENON_TRY(edits, read_edits(path, request, options));
  }
  edits.insert(edits.end(), speeds.begin(), speeds.end());
  // A number that is as it is asked for, or that another form of it wins over, is no mistake here.
  for (AssetEdit& edit : edits) {
    edit.may_rest = true;
  }
  return edits;
}

Result<std::vector<AssetEdit>> compliance_edits(const std::string& path, const OpenOptions& open,
                                                const DrivesOfAsset& found,
                                                const std::string& text) {
  std::array<double, 2> numbers{};
  if (text != "rigid") {
    const std::size_t comma = text.find(',');
    const auto frequency = parse_double(text.substr(0, comma));
    const auto ratio =
        comma == std::string::npos ? std::nullopt : parse_double(text.substr(comma + 1));
    if (!frequency || !ratio || !(*frequency > 0) || !(*ratio >= 0) || !std::isfinite(*frequency) ||
        !std::isfinite(*ratio)) {
      return Error(ErrorCode::Invalid, "\"" + text + "\" is no compliance of mimics")
          .with_rule("drives.mimic")
          .with_fix("write rigid, or a natural frequency above 0 and a damping ratio: 25,0.1");
    }
    numbers = {*frequency, *ratio};
  }
  TENON_TRY(const std::vector<NamedStage> stages, stages_of(path, open));
  std::vector<AssetEdit> edits;
  std::vector<Path> done;
  for (const NamedStage& named : stages) {
    for (const scene::Joint& joint : found.scene->joints) {
      const stage::Prim prim = named.stage.prim(joint.path);
      if (prim && std::find(done.begin(), done.end(), joint.path) == done.end() &&
          add_compliance(prim, numbers, named.variant, edits)) {
        done.push_back(joint.path);
      }
    }
  }
  if (edits.empty()) {
    return Error(ErrorCode::NotFound, "no joint has PhysxMimicJointAPI, whose compliance it is")
        .with_rule("drives.no-mimic")
        .with_fix("mimics of other schemas are rigid already");
  }
  return edits;
}

}  // namespace tenon
