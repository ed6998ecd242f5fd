// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A layer keeps its specs by path, and its tree is in the lists of children alone. These functions
// change both, and a name in a list without a spec is skipped. Prims in variants are in the list of
// their variant, which no walk looks at. Walks keep their own stack, so that the depth of a layer
// costs no call frames. A child's name is appended to the list in place: the list is first taken
// out of the fields that hold it, because a copy for each child would cost the square of their
// number.
#include "tenon/structure/layer_tree.h"

#include <algorithm>
#include <utility>

#include "tenon/layer/child_lists.h"
#include "tenon/layer/expressions/path_expression.h"
#include "tenon/layer/fields.h"

namespace tenon::structure {
namespace {

namespace fields = layer::fields;
using layer::Layer;
using layer::Spec;

void add_name(Layer& layer, Path parent, Token field, Token name) {
  Spec& spec = layer.create(parent, layer::SpecKind::Prim);
  if (!spec.has(field)) {
    spec.set(field, std::vector<Token>{name});
    return;
  }
  layer::FieldList fields = spec.field_list();
  spec.set_field_list({});
  for (layer::Field& list : fields.own_items()) {
    if (list.name == field && list.value.holds<std::vector<Token>>()) {
      auto names = list.value.take<std::vector<Token>>();
      names.push_back(name);
      list.value = std::move(names);
    }
  }
  spec.set_field_list(std::move(fields));
}

void remove_name(Layer& layer, Path parent, Token field, Token name) {
  if (Spec* spec = layer.find(parent)) {
    std::vector<Token> names = Layer::children(*spec, field);
    std::erase(names, name);
    names.empty() ? spec->erase(field) : spec->set(field, std::move(names));
  }
}

layer::ListOp<Path> mapped(layer::ListOp<Path> op, const PathMap& map) {
  for (auto* items : {&op.explicit_items, &op.prepended, &op.appended, &op.deleted, &op.added}) {
    for (Path& path : *items) {
      path = map(path);
    }
  }
  return op;
}

}  // namespace

std::vector<Path> child_prims(const Layer& layer, Path prim) {
  std::vector<Path> found;
  for (const Token name : layer.children(prim, fields::primChildren)) {
    if (const Path child = prim.child(name); layer.has(child)) {
      found.push_back(child);
    }
  }
  return found;
}

Path free_child(Path parent, const std::string& name, const std::function<bool(Path)>& is_taken) {
  Path path = parent.child(Token(name));
  for (int i = 1; is_taken(path); ++i) {
    path = parent.child(Token(name + "_" + std::to_string(i)));
  }
  return path;
}

std::vector<Path> properties_of(const Layer& layer, Path prim) {
  std::vector<Path> found;
  for (const Token name : layer.children(prim, fields::properties)) {
    if (const Path property = prim.property(name); layer.has(property)) {
      found.push_back(property);
    }
  }
  return found;
}

std::vector<Path> prims_below(const Layer& layer, Path root) {
  std::vector<Path> found;
  std::vector<Path> pending;
  if (layer.has(root)) {
    pending.push_back(root);
  }
  while (!pending.empty()) {
    const Path path = pending.back();
    pending.pop_back();
    if (!path.is_absolute_root()) {
      found.push_back(path);
    }
    const std::vector<Path> children = child_prims(layer, path);
    pending.insert(pending.end(), children.rbegin(), children.rend());
  }
  return found;
}

Spec& make_prim(Layer& layer, Path path) {
  std::vector<Path> missing;
  for (Path at = path; !at.empty() && !layer.has(at); at = at.parent()) {
    missing.push_back(at);
  }
  for (; !missing.empty(); missing.pop_back()) {
    const Path at = missing.back();
    layer.create(at, layer::SpecKind::Prim).set(fields::specifier, layer::Specifier::Over);
    add_name(layer, at.parent(), fields::primChildren, at.name());
  }
  return layer.create(path, layer::SpecKind::Prim);
}

Spec& define_prim(Layer& layer, Path path, Token type) {
  Spec& spec = make_prim(layer, path);
  spec.set(fields::specifier, layer::Specifier::Def);
  spec.set(fields::typeName, type);
  return spec;
}

Layer without_prims(const Layer& layer, std::string identifier) {
  Layer result(std::move(identifier));
  for (const layer::Field& field : layer.root().fields()) {
    if (field.name != fields::primChildren) {
      result.root().set(field.name, field.value);
    }
  }
  return result;
}

bool is_transform(Token property) { return property.view().starts_with("xformOp"); }

Spec& put_property(Layer& layer, Path path, const Spec& from, const PathMap& map) {
  if (!layer.has(path)) {
    add_name(layer, path.parent(), fields::properties, path.name());
  }
  Spec& spec = layer.create(path, from.kind);
  spec.set_field_list(from.field_list());
  for (const Token field : {fields::targetPaths, fields::connectionPaths}) {
    const auto* op = map ? from.get<layer::ListOp<Path>>(field) : nullptr;
    if (op != nullptr) {
      spec.set(field, mapped(*op, map));
    }
  }
  const layer::Value* const value = map ? from.find(fields::default_value) : nullptr;
  layer::Value moved = value == nullptr ? layer::Value() : *value;
  if (layer::map_paths(moved, path.parent(), map)) {  // path expressions
    spec.set(fields::default_value, std::move(moved));
  }
  return spec;
}

void put_prim_fields(Spec& to, const Spec& from) {
  for (const layer::Field& field : from.fields()) {
    if (!layer::is_child_list(field.name)) {
      to.set(field.name, field.value);
    }
  }
}

void remove_property(Layer& layer, Path property) {
  layer.erase(property);
  remove_name(layer, property.parent(), fields::properties, property.name());
}

void remove_tree(Layer& layer, Path prim) {
  for (const Path& path : prims_below(layer, prim)) {
    for (const Path& property : properties_of(layer, path)) {
      layer.erase(property);
    }
    layer.erase(path);
  }
  remove_name(layer, prim.parent(), fields::primChildren, prim.name());
}

void copy_tree(const Layer& source, Path from, Layer& target, Path to, const PathMap& map) {
  const PathMap below = [&](Path path) { return path.replace_prefix(from, to); };
  for (const Path& path : prims_below(source, from)) {
    const Path copy = path.replace_prefix(from, to);
    put_prim_fields(make_prim(target, copy), *source.find(path));
    for (const Path& property : properties_of(source, path)) {
      put_property(target, copy.property(property.name()), *source.find(property),
                   map ? map : below);
    }
  }
}

void place_child_like(Layer& layer, Path child, const Layer& like) {
  const Path parent = child.parent();
  const std::vector<Token>& order = like.children(parent, fields::primChildren);
  std::vector<Token> names = layer.children(parent, fields::primChildren);
  std::erase(names, child.name());
  // After the nearest of those before it that both have; in front when there is none.
  auto place = names.begin();
  auto at = std::find(order.begin(), order.end(), child.name());
  while (at != order.begin() && at != order.end()) {
    --at;
    const auto before = std::find(names.begin(), names.end(), *at);
    if (before != names.end()) {
      place = before + 1;
      break;
    }
  }
  names.insert(place, child.name());
  make_prim(layer, parent).set(fields::primChildren, std::move(names));
}

Token type_of(const Layer& layer, Path prim) {
  const Spec* spec = layer.find(prim);
  return spec == nullptr ? Token() : spec->get_or(fields::typeName, Token());
}

std::vector<Token> apis_of(const Layer& layer, Path prim) {
  std::vector<Token> apis;
  const Spec* spec = layer.find(prim);
  const auto* op = spec == nullptr ? nullptr : spec->get<layer::ListOp<Token>>(fields::apiSchemas);
  if (op != nullptr) {
    op->apply_to(apis);
  }
  return apis;
}

void set_apis(Spec& prim, std::vector<Token> apis) {
  if (apis.empty()) {
    prim.erase(fields::apiSchemas);
  } else {
    prim.set(fields::apiSchemas, layer::ListOp<Token>::make_prepended(std::move(apis)));
  }
}

bool has_api(const Layer& layer, Path prim, std::string_view api) {
  const std::vector<Token> apis = apis_of(layer, prim);
  return std::any_of(apis.begin(), apis.end(), [&](Token name) { return name == api; });
}

void add_api(Layer& layer, Path prim, Token api) {
  if (!has_api(layer, prim, api.view())) {
    std::vector<Token> apis = apis_of(layer, prim);
    apis.push_back(api);
    set_apis(make_prim(layer, prim), std::move(apis));
  }
}

bool is_active(const Layer& layer, Path prim) {
  const Spec* spec = layer.find(prim);
  return spec != nullptr && spec->get_or(fields::active, true);
}

std::vector<Path> targets_of(const Spec& property) {
  std::vector<Path> targets;
  for (const Token field : {fields::targetPaths, fields::connectionPaths}) {
    if (const auto* op = property.get<layer::ListOp<Path>>(field)) {
      op->apply_to(targets);
    }
  }
  return targets;
}

void set_targets(Spec& property, std::vector<Path> targets) {
  const bool connection = property.kind == layer::SpecKind::Attribute;
  property.set(connection ? fields::connectionPaths : fields::targetPaths,
               layer::ListOp<Path>::make_explicit(std::move(targets)));
}

void prepend_robot_lists(Spec& property, Token name) {
  std::vector<Path> targets = targets_of(property);
  if (property.kind == layer::SpecKind::Relationship && !targets.empty() &&
      name.view().starts_with("isaac:")) {
    property.set(fields::targetPaths, layer::ListOp<Path>::make_prepended(std::move(targets)));
  }
}

}  // namespace tenon::structure
