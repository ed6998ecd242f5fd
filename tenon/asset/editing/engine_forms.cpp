// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// An actuator acts with force = gain ctrl + b0 + b1 l + b2 l', l = gear q, in newtons, newton
// metres and radians. A drive of stiffness kp and damping kd per degree is b1 = -kp (180 / pi) /
// gear^2 and b2 = -kd (180 / pi) / gear^2; the gain and b0 grow as b1 does, so that controls and
// the position of rest keep their meaning. PhysX's mimics have the signs of Newton's turned round,
// MuJoCo's own numbers are radians. New edits belong to the wish of those that they follow from.
#include "tenon/asset/editing/engine_forms.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "tenon/answers/prim_walk.h"
#include "tenon/base/text/text_number.h"
#include "tenon/layer/array.h"
#include "tenon/layer/field_values.h"
#include "tenon/math/angle.h"
#include "tenon/stage/sources/opinion_sources.h"
#include "tenon/structure/layout.h"

namespace tenon {
namespace {

using Edits = std::vector<AssetEdit>;
using Views = std::vector<AssetEditor::View>;

/// What edits say of the drive of a joint.
struct AskedDrive {
  bool angular = true;
  std::optional<double> stiffness;  ///< as the layers have them, per degree
  std::optional<double> damping;
  std::optional<double> max_force;
  std::size_t edit = 0;  ///< the last of them
};

class EngineForms {
 public:
  EngineForms(Edits edits, const Views& views) : edits_(std::move(edits)), views_(views) {}

  Edits run() {
    const std::size_t count = edits_.size();
    for (std::size_t i = 0; i < count; ++i) {
      const AssetEdit edit = edits_[i];
      if (edit.kind != AssetEdit::Kind::SetProperty) {
        continue;
      }
      add_file_forms(i, edit);
      add_mimic_forms(i, edit);
      note_drive(i, edit);
    }
    for (const auto& [joint, wish] : drives_) {
      add_actuator_forms(joint, wish);
    }
    // Before the edits for all engines: these are proved when their value counts everywhere.
    file_forms_.insert(file_forms_.end(), edits_.begin(), edits_.end());
    return std::move(file_forms_);
  }

 private:
  void add(std::size_t from, Path prim, const std::string& property, std::string value,
           const std::string& engine = {}) {
    AssetEdit edit;
    edit.object = prim.property(Token(property));
    edit.value = std::move(value);
    edit.engine = engine;
    if (!edits_[from].wish) {
      edits_[from].wish = kOwnWishes + from;
    }
    edit.wish = edits_[from].wish;
    if (added_.insert(engine + ":" + edit.object.str()).second) {
      (engine.empty() ? edits_ : file_forms_).push_back(std::move(edit));
    }
  }

  /// The engine whose file has the strongest opinion on the property, under its variant.
  static std::string engine_with_opinion(const AssetEditor::View& view, Path prim, Token property) {
    if (view.variant.empty()) {
      return {};
    }
    const auto sources = stage::opinion_sources(*view.stage, prim, property);
    if (sources.empty()) {
      return {};
    }
    const auto roles =
        structure::roles_of_files(view.stage->root_layer(), view.stage->used_layers());
    const auto role = roles.find(sources.front().layer->identifier());
    return role != roles.end() && structure::is_engine(role->second) ? view.variant : std::string();
  }

  void add_file_forms(std::size_t i, const AssetEdit& edit) {
    for (const AssetEditor::View& view : views_) {
      const std::string engine = engine_with_opinion(view, edit.object.prim(), edit.object.name());
      if (!engine.empty()) {
        add(i, edit.object.prim(), edit.object.name().str(), edit.value, engine);
      }
    }
  }

  void add_mimic_forms(std::size_t i, const AssetEdit& edit) {
    const Path joint = edit.object.prim();
    const std::string name = edit.object.name().str();
    const std::optional<double> number = parse_double(edit.value);
    for (const AssetEditor::View& view : views_) {
      const stage::Prim prim = view.stage->prim(joint);
      if (!prim) {
        continue;
      }
      for (const Token& instance : prim.api_instances("PhysxMimicJointAPI")) {
        const std::string head = "physxMimicJoint:" + instance.str() + ":";
        if (name == "newton:mimicJoint") {
          add(i, joint, head + "referenceJoint", edit.value);
        } else if (number && name == "newton:mimicCoef1") {
          add(i, joint, head + "gearing", number_text(-*number));
        } else if (number && name == "newton:mimicCoef0") {
          add(i, joint, head + "offset", number_text(-*number));
        }
      }
      if (prim.has_api("MjcEqualityJointAPI") && has_targets(prim, "mjc:target")) {
        const double unit = prim.is_a("PhysicsRevoluteJoint") ? kRadians : 1;
        if (name == "newton:mimicJoint") {
          add(i, joint, "mjc:target", edit.value);
        } else if (number && name == "newton:mimicCoef1") {
          add(i, joint, "mjc:coef1", number_text(*number));
        } else if (number && name == "newton:mimicCoef0") {
          add(i, joint, "mjc:coef0", shortest(*number * unit));
        }
      }
    }
  }

  static std::string number_text(double value) { return shortest(static_cast<float>(value + 0.0)); }

  static bool has_targets(const stage::Prim& prim, const char* name) {
    return !prim.relationship(name).targets().empty();
  }

  void note_drive(std::size_t i, const AssetEdit& edit) {
    const std::string name = edit.object.name().str();
    const bool angular = name.starts_with("drive:angular:physics:");
    const std::optional<double> number = parse_double(edit.value);
    if ((!angular && !name.starts_with("drive:linear:physics:")) || !number) {
      return;
    }
    const std::string key = name.substr(name.rfind(':') + 1);
    std::optional<double> AskedDrive::* const member = key == "stiffness"  ? &AskedDrive::stiffness
                                                       : key == "damping"  ? &AskedDrive::damping
                                                       : key == "maxForce" ? &AskedDrive::max_force
                                                                           : nullptr;
    if (member != nullptr) {
      AskedDrive& wish = drives_[edit.object.prim()];
      wish.*member = number;
      wish.angular = angular;
      wish.edit = i;
    }
  }

  void add_actuator_forms(Path joint, const AskedDrive& wish) {
    for (const AssetEditor::View& view : views_) {
      answers::walk_prims(view.stage->pseudo_root(), [&](const stage::Prim& prim) {
        if (prim.type_name() == "MjcActuator" &&
            prim.relationship("mjc:target").targets() == std::vector<Path>{joint}) {
          add_actuator_form(prim, wish);
        }
      });
    }
  }

  static std::vector<double> numbers(const stage::Prim& prim, const char* name) {
    const layer::Value value = prim.attribute(name).get();
    const auto* found = value.get<layer::Array<double>>();
    return found == nullptr ? std::vector<double>()
                            : std::vector<double>(found->begin(), found->end());
  }

  static std::string list_text(const std::vector<double>& list) {
    std::string text;
    for (const double number : list) {
      text += (text.empty() ? "[" : ", ") + shortest(number + 0.0);
    }
    return text + "]";
  }

  void add_actuator_form(const stage::Prim& actuator, const AskedDrive& wish) {
    std::vector<double> bias = numbers(actuator, "mjc:biasPrm");
    std::vector<double> gain = numbers(actuator, "mjc:gainPrm");
    const std::vector<double> gears = numbers(actuator, "mjc:gear");
    const double gear = gears.empty() || gears[0] == 0 ? 1 : gears[0];
    const double unit = (wish.angular ? kDegreesPerRadian : 1) / (gear * gear);
    bias.resize(std::max<std::size_t>(bias.size(), 3));
    gain.resize(std::max<std::size_t>(gain.size(), 1));
    const std::size_t leading = bias[1] == 0 && !wish.stiffness ? 2 : 1;
    const double before = bias[leading];
    if (wish.stiffness) {
      bias[1] = -*wish.stiffness * unit;
    }
    if (wish.damping) {
      bias[2] = -*wish.damping * unit;
    }
    if (wish.stiffness || (wish.damping && leading == 2)) {
      const double grown = before == 0 ? 0 : bias[leading] / before;
      gain[0] = before == 0 ? -bias[leading] : gain[0] * grown;
      bias[0] *= grown;
      add(wish.edit, actuator.path(), "mjc:gainPrm", list_text(gain));
    }
    if (wish.stiffness || wish.damping) {
      add(wish.edit, actuator.path(), "mjc:biasPrm", list_text(bias));
    }
    if (wish.max_force) {
      const double force = *wish.max_force / std::fabs(gear);
      add(wish.edit, actuator.path(), "mjc:forceRange:max", shortest(force));
      add(wish.edit, actuator.path(), "mjc:forceRange:min", shortest(-force));
    }
  }

  /// Above all numbers of wishes that edits come with.
  static constexpr std::size_t kOwnWishes = std::size_t{1} << 32u;

  Edits edits_;
  Edits file_forms_;
  const Views& views_;
  std::map<Path, AskedDrive> drives_;
  std::set<std::string> added_;
};

}  // namespace

Result<std::vector<AssetEdit>> with_engine_forms(const std::string& asset, Edits edits,
                                                 const EditOptions& options) {
  if (!options.engine.empty() || !options.layer.empty()) {
    return Error(ErrorCode::Invalid, "all engines and one file or engine are two things")
        .with_rule("usage.conflict")
        .with_fix("give either --all-engines, or --engine and --in");
  }
  Diagnostics ignored;  // the edit composes again and reports
  TENON_TRY(AssetEditor editor, AssetEditor::open(asset, options, ignored));
  TENON_TRY(const Views views, editor.views());
  return EngineForms(std::move(edits), views).run();
}

}  // namespace tenon
