// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A fix is a list of edits of single fields. A value is edited at its strongest opinion, so that
// the composed value changes, and an API is removed from every list that adds it. There is no fix
// where it would have to guess, where the value is animated, or where the opinion is in memory or
// in a package: those are not written to.
#include "tenon/check/fixes.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "tenon/base/text/text_number.h"
#include "tenon/check/subject.h"
#include "tenon/check/unit_signs.h"
#include "tenon/edit/apply_list_edit.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"
#include "tenon/layer/type_names.h"
#include "tenon/physics/attribute_values.h"
#include "tenon/physics/prim_roles.h"
#include "tenon/schema/registry.h"
#include "tenon/stage/collections/material_binding.h"

namespace tenon::check {
namespace {

namespace fields = layer::fields;
using layer::Value;
using stage::SpecSite;

/// A file of its own: neither in memory nor inside of a package.
bool is_writable(const layer::Layer& layer) {
  const std::string& name = layer.identifier();
  return name.starts_with('/') && name.find('[') == std::string::npos && !name.ends_with(".usdz");
}

stage::Prim prim_of(const Subject& subject, const Diagnostic& diagnostic) {
  return subject.stage.prim(Path::from(diagnostic.prim));
}

/// The strongest opinion on a property where it is a default that a file holds.
std::optional<SpecSite> value_site(const stage::Prim& prim, Token name) {
  for (const SpecSite& site : prim.attribute(name).spec_stack()) {
    if (site.spec->has(fields::timeSamples) || site.spec->has(fields::spline)) {
      return std::nullopt;
    }
    if (site.spec->has(fields::default_value)) {
      return is_writable(*site.layer) ? std::optional<SpecSite>(site) : std::nullopt;
    }
  }
  return std::nullopt;
}

SpecEdit field_edit(const SpecSite& site, Token field, Value value) {
  return {site.layer->identifier(), site.path, field, std::move(value), {}, false, {}, {}};
}

Fix set_field(std::string what, const SpecSite& site, Token field, Value value) {
  return {std::move(what), {field_edit(site, field, std::move(value))}};
}

std::optional<Fix> set_value(const stage::Prim& prim, Token name, Value value, std::string what) {
  const std::optional<SpecSite> site = value_site(prim, name);
  if (!site) {
    return std::nullopt;
  }
  return set_field(std::move(what), *site, fields::default_value, std::move(value));
}

/// A new opinion in the prim spec `site`, or the one that it has already.
Fix author(std::string what, const SpecSite& site, Token name, const char* type, Value value,
           bool uniform) {
  return {std::move(what),
          {{site.layer->identifier(),
            site.path.property(name),
            fields::default_value,
            std::move(value),
            Token(type),
            uniform,
            {},
            {}}}};
}

/// Takes an API name out of every list that adds it.
std::optional<Fix> remove_api(const stage::Prim& prim, Token api) {
  Fix fix{"remove " + api.str(), {}};
  for (const SpecSite& site : prim.spec_stack()) {
    const auto* op = site.spec->get<layer::ListOp<Token>>(fields::apiSchemas);
    if (op == nullptr || !edit::adds(*op, api)) {
      continue;
    }
    if (!is_writable(*site.layer)) {
      return std::nullopt;
    }
    fix.edits.push_back({site.layer->identifier(), site.path, {}, {}, {}, false, {}, api});
  }
  return fix.edits.empty() ? std::nullopt : std::optional<Fix>(std::move(fix));
}

Fix add_api(const SpecSite& site, Token api) {
  return {"apply " + api.str(),
          {{site.layer->identifier(), site.path, {}, {}, {}, false, api, {}}}};
}

bool same_but_capitals(const std::string& a, const std::string& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) ==
           std::tolower(static_cast<unsigned char>(y));
  });
}

template <class Q, class Number>
std::optional<Value> unit(const Value& value) {
  const Q* q = value.get<Q>();
  if (q == nullptr || !(dot(to_double(*q), to_double(*q)) > 0)) {
    return std::nullopt;
  }
  const Quatd n = normalized(to_double(*q));
  return Value(Q{static_cast<Number>(n.x), static_cast<Number>(n.y), static_cast<Number>(n.z),
                 static_cast<Number>(n.w)});
}

}  // namespace

std::optional<Fix> fix_metadata(const Subject& subject, const Diagnostic& diagnostic) {
  const layer::Layer& root = subject.stage.root_layer();
  if (!is_writable(root)) {
    return std::nullopt;
  }
  const Path path = Path::absolute_root();
  const SpecSite site{&root, path, root.find(path)};
  if (diagnostic.rule == "stage.meters-per-unit-missing") {
    if (!may_be_centimetres(subject)) {
      return std::nullopt;
    }
    return set_field("author metersPerUnit = 0.01", site, fields::metersPerUnit, Value(0.01));
  }
  if (diagnostic.rule == "stage.kilograms-per-unit-missing") {
    if (!may_be_kilograms(subject)) {
      return std::nullopt;
    }
    return set_field("author kilogramsPerUnit = 1", site, fields::kilogramsPerUnit, Value(1.0));
  }
  if (!may_have_y_up(subject)) {
    return std::nullopt;
  }
  return set_field("author upAxis = \"Y\"", site, fields::upAxis, Value(Token("Y")));
}

std::optional<Fix> fix_default_prim(const Subject& subject, const Diagnostic&) {
  const layer::Layer& root = subject.stage.root_layer();
  const std::vector<stage::Prim> children = subject.stage.pseudo_root().children();
  if (!is_writable(root) || children.size() != 1) {
    return std::nullopt;
  }
  const Path path = Path::absolute_root();
  const Token name = children.front().name();
  return set_field("author defaultPrim = \"" + name.str() + "\"", {&root, path, root.find(path)},
                   fields::defaultPrim, Value(name));
}

namespace {

/// A selection in the strongest file that has one for the set, or in the prim's own root spec.
std::optional<Fix> select(const Subject& subject, const stage::Prim& prim, const std::string& set,
                          const std::string& variant) {
  std::optional<SpecSite> place;
  for (const SpecSite& site : prim.spec_stack()) {
    if (site.layer == subject.stage.session_layer()) {
      continue;
    }
    place = place ? place : std::optional<SpecSite>(site);
    const auto* selections = site.spec->get<layer::VariantSelections>(fields::variantSelection);
    if (selections != nullptr && selections->items.contains(set)) {
      place = site;
      break;
    }
  }
  if (!place || !is_writable(*place->layer)) {
    return std::nullopt;
  }
  auto selections = place->spec->get_or(fields::variantSelection, layer::VariantSelections{});
  selections.items[set] = variant;
  return set_field("select " + set + "=" + variant, *place, fields::variantSelection,
                   Value(std::move(selections)));
}

}  // namespace

std::optional<Fix> fix_selection(const Subject& subject, const Diagnostic& diagnostic) {
  const stage::Prim prim = prim_of(subject, diagnostic);
  for (const SpecSite& site : prim.spec_stack()) {
    const auto* selections = site.spec->get<layer::VariantSelections>(fields::variantSelection);
    if (selections == nullptr || site.layer == subject.stage.session_layer()) {
      continue;
    }
    for (const auto& [set, variant] : selections->items) {
      std::vector<std::string> names = prim.variant_names(set);
      const bool known = std::find(names.begin(), names.end(), variant) != names.end();
      std::erase_if(names, [&](const std::string& n) { return !same_but_capitals(n, variant); });
      if (!known && names.size() == 1) {
        return select(subject, prim, set, names.front());
      }
    }
  }
  return std::nullopt;
}

std::optional<Fix> fix_unselected(const Subject& subject, const Diagnostic& diagnostic) {
  const stage::Prim prim = prim_of(subject, diagnostic);
  const std::vector<std::string> names = prim.variant_names("Physics");
  const bool plain = std::find(names.begin(), names.end(), "physics") != names.end();
  return plain ? select(subject, prim, "Physics", "physics") : std::nullopt;
}

std::optional<Fix> fix_quaternion_length(const Subject& subject, const Diagnostic& diagnostic) {
  const stage::Prim prim = prim_of(subject, diagnostic);
  const Value value = prim.attribute(diagnostic.property).get();
  std::optional<Value> fixed = unit<Quatf, float>(value);
  fixed = fixed ? fixed : unit<Quatd, double>(value);
  if (!fixed) {
    return std::nullopt;
  }
  return set_value(prim, diagnostic.property, *std::move(fixed),
                   "normalise " + diagnostic.property);
}

std::optional<Fix> fix_rotation_zero(const Subject& subject, const Diagnostic& diagnostic) {
  return set_value(prim_of(subject, diagnostic), diagnostic.property, Value(Quatf{0, 0, 0, 1}),
                   "author " + diagnostic.property + " = (1, 0, 0, 0)");
}

std::optional<Fix> fix_dynamic_mesh(const Subject& subject, const Diagnostic& diagnostic) {
  const stage::Prim prim = prim_of(subject, diagnostic);
  const Token name("physics:approximation");
  const std::string what = "author physics:approximation = \"convexHull\"";
  if (prim.attribute(name).has_authored_value()) {
    return set_value(prim, name, Value(Token("convexHull")), what);
  }
  if (!prim.has_api("PhysicsMeshCollisionAPI")) {
    return std::nullopt;  // the API would have to be applied as well
  }
  for (const SpecSite& site : prim.spec_stack()) {
    if (site.spec->has(fields::apiSchemas) && is_writable(*site.layer)) {
      return author(what, site, name, "token", Value(Token("convexHull")), true);
    }
  }
  return std::nullopt;
}

std::optional<Fix> fix_friction_order(const Subject& subject, const Diagnostic& diagnostic) {
  const stage::Prim prim = prim_of(subject, diagnostic);
  const auto dynamic = prim.attribute("physics:dynamicFriction").get_as<float>();
  const Token name("physics:staticFriction");
  if (!dynamic) {
    return std::nullopt;
  }
  const std::string what = "author physics:staticFriction = " + shortest(*dynamic);
  if (prim.attribute(name).has_authored_value()) {
    return set_value(prim, name, Value(*dynamic), what);
  }
  std::optional<SpecSite> site = value_site(prim, "physics:dynamicFriction");
  if (!site) {
    return std::nullopt;
  }
  site->path = site->path.parent();
  return author(what, *site, name, "float", Value(*dynamic), false);
}

std::optional<Fix> fix_restitution(const Subject& subject, const Diagnostic& diagnostic) {
  return set_value(prim_of(subject, diagnostic), "physics:restitution", Value(1.0F),
                   "author physics:restitution = 1");
}

std::optional<Fix> fix_negative_gravity(const Subject& subject, const Diagnostic& diagnostic) {
  return set_value(prim_of(subject, diagnostic), "physics:gravityMagnitude",
                   Value(-std::numeric_limits<float>::infinity()),
                   "author physics:gravityMagnitude = -inf, which means earth");
}

std::optional<Fix> fix_mesh_api(const Subject& subject, const Diagnostic& diagnostic) {
  return remove_api(prim_of(subject, diagnostic), "PhysicsMeshCollisionAPI");
}

std::optional<Fix> fix_material_api(const Subject& subject, const Diagnostic& diagnostic) {
  return remove_api(prim_of(subject, diagnostic), "PhysicsMaterialAPI");
}

std::optional<Fix> fix_nested_root(const Subject& subject, const Diagnostic& diagnostic) {
  return remove_api(prim_of(subject, diagnostic), "PhysicsArticulationRootAPI");
}

std::optional<Fix> fix_binding_api(const Subject& subject, const Diagnostic& diagnostic) {
  const stage::Prim prim = prim_of(subject, diagnostic);
  const Path binding = stage::find_material_binding(prim, "physics").relationship;
  const stage::Prim owner = subject.stage.prim(binding.prim());
  for (SpecSite site : owner.relationship(binding.name()).spec_stack()) {
    if (!is_writable(*site.layer)) {
      continue;
    }
    site.path = site.path.parent();
    site.spec = site.layer->find(site.path);
    return site.spec == nullptr ? std::nullopt
                                : std::optional<Fix>(add_api(site, "MaterialBindingAPI"));
  }
  return std::nullopt;
}

std::optional<Fix> fix_guide_purpose(const Subject& subject, const Diagnostic& diagnostic) {
  const stage::Prim prim = prim_of(subject, diagnostic);
  const std::string what = "author purpose = \"guide\"";
  if (prim.attribute("purpose").has_authored_value()) {
    return set_value(prim, "purpose", Value(Token("guide")), what);
  }
  for (const SpecSite& site : prim.spec_stack()) {
    if (is_writable(*site.layer)) {
      return author(what, site, "purpose", "token", Value(Token("guide")), true);
    }
  }
  return std::nullopt;
}

namespace {

/// Gives a number the type that the schema declares, where it is another one; nothing else can.
/// What differs by its role alone (float3, color3f) keeps its own.
bool give_type(const SpecSite& site, const schema::PropertyDefinition* declared, Fix& fix) {
  const layer::TypeName* own = layer::find_type_name(site.spec->get_or(fields::typeName, Token()));
  if (declared == nullptr || declared->type == nullptr ||
      (own != nullptr && own->type == declared->type->type &&
       own->is_array == declared->type->is_array)) {
    return true;
  }
  const Value* given = site.spec->find(fields::default_value);
  const std::optional<double> number = given == nullptr ? std::nullopt : physics::number_of(*given);
  if (!number || declared->type_name != "float" ||
      site.spec->find(fields::timeSamples) != nullptr ||
      site.spec->find(fields::connectionPaths) != nullptr) {
    return false;
  }
  fix.edits.push_back(field_edit(site, fields::typeName, Value(declared->type_name)));
  fix.edits.push_back(field_edit(site, fields::default_value, Value(static_cast<float>(*number))));
  return true;
}

/// Every spec of the property gets the name and the type of the schema, unless the prim has a
/// property of that name, a spec cannot be written to or its value cannot have that type.
std::optional<Fix> new_name(const Subject& subject, const Diagnostic& diagnostic,
                            std::string_view space) {
  const stage::Prim prim = prim_of(subject, diagnostic);
  const Token name(diagnostic.property);
  const Token wanted(std::string(space) + diagnostic.property);
  if (!prim || !prim.attribute(wanted).spec_stack().empty()) {
    return std::nullopt;
  }
  Fix fix{"rename " + name.str() + " to " + wanted.str(), {}};
  const schema::PropertyDefinition* declared = prim.definition()->find(wanted);
  for (const SpecSite& site : prim.attribute(name).spec_stack()) {
    if (!is_writable(*site.layer) || !give_type(site, declared, fix)) {
      return std::nullopt;
    }
    SpecEdit edit;
    edit.layer = site.layer->identifier();
    edit.path = site.path;
    edit.new_name = wanted;
    fix.edits.push_back(std::move(edit));
  }
  if (std::any_of(fix.edits.begin(), fix.edits.end(),
                  [](const SpecEdit& edit) { return edit.field == fields::typeName; })) {
    fix.what += " of type " + declared->type_name.str();
  }
  return fix.edits.empty() ? std::nullopt : std::optional<Fix>(std::move(fix));
}

std::optional<Fix> suggest_prefix(const Subject& subject, const Diagnostic& diagnostic) {
  return new_name(subject, diagnostic, "physics:");
}

std::optional<Fix> suggest_input(const Subject& subject, const Diagnostic& diagnostic) {
  return new_name(subject, diagnostic, "inputs:");
}

std::optional<Fix> suggest_joint_type(const Subject& subject, const Diagnostic& diagnostic) {
  const stage::Prim prim = prim_of(subject, diagnostic);
  const Token meant = prim ? physics::meant_joint_type(prim.type_name().view()) : Token();
  if (meant.empty()) {
    return std::nullopt;
  }
  Fix fix{"change the type to " + meant.str(), {}};
  for (const SpecSite& site : prim.spec_stack()) {
    if (site.spec->get_or(fields::typeName, Token()) != prim.type_name()) {
      continue;
    }
    if (!is_writable(*site.layer)) {
      return std::nullopt;
    }
    fix.edits.push_back(field_edit(site, fields::typeName, Value(meant)));
  }
  return fix.edits.empty() ? std::nullopt : std::optional<Fix>(std::move(fix));
}

}  // namespace

FixFunction* suggestion_for(std::string_view rule) {
  return rule == "attribute.unprefixed"    ? suggest_prefix
         : rule == "attribute.moved-input" ? suggest_input
         : rule == "joint.unknown-type"    ? suggest_joint_type
                                           : nullptr;
}

}  // namespace tenon::check
