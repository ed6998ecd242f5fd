// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Before a spec changes for the first time its state is kept. Compared with the layer at the end
// this gives the change, without specs that are as they were, and its inverse takes everything
// back. Creating, removing and moving change a spec and its name in its parent's list
// (primChildren, properties, sets and variants) together. The latter two change the whole subtree,
// found in one scan of all specs.
#include "tenon/edit/layer_editor.h"

#include <algorithm>

#include "tenon/layer/fields.h"
#include "tenon/layer/spec_equality.h"
#include "tenon/layer/type_names.h"

namespace tenon::edit {

using layer::Spec;
using layer::SpecKind;
using layer::Value;
namespace fields = layer::fields;

namespace {

Error bad_name(const std::string& what, std::string_view name, std::string fix) {
  return Error(ErrorCode::Invalid, "\"" + std::string(name) + "\" cannot name a " + what)
      .with_rule("edit.bad-name")
      .with_fix(std::move(fix));
}

Error no_spec(const char* what, Path path, const layer::Layer& layer) {
  return Error(ErrorCode::NotFound,
               "the layer has no " + std::string(what) + " at <" + path.str() + ">")
      .in_file(layer.identifier())
      .with_prim(path.prim().str())
      .with_rule("edit.no-spec")
      .with_fix("choose the layer with the opinion as edit target");
}

/// The field of the parent that lists the child, and the child's name there.
struct Listing {
  Path parent;
  Token field;
  Token name;
};

Listing listing_of(Path path) {
  if (path.is_property()) {
    return {path.parent(), fields::properties, path.name()};
  }
  if (!path.is_variant_selection()) {
    return {path.parent(), fields::primChildren, path.name()};
  }
  if (path.variant().empty()) {
    return {path.parent(), fields::variantSetChildren, path.name()};
  }
  return {path.parent().variant_selection(path.name(), Token()), fields::variantChildren,
          path.variant()};
}

}  // namespace

LayerChange LayerEditor::take_change() {
  LayerChange change{layer_->identifier(), std::move(touched_)};
  touched_.clear();
  index_.clear();
  for (SpecChange& spec : change.specs) {
    if (const Spec* now = layer_->find(spec.path)) {
      spec.after = *now;
    }
  }
  std::erase_if(change.specs, [](const SpecChange& spec) {
    return spec.before.has_value() == spec.after.has_value() &&
           (!spec.before || layer::same_spec(*spec.before, *spec.after));
  });
  return change;
}

LayerChange LayerEditor::roll_back() {
  LayerChange back = inverse(take_change());
  edit::apply(back, *layer_);
  return back;
}

Spec& LayerEditor::touch(Path path) {
  Spec* const spec = layer_->find(path);
  if (spec == nullptr) {
    return add_spec(path, path.is_property() ? SpecKind::Attribute : SpecKind::Prim);
  }
  if (index_.emplace(path, touched_.size()).second) {
    touched_.push_back({path, *spec, std::nullopt});
  }
  return *spec;
}

Spec& LayerEditor::add_spec(Path path, SpecKind kind) {
  if (index_.emplace(path, touched_.size()).second) {
    touched_.push_back({path, std::nullopt, std::nullopt});
  }
  return layer_->create(path, kind);
}

void LayerEditor::erase_spec(Path path) {
  touch(path);
  layer_->erase(path);
}

void LayerEditor::set(Path path, Token field, Value value) {
  touch(path).set(field, std::move(value));
}

void LayerEditor::erase(Path path, Token field) {
  const Spec* spec = layer_->find(path);
  if (spec != nullptr && spec->has(field)) {
    touch(path).erase(field);
  }
}

void LayerEditor::add_child(Path parent, Token field, Token name) {
  const std::vector<Token>& listed = layer_->children(parent, field);
  if (std::find(listed.begin(), listed.end(), name) == listed.end()) {
    std::vector<Token> names;
    names.reserve(listed.size() + 1);  // lists may be long, and are kept by the history
    names.insert(names.end(), listed.begin(), listed.end());
    names.push_back(name);
    set(parent, field, Value(std::move(names)));
  }
}

void LayerEditor::remove_child(Path parent, Token field, Token name) {
  std::vector<Token> names = layer_->children(parent, field);
  std::erase(names, name);
  names.empty() ? erase(parent, field) : set(parent, field, Value(std::move(names)));
}

Result<void> LayerEditor::create_prim(Path path) {
  std::vector<Path> missing;
  for (Path at = path; !layer_->has(at); at = at.parent()) {
    if (!at.is_prim_or_variant() || !at.is_absolute()) {
      return Error(ErrorCode::Invalid, "<" + path.str() + "> is not a place for a prim")
          .with_rule("edit.bad-path")
          .with_fix("write it from the root, as in /World/Robot");
    }
    missing.push_back(at);
  }
  for (auto at = missing.rbegin(); at != missing.rend(); ++at) {
    TENON_CHECK(create_step(*at));
  }
  return {};
}

Result<void> LayerEditor::create_step(Path path) {
  if (path.is_variant_selection()) {
    return create_variant(path.parent(), path.name().str(), path.variant().str());
  }
  if (!is_identifier(path.name().view())) {
    return bad_name("prim", path.name().view(), "use letters, digits and '_', no digit in front");
  }
  add_child(path.parent(), fields::primChildren, path.name());
  add_spec(path, SpecKind::Prim).set(fields::specifier, layer::Specifier::Over);
  return {};
}

Result<void> LayerEditor::create_variant_set(Path prim, const std::string& set,
                                             ListPosition position) {
  if (!is_variant_name(set)) {
    return bad_name("variant set", set, "use letters, digits, '_', '-' and '|'");
  }
  const Token name(set);
  const Path path = prim.variant_selection(name, Token());
  if (!layer_->has(path)) {
    add_child(prim, fields::variantSetChildren, name);
    add_spec(path, SpecKind::VariantSet);
  }
  edit_list(prim, fields::variantSetNames, ListEdit<std::string>::add(set, position));
  return {};
}

Result<void> LayerEditor::create_variant(Path prim, const std::string& set,
                                         const std::string& variant) {
  if (!is_variant_name(variant)) {
    return bad_name("variant", variant, "use letters, digits, '_', '-' and '|'");
  }
  const Path set_path = prim.variant_selection(Token(set), Token());
  const Path path = prim.variant_selection(Token(set), Token(variant));
  if (!layer_->has(set_path)) {
    TENON_CHECK(create_variant_set(prim, set, ListPosition::FrontOfPrependList));
  }
  if (!layer_->has(path)) {
    add_child(set_path, fields::variantChildren, Token(variant));
    add_spec(path, SpecKind::Variant);
  }
  return {};
}

void LayerEditor::select_variant(Path prim, const std::string& set, const std::string& variant) {
  auto selections = get_or(prim, fields::variantSelection, layer::VariantSelections{});
  selections.items.insert_or_assign(set, variant);
  this->set(prim, fields::variantSelection, Value(std::move(selections)));
}

void LayerEditor::clear_selection(Path prim, const std::string& set) {
  auto selections = get_or(prim, fields::variantSelection, layer::VariantSelections{});
  selections.items.erase(set);
  selections.items.empty()
      ? erase(prim, fields::variantSelection)
      : this->set(prim, fields::variantSelection, Value(std::move(selections)));
}

/// Everything in the layer at and below `path`, in the order of making.
std::vector<Path> LayerEditor::subtree(Path path) const {
  std::vector<Path> found;
  for (const layer::Layer::Entry& entry : layer_->entries()) {
    if (!entry.path.empty() && entry.path.has_prefix(path)) {
      found.push_back(entry.path);
    }
  }
  return found;
}

Result<void> LayerEditor::remove_prim(Path path) {
  if (!path.is_prim_or_variant() || !layer_->has(path)) {
    return no_spec("prim", path, *layer_);
  }
  for (const Path below : subtree(path)) {
    erase_spec(below);
  }
  const Listing listing = listing_of(path);
  remove_child(listing.parent, listing.field, listing.name);
  return {};
}

Result<void> LayerEditor::move_prim(Path from, Path to) {
  if (!from.is_prim() || !layer_->has(from)) {
    return no_spec("prim", from, *layer_);
  }
  if (!is_identifier(to.name().view())) {
    return bad_name("prim", to.name().view(), "use letters, digits and '_', no digit in front");
  }
  if (layer_->has(to) || to.has_prefix(from) || !layer_->has(to.parent())) {
    return Error(ErrorCode::Invalid,
                 "<" + from.str() + "> cannot become " + named(to) + ": " +
                     (layer_->has(to) ? "a prim is there already"
                                      : "its parent is not there or moves along"))
        .in_file(layer_->identifier())
        .with_prim(from.str())
        .with_rule("edit.bad-move")
        .with_fix("choose another name or remove that prim");
  }
  for (const Path old : subtree(from)) {
    const Spec* there = layer_->find(old);
    if (there == nullptr) {
      continue;
    }
    Spec spec = *there;
    erase_spec(old);
    const SpecKind kind = spec.kind;
    add_spec(old.replace_prefix(from, to, false), kind) = std::move(spec);
  }
  if (from.parent() == to.parent()) {
    std::vector<Token> names = layer_->children(from.parent(), fields::primChildren);
    std::replace(names.begin(), names.end(), from.name(), to.name());
    set(from.parent(), fields::primChildren, Value(std::move(names)));
    return {};
  }
  remove_child(from.parent(), fields::primChildren, from.name());
  add_child(to.parent(), fields::primChildren, to.name());
  return {};
}

Result<void> LayerEditor::check_new_property(Path path) const {
  if (!path.parent().is_prim_or_variant()) {
    return Error(ErrorCode::Invalid, "the root of a scene has no properties")
        .with_rule("edit.bad-path")
        .with_fix("name a property of a prim, as in /World.size");
  }
  if (!is_namespaced_identifier(path.name().view())) {
    return bad_name("property", path.name().view(),
                    "use identifiers joined by ':', as in physics:mass");
  }
  return {};
}

Result<void> LayerEditor::create_attribute(Path path, Token type_name,
                                           layer::Variability variability, bool custom) {
  TENON_CHECK(check_new_property(path));
  if (layer::find_type_name(type_name) == nullptr) {
    return Error(ErrorCode::Invalid, "no attribute type is called \"" + type_name.str() + "\"")
        .with_prim(path.prim().str())
        .with_rule("edit.unknown-type")
        .with_fix("use a name such as float, double3, token[] or color3f");
  }
  add_child(path.parent(), fields::properties, path.name());
  Spec& spec = add_spec(path, SpecKind::Attribute);
  spec.set(fields::custom, custom);
  spec.set(fields::typeName, type_name);
  spec.set(fields::variability, variability);
  return {};
}

Result<void> LayerEditor::create_relationship(Path path, layer::Variability variability,
                                              bool custom) {
  TENON_CHECK(check_new_property(path));
  add_child(path.parent(), fields::properties, path.name());
  Spec& spec = add_spec(path, SpecKind::Relationship);
  spec.set(fields::variability, variability);
  if (custom) {
    spec.set(fields::custom, true);
  }
  return {};
}

Result<void> LayerEditor::remove_property(Path path) {
  if (!path.is_property() || !layer_->has(path)) {
    return no_spec("property", path, *layer_);
  }
  for (const Path below : subtree(path)) {
    erase_spec(below);
  }
  remove_child(path.parent(), fields::properties, path.name());
  return {};
}

Result<void> LayerEditor::rename_property(Path path, Token name) {
  if (!path.is_property() || !layer_->has(path)) {
    return no_spec("property", path, *layer_);
  }
  const Path to = path.parent().property(name);
  TENON_CHECK(check_new_property(to));
  if (layer_->has(to)) {
    return Error(ErrorCode::Invalid, "<" + path.str() + "> cannot become <" + to.str() +
                                         ">: a property is there already")
        .in_file(layer_->identifier())
        .with_prim(path.prim().str())
        .with_rule("edit.bad-move")
        .with_fix("choose another name or remove what is there");
  }
  for (const Path old : subtree(path)) {
    if (const Spec* there = layer_->find(old)) {
      Spec spec = *there;
      erase_spec(old);
      const SpecKind kind = spec.kind;
      add_spec(old.replace_prefix(path, to, false), kind) = std::move(spec);
    }
  }
  for (const Token field : {fields::properties, fields::propertyOrder}) {
    std::vector<Token> names = layer_->children(path.parent(), field);
    if (std::find(names.begin(), names.end(), path.name()) != names.end()) {
      std::replace(names.begin(), names.end(), path.name(), name);
      set(path.parent(), field, Value(std::move(names)));
    }
  }
  return {};
}

void LayerEditor::add_api(Path prim, Token name) {
  const auto op = get_or(prim, fields::apiSchemas, layer::ListOp<Token>{});
  const auto has = [&](const std::vector<Token>& names) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  if (!(op.is_explicit ? has(op.explicit_items) : has(op.prepended) || has(op.appended))) {
    edit_list(prim, fields::apiSchemas, ListEdit<Token>::add(name));
  }
}

void LayerEditor::remove_api(Path prim, Token name) {
  edit_list(prim, fields::apiSchemas, ListEdit<Token>::remove(name));
}

void LayerEditor::withdraw_api(Path prim, Token name) {
  edit_list(prim, fields::apiSchemas, ListEdit<Token>::withdraw(name));
}

void LayerEditor::set_time_sample(Path attribute, double time, Value value) {
  auto samples = get_or(attribute, fields::timeSamples, layer::TimeSamples{});
  samples.set(time, std::move(value));
  set(attribute, fields::timeSamples, Value(std::move(samples)));
}

void LayerEditor::erase_time_sample(Path attribute, double time) {
  auto samples = get_or(attribute, fields::timeSamples, layer::TimeSamples{});
  const auto it = std::find(samples.times.begin(), samples.times.end(), time);
  if (it == samples.times.end()) {
    return;
  }
  samples.values.erase(samples.values.begin() + (it - samples.times.begin()));
  samples.times.erase(it);
  samples.empty() ? erase(attribute, fields::timeSamples)
                  : set(attribute, fields::timeSamples, Value(std::move(samples)));
}

}  // namespace tenon::edit
