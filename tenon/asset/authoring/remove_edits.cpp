// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What adding has authored is found again by the schema tables: the schemas of the kind that the
// prim has, and of their properties those that no other schema of the prim declares. Each opinion
// is taken from the file that has it, under whichever selection it is composed, and overs that say
// nothing then go, so that a file is what it was before the adding.
#include "tenon/asset/authoring/remove_edits.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "tenon/asset/authoring/requested_kinds.h"
#include "tenon/edit/apply_list_edit.h"
#include "tenon/layer/fields.h"
#include "tenon/schema/registry.h"
#include "tenon/stage/sources/opinion_sources.h"

namespace tenon {
namespace {

namespace fields = layer::fields;
using RemovedEdits = std::vector<AssetEdit>;

constexpr std::string_view kBinding = "material:binding";

class Removal {
 public:
  Removal(const Stages& stages, const AuthoringRequest& request, const std::string& engine,
          const RequestedKinds& wanted, RemovedEdits& edits)
      : stages_(stages), request_(request), engine_(engine), wanted_(wanted), edits_(edits) {}

  Result<void> make() {
    TENON_TRY(prim_, need_in(stages_, wanted_.prim));
    if (wanted_.kinds.empty()) {
      return remove_prim();
    }
    for (const AuthoringKind* kind : wanted_.kinds) {
      kind_ = kind;
      TENON_CHECK(kind->makes_prim() ? remove_prim() : take_off());
    }
    return {};
  }

 private:
  Error has_none(const std::string& what) const {
    return Error(ErrorCode::NotFound, "<" + wanted_.prim.str() + "> has no " + what)
        .with_prim(wanted_.prim.str())
        .with_rule("edit.has-none")
        .with_fix("tenon explain ASSET " + wanted_.prim.str() + " lists its contents");
  }

  AssetEdit edit_of(AssetEdit::Kind kind, Path object) const {
    AssetEdit edit;
    edit.kind = kind;
    edit.object = object;
    edit.tidy = true;
    edit.may_rest = true;
    return edit;
  }

  Result<void> remove_prim() {
    if (kind_ != nullptr && prim_.type_name() != Token(std::string(kind_->type))) {
      return Error(ErrorCode::Invalid, "<" + wanted_.prim.str() + "> is no " +
                                           std::string(kind_->name) + " but of type " +
                                           prim_.type_name().str())
          .with_prim(wanted_.prim.str())
          .with_rule("edit.wrong-type")
          .with_fix("without =KIND the prim is removed, whatever it is");
    }
    const std::vector<Path> joints = joints_of_prim();
    release_followers(joints);
    for (const Path joint : joints) {
      edits_.push_back(edit_of(AssetEdit::Kind::RemovePrim, joint));
    }
    edits_.push_back(edit_of(AssetEdit::Kind::RemovePrim, wanted_.prim));
    return {};
  }

  /// Calls `with` on each prim of each stage but what is at the prim or below.
  template <class With>
  void walk_others(const With& with) const {
    for (const auto& stage : stages_) {
      std::vector<stage::Prim> open{stage->pseudo_root()};
      while (!open.empty()) {
        const stage::Prim at = open.back();
        open.pop_back();
        if (at.path().has_prefix(wanted_.prim)) {
          continue;
        }
        with(at);
        for (const stage::Prim& child : at.children()) {
          open.push_back(child);
        }
      }
    }
  }

  /// Mimics elsewhere whose leader is at the prim or below, or one of `joints`: without it they
  /// mean nothing.
  void release_followers(const std::vector<Path>& joints) {
    const auto goes = [&](Path path) {
      return path.has_prefix(wanted_.prim) ||
             std::find(joints.begin(), joints.end(), path) != joints.end();
    };
    std::map<Path, std::set<std::string>> mimics;
    walk_others([&](const stage::Prim& at) {
      for (const Token api : at.authored_api_schemas()) {
        const auto [name, instance] = schema::split_api_name(api);
        const std::string leader = name == "NewtonMimicAPI" ? "newton:mimicJoint"
                                   : name == "PhysxMimicJointAPI"
                                       ? "physxMimicJoint:" + instance.str() + ":referenceJoint"
                                   : name == "MjcEqualityJointAPI" ? "mjc:target"
                                                                   : "";
        if (leader.empty() || goes(at.path())) {
          continue;
        }
        const std::vector<Path> targets = at.relationship(Token(leader)).targets();
        if (!targets.empty() && std::all_of(targets.begin(), targets.end(), goes)) {
          mimics[at.path()].insert(api.str());
        }
      }
    });
    for (const auto& [follower, names] : mimics) {
      const RequestedKinds there{follower, {}};
      Removal removal(stages_, request_, engine_, there, edits_);
      removal.prim_ = find_in(stages_, follower);
      removal.take_off_schemas({names.begin(), names.end()});
    }
  }

  /// Joints elsewhere that have a side at the prim or below.
  std::vector<Path> joints_of_prim() const {
    std::set<Path> joints;
    const auto names_it = [&](const stage::Prim& joint) {
      for (const char* side : {"physics:body0", "physics:body1"}) {
        for (const Path target : joint.relationship(Token(side)).targets()) {
          if (target.has_prefix(wanted_.prim)) {
            return true;
          }
        }
      }
      return false;
    };
    walk_others([&](const stage::Prim& at) {
      if (at.is_a(Token("PhysicsJoint")) && names_it(at)) {
        joints.insert(at.path());
      }
    });
    return {joints.begin(), joints.end()};
  }

  Result<void> take_off() {
    if (kind_->name == "variant" || kind_->name == "engine") {
      return remove_variant();
    }
    if (kind_->name == "limit" && has_own_limits(prim_.type_name())) {
      const bool low = clear(Token("physics:lowerLimit"));
      const bool high = clear(Token("physics:upperLimit"));
      return low || high ? Result<void>() : Result<void>(has_none("limit"));
    }
    if (kind_->name == "binding") {
      return remove_binding();
    }
    if (kind_->name == "filtered-pair" && request_.options.contains("with")) {
      return remove_pair(request_.options.at("with"));
    }
    const std::vector<Token> apis = apis_of_kind();
    if (apis.empty()) {
      return has_none(std::string(kind_->name));
    }
    take_off_schemas(apis);
    return kind_->name == "body" ? leave_robot() : Result<void>();
  }

  void take_off_schemas(const std::vector<Token>& apis) {
    for (const Token property : properties_of(apis)) {
      clear(property);
    }
    for (const Token api : apis) {
      withdraw(api);
    }
  }

  /// What is no body is no link of a robot.
  Result<void> leave_robot() {
    const Path list = robot_list(stages_, wanted_.prim, kRobotLinks);
    if (list.empty()) {
      return {};
    }
    std::set<std::string> files;
    for (const auto& stage : stages_) {
      for (const auto& source : stage::opinion_sources(*stage, list.prim(), list.name())) {
        const auto* op = source.spec->get<layer::ListOp<Path>>(fields::targetPaths);
        if (op != nullptr && edit::adds(*op, wanted_.prim)) {
          files.insert(source.layer->identifier());
        }
      }
    }
    for (const std::string& file : files) {
      AssetEdit edit = edit_of(AssetEdit::Kind::RemoveTargets, list);
      edit.value = wanted_.prim.str();
      edit.layer = file;
      edits_.push_back(std::move(edit));
    }
    return {};
  }

  /// Schemas of the kind that the prim has under some selection.
  std::vector<Token> apis_of_kind() const {
    std::set<std::string> found;
    const auto dof = request_.options.find("dof");
    for (const auto& stage : stages_) {
      const stage::Prim prim = stage->prim(wanted_.prim);
      for (const Token api : prim ? prim.authored_api_schemas() : std::vector<Token>()) {
        const auto [name, instance] = schema::split_api_name(api);
        const auto is_name = [&](std::string_view pattern) {
          return pattern.substr(0, pattern.find(':')) == name.view();
        };
        const bool of_kind = std::any_of(kind_->apis.begin(), kind_->apis.end(), is_name) ||
                             std::any_of(kind_->also_ends.begin(), kind_->also_ends.end(), is_name);
        if (of_kind && (dof == request_.options.end() || instance.str() == dof->second)) {
          found.insert(api.str());
        }
      }
    }
    std::vector<Token> apis;
    for (const std::string& name : found) {
      apis.emplace_back(name);
    }
    return apis;
  }

  /// Declared by these and by nothing else that the prim is or has.
  std::vector<Token> properties_of(const std::vector<Token>& apis) const {
    std::vector<Token> others = prim_.authored_api_schemas();
    std::erase_if(
        others, [&](Token api) { return std::find(apis.begin(), apis.end(), api) != apis.end(); });
    const schema::PrimDefinition rest(prim_.type_name(), others);
    const schema::PrimDefinition mine(Token(), apis);
    std::vector<Token> properties;
    for (const Token name : mine.property_names(true)) {
      if (rest.find(name) == nullptr) {
        properties.push_back(name);
      }
    }
    return properties;
  }

  /// An edit for each file that has an opinion; false: none has.
  bool clear(Token property) {
    std::set<std::string> files;
    for (const auto& stage : stages_) {
      for (const auto& source : stage::opinion_sources(*stage, wanted_.prim, property)) {
        files.insert(source.layer->identifier());
      }
    }
    for (const std::string& file : files) {
      AssetEdit edit = edit_of(AssetEdit::Kind::ClearProperty, wanted_.prim.property(property));
      edit.layer = file;
      edits_.push_back(std::move(edit));
    }
    return !files.empty();
  }

  void withdraw(Token api) {
    std::set<std::string> files;
    for (const auto& stage : stages_) {
      for (const auto& source : stage::opinion_sources(*stage, wanted_.prim)) {
        const auto* op = source.spec->get<layer::ListOp<Token>>(fields::apiSchemas);
        if (op != nullptr && edit::adds(*op, api)) {
          files.insert(source.layer->identifier());
        }
      }
    }
    for (const std::string& file : files) {
      AssetEdit edit = edit_of(AssetEdit::Kind::RemoveApi, wanted_.prim);
      edit.api = api;
      edit.layer = file;
      edits_.push_back(std::move(edit));
    }
  }

  Result<void> remove_binding() {
    if (!clear(Token("material:binding:physics"))) {
      return has_none("physics material bound to it");
    }
    const auto names = prim_.authored_property_names();
    const bool others = std::any_of(names.begin(), names.end(), [](Token name) {
      return name.view().starts_with(kBinding) && name != "material:binding:physics";
    });
    if (!others) {
      withdraw(Token("MaterialBindingAPI"));
    }
    return {};
  }

  Result<void> remove_pair(const std::string& other) {
    const Token property("physics:filteredPairs");
    std::vector<Path> targets = prim_.relationship(property).targets();
    TENON_TRY(const Path path, Path::parse(other));
    if (std::erase(targets, path) == 0) {
      return has_none("filtered pair with <" + other + ">");
    }
    if (targets.empty()) {
      clear(property);
      withdraw(Token("PhysicsFilteredPairsAPI"));
      return {};
    }
    AssetEdit edit = edit_of(AssetEdit::Kind::RemoveTargets, wanted_.prim.property(property));
    edit.value = other;
    edits_.push_back(std::move(edit));
    return {};
  }

  Result<void> remove_variant() {
    AssetEdit edit = edit_of(AssetEdit::Kind::RemoveVariant, wanted_.prim);
    edit.tidy = kind_->name == "engine";  // its file goes, too
    if (kind_->name == "engine") {
      edit.value = "Physics=" + engine_;
    } else {
      edit.value = request_.options.at("variant");
    }
    const std::size_t equals = edit.value.find('=');
    const auto names = prim_.variant_names(edit.value.substr(0, equals));
    if (equals == std::string::npos ||
        std::find(names.begin(), names.end(), edit.value.substr(equals + 1)) == names.end()) {
      return has_none("variant " + edit.value);
    }
    edits_.push_back(std::move(edit));
    return {};
  }

  const Stages& stages_;
  const AuthoringRequest& request_;
  const std::string& engine_;
  const RequestedKinds& wanted_;
  RemovedEdits& edits_;
  stage::Prim prim_;
  const AuthoringKind* kind_ = nullptr;
};

/// To name what goes: of the options only these matter.
Result<void> check_removal_options(const AuthoringRequest& request) {
  for (const auto& [name, value] : request.options) {
    if (name != "dof" && name != "with" && name != "variant") {
      return Error(ErrorCode::Invalid, "removing takes no --" + name)
          .with_rule("edit.bad-argument")
          .with_fix("remove that option: the kind is removed with all its properties");
    }
  }
  return {};
}

}  // namespace

Result<std::vector<AssetEdit>> remove_edits(const Stages& stages, const AuthoringRequest& request,
                                            const std::string& engine) {
  TENON_CHECK(check_removal_options(request));
  std::vector<RequestedKinds> requested;
  for (const std::string& text : request.what) {
    TENON_TRY(RequestedKinds one, read_requested(text, false));
    requested.push_back(std::move(one));
  }
  RemovedEdits edits;
  for (const RequestedKinds& one : requested) {
    TENON_CHECK(Removal(stages, request, engine, one, edits).make());
  }
  return edits;
}

}  // namespace tenon
