// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Files are checked by the tables of the layout, in two passes: overs do not repeat the types of
// prims, and any file may hold the arc that leads to another, so types, instances and arcs of all
// files are learned before each spec is checked against what its file may own. What shows only when
// layers are composed, dangling targets and live colliders, is checked on a stage for each variant.
#include "tenon/structure/check_structure.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "tenon/layer/fields.h"
#include "tenon/layer/finding_place.h"
#include "tenon/structure/layer_arcs.h"
#include "tenon/structure/layer_tree.h"
#include "tenon/structure/layout.h"

namespace tenon::structure {
namespace {

namespace fields = layer::fields;
using layer::Layer;
using layer::Spec;
using layer::SpecKind;

Diagnostic finding(Severity severity, const char* rule, const Layer& layer, Path path,
                   const Message& message, std::string fix, StatementPart part = {}) {
  Diagnostic found;
  found.severity = severity;
  found.rule = rule;
  found.say(message);
  found.fix = std::move(fix);
  layer::place_finding(found, layer, path, std::move(part));
  found.line = std::max(found.line, 1U);
  if (!path.is_absolute_root()) {
    found.prim = path.prim_or_variant().strip_variants().str();
    found.property = path.is_property() ? path.name().str() : std::string();
  }
  return found;
}

bool is_absolute(const std::string& asset) {
  return asset.starts_with("/") || asset.starts_with("file:") ||
         (asset.size() > 2 && asset[1] == ':' && (asset[2] == '\\' || asset[2] == '/'));
}

/// "the base", "physics", as a message names a file.
std::string named(Role role) { return "a file for " + std::string(role_name(role)); }

class FileChecker {
 public:
  explicit FileChecker(const AssetFiles& files) : files_(files) {}

  Diagnostics run() {
    roles_ = roles_of_files(*files_.interface, files_.payloads);
    if (roles_.empty()) {
      add(Severity::Error, "structure.not-structured", *files_.interface, Path::absolute_root(),
          "the default prim has no reference to a base: the asset has not this structure",
          "make it with `tenon structure`");
      return std::move(found_);
    }
    learn(*files_.interface);
    for (const layer::LayerPtr& layer : files_.payloads) {
      learn(*layer);
    }
    check_layer(*files_.interface, Role::Interface);
    check_selection();
    for (const layer::LayerPtr& layer : files_.payloads) {
      check_payload(*layer);
    }
    return std::move(found_);
  }

 private:
  void add(Severity severity, const char* rule, const Layer& layer, Path path,
           const Message& message, std::string fix, StatementPart part = {}) {
    found_.add(finding(severity, rule, layer, path, message, std::move(fix), std::move(part)));
  }

  /// Types of prims, which overs do not repeat, instances, and which files arcs lead to.
  void learn(const Layer& layer) {
    const auto role = roles_.find(layer.identifier());
    const bool of_robot = role != roles_.end() && root_scope(role->second).empty();
    for (const Layer::Entry& entry : layer.entries()) {
      if (!of_robot || entry.spec.kind != SpecKind::Prim) {
        continue;
      }
      const Path path = entry.path.strip_variants();
      if (const auto* type = entry.spec.get<Token>(fields::typeName)) {
        types_.emplace(path, *type);
      }
      if (entry.spec.get_or(fields::instanceable, false)) {
        instances_.insert(path);
      }
    }
    for (const LayerArc& arc : arcs_of(layer)) {
      if (!arc.asset_path.empty()) {
        used_.insert(target_of(arc.asset_path, layer));
      }
    }
  }

  void check_payload(const Layer& layer) {
    const auto role = roles_.find(layer.identifier());
    if (!used_.contains(layer.identifier())) {
      add(Severity::Error, "structure.orphan-file", layer, Path::absolute_root(),
          "no arc of the asset leads to this file", "remove it, or add the variant that loads it");
    }
    if (role != roles_.end()) {
      check_layer(layer, role->second);
    }
  }

  void check_layer(const Layer& layer, Role role) {
    for (const Layer::Entry& entry : layer.entries()) {
      if (entry.path.empty()) {
        continue;
      }
      const SpecKind kind = entry.spec.kind;
      if (kind == SpecKind::Prim || kind == SpecKind::Variant) {
        check_prim(layer, role, entry);
      } else if (kind == SpecKind::Attribute || kind == SpecKind::Relationship) {
        check_property(layer, role, entry.path);
      }
    }
    check_arcs(layer, role);
    check_roots(layer, role);
  }

  Token known_type(const Layer& layer, Path prim) const {
    const Token own = type_of(layer, prim);
    const auto known = types_.find(prim.strip_variants());
    return own.empty() && known != types_.end() ? known->second : own;
  }

  void check_owner(const Layer& layer, Role role, Path path, const Ownership& owner,
                   const std::string& what, StatementPart part = {}) {
    // Files of an unknown engine, or of a set of its own, stay with it.
    if (role != Role::Variant && role != Role::Engine && !owner.may_be_in(role) &&
        !is_at_home(layer, role, path.prim(), owner.owner)) {
      add(Severity::Error, "structure.wrong-layer", layer, path,
          what + " does not belong in " + named(role), "move it to " + named(owner.owner),
          std::move(part));
    }
  }

  /// Whether a prim that the file defines, or one below it, is described by an opinion on a scene,
  /// a joint or a material. Neutral physics does nothing on materials, which may keep it.
  bool is_at_home(const Layer& layer, Role role, Path prim, Role owner) const {
    if (owner == Role::Physics) {
      return known_type(layer, prim) == "Material" &&
             RoleSet(Role::Base, Role::Materials, Role::Instances).contains(role);
    }
    if (owner != Role::Base || role == Role::Geometries) {
      return false;
    }
    for (Path at = prim; at.is_prim(); at = at.parent()) {
      const Token type = type_of(layer, at);
      if (!type.empty() && owner_of_type(type).owner == role) {
        return true;
      }
    }
    return false;
  }

  void check_prim(const Layer& layer, Role role, const Layer::Entry& entry) {
    const Path path = entry.path;
    if (const auto* type = entry.spec.get<Token>(fields::typeName)) {
      const bool is_asset = path.parent().is_absolute_root() && root_scope(role).empty();
      if (!is_asset) {
        check_owner(layer, role, path, owner_of_type(*type), "a prim of type " + type->str(),
                    layer::field_part(fields::typeName));
      }
    }
    for (const Token api : apis_of(layer, path)) {
      const StatementPart part = layer::item_part(fields::apiSchemas, api.str());
      check_owner(layer, role, path, owner_of_api(api), api.str(), part);
      if (const Replacement* better = replacement_of(api.view())) {
        add(Severity::Info, "structure.legacy-schema", layer, path,
            api.str() + " is of an older generation, which newer engines do not read",
            "author " + std::string(better->current), part);
      }
    }
    check_empty(layer, entry);
    for (Path at = path.strip_variants().parent(); at.is_prim(); at = at.parent()) {
      if (instances_.contains(at) && root_scope(role).empty()) {
        add(Severity::Error, "structure.below-instance", layer, path,
            named(at) + " is an instance: opinions below it are not composed",
            "author them in the file of the instances, or let the prim be no instance");
        break;
      }
    }
  }

  void check_empty(const Layer& layer, const Layer::Entry& entry) {
    const bool over =
        entry.spec.kind == SpecKind::Prim &&
        entry.spec.get_or(fields::specifier, layer::Specifier::Over) == layer::Specifier::Over;
    const bool bare =
        std::all_of(entry.spec.fields().begin(), entry.spec.fields().end(),
                    [](const layer::Field& field) { return field.name == fields::specifier; });
    if (over && bare) {
      add(Severity::Warning, "structure.empty-over", layer, entry.path, "the over says nothing",
          "remove it");
    }
  }

  void check_property(const Layer& layer, Role role, Path path) {
    const Path prim = path.parent();
    if (prim.is_prim_or_variant()) {
      const Ownership owner =
          owner_of_property(path.name(), known_type(layer, prim), apis_of(layer, prim));
      check_owner(layer, role, path, owner, path.name().str());
    }
  }

  void check_arcs(const Layer& layer, Role role) {
    for (const LayerArc& arc : arcs_of(layer, true)) {
      if (arc.asset_path.empty()) {
        continue;
      }
      if (is_absolute(arc.asset_path)) {
        add(Severity::Error, "structure.absolute-path", layer, arc.spec,
            "@" + arc.asset_path + "@ is an absolute path: the asset cannot be moved",
            "write it relative to this file, beginning with \"./\" or \"../\"", arc.part());
      }
      const std::string target = target_of(arc.asset_path, layer);
      const bool relative = arc.asset_path.starts_with("./") || arc.asset_path.starts_with("../") ||
                            arc.kind != Arc::Asset;
      const bool pattern = arc.asset_path.find('<') != std::string::npos;
      if (relative && !pattern && !files_.exists(target)) {
        add(Severity::Error, "structure.missing-file", layer, arc.spec,
            "@" + arc.asset_path + "@ is not there", "put the file there, or remove the arc",
            arc.part());
        continue;
      }
      const auto to = roles_.find(target);
      if (!may_lead(role, arc.kind, to == roles_.end() ? Role::Other : to->second)) {
        add(Severity::Error, "structure.wrong-arc", layer, arc.spec,
            "a " + std::string(arc_name(arc.kind)) + " to @" + arc.asset_path +
                "@ has no place in " + named(role),
            "let the files refer to each other as the structure has it", arc.part());
      }
    }
  }

  /// A payload or reference composes the default prim; other root prims are lost.
  void check_roots(const Layer& layer, Role role) {
    const bool by_default_prim = role == Role::Physics || is_engine(role);
    for (const Path& prim : child_prims(layer, Path::absolute_root())) {
      if (by_default_prim && prim.name() != layer.default_prim()) {
        const bool scene = type_of(layer, prim) == "PhysicsScene";
        add(Severity::Error, "structure.scene-not-composed", layer, prim,
            (scene ? std::string("the PhysicsScene") : "<" + prim.str() + ">") +
                " is outside the default prim: no arc composes it",
            "move it below <" +
                Path::absolute_root().child(files_.interface->default_prim()).str() + ">");
      }
    }
  }

  void check_selection() {
    const Layer& interface = *files_.interface;
    const Path robot = Path::absolute_root().child(interface.default_prim());
    const Spec* spec = interface.find(robot);
    const auto* chosen =
        spec == nullptr ? nullptr : spec->get<layer::VariantSelections>(fields::variantSelection);
    if (chosen == nullptr) {
      return;
    }
    for (const auto& [set, variant] : chosen->items) {
      if (!interface.has(robot.variant_selection(Token(set), Token(variant)))) {
        add(Severity::Error, "structure.dangling-selection", interface, robot,
            "the variant set \"" + set + "\" has no variant \"" + variant +
                "\": nothing of it is composed",
            "select one that exists", layer::entry_part(fields::variantSelection, {set}, variant));
      }
    }
  }

  const AssetFiles& files_;
  RolesOfFiles roles_;
  std::map<Path, Token> types_;
  std::set<Path> instances_;
  std::set<std::string> used_;
  Diagnostics found_;
};

/// Calls `visit` for each active prim that is defined.
template <class Visit>
void each_prim(const stage::Stage& stage, Visit visit) {
  std::vector<stage::Prim> pending{stage.pseudo_root()};
  while (!pending.empty()) {
    const stage::Prim prim = pending.back();
    pending.pop_back();
    if (!prim.is_active()) {
      continue;
    }
    visit(prim);
    const std::vector<stage::Prim> children = prim.children();
    pending.insert(pending.end(), children.rbegin(), children.rend());
  }
}

bool exists(const stage::Stage& stage, Token property, Path target) {
  const stage::Prim prim = stage.prim(target.prim());
  if (prim) {
    // What is overridden and defined nowhere is not there for anybody who follows the target, but
    // for point instancers.
    return prim.is_defined() || prim.is_pseudo_root() || property == "prototypes";
  }
  for (Path at = target.prim(); !at.empty() && !at.is_absolute_root(); at = at.parent()) {
    if (const stage::Prim above = stage.prim(at)) {
      return !above.is_active();
    }
  }
  return false;
}

/// What a variant of another set brings along has its physics with it: the structure has no file
/// for a variant of two sets.
bool is_of_other_set(const Diagnostic& finding) {
  const std::size_t place = finding.file.rfind("payloads/");
  return place != std::string::npos &&
         role_of_file_name(std::string_view(finding.file).substr(place)) == Role::Variant;
}

}  // namespace

Diagnostics check_files(const AssetFiles& files) { return FileChecker(files).run(); }

Diagnostics check_variant(const stage::Stage& stage, const std::string& variant) {
  Diagnostics found;
  each_prim(stage, [&](const stage::Prim& prim) {
    // The joints of a named pose are those of the variants with physics.
    const bool is_bare = variant == kNoVariant && prim.type_name() == kNamedPoseType;
    for (const Token name : is_bare ? std::vector<Token>() : prim.authored_property_names()) {
      const bool relationship = prim.is_relationship(name);
      for (const Path& target :
           relationship ? prim.relationship(name).targets() : prim.attribute(name).connections()) {
        if (!exists(stage, name, target)) {
          Diagnostic dangling = relationship
                                    ? prim.relationship(name).located_target(
                                          Severity::Error, "structure.dangling-target", "", target)
                                    : prim.attribute(name).located_target(
                                          Severity::Error, "structure.dangling-target", "", target);
          dangling.say(name.str() + " names " + named(target, RelatedRole::Target) +
                       ", which is not there");
          dangling.fix = "author the target in the file that defines the prim";
          found.add(std::move(dangling));
        }
      }
    }
    const stage::Attribute enabled = prim.attribute("physics:collisionEnabled");
    if (variant == kNoVariant && prim.has_api("PhysicsCollisionAPI") &&
        enabled.get_as<bool>().value_or(true)) {
      Diagnostic live = prim.located(Severity::Error, "structure.live-collider",
                                     "the collider is live without physics");
      live.fix = "switch it off in the base (active = false) and on in physics";
      if (!is_of_other_set(live)) {
        found.add(std::move(live));
      }
    }
  });
  return found;
}

}  // namespace tenon::structure
