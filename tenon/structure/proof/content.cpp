// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The content is a normal form: stages that compose to the same thing compare equal, however their
// layers are arranged. Flattening takes out the arcs, instances are unfolded, prims that are off
// come back with their types alone, undefined overs go, and all comes below the default prim. What
// can be said in several ways is then said in one: lists of API schemas, declarations of vendors,
// order of fields. Nested instances may unfold to exponentially many specs, which are counted after
// each copy.
#include "tenon/structure/proof/content.h"

#include <algorithm>

#include "tenon/base/limits/limits.h"
#include "tenon/layer/fields.h"
#include "tenon/layer/time/time_samples.h"
#include "tenon/layer/type_names.h"
#include "tenon/schema/definition_cache.h"
#include "tenon/stage/flatten/flatten.h"
#include "tenon/structure/layer_tree.h"
#include "tenon/structure/written_note.h"

namespace tenon::structure {
namespace {

namespace fields = layer::fields;
using layer::Layer;
using layer::Spec;

/// The prototype that an instance of a flattened stage refers to; empty for other prims.
Path prototype_of(const Spec& prim) {
  const auto* op = prim.get<layer::ListOp<layer::Reference>>(fields::references);
  return op == nullptr || op->appended.empty() ? Path() : op->appended.front().prim_path;
}

/// Copies prototypes to where they are used. Instances within them come along and are met later.
Result<void> unfold_instances(Layer& flat) {
  std::vector<Path> prototypes;
  std::vector<Path> pending{Path::absolute_root()};
  while (!pending.empty()) {
    const Path path = pending.back();
    pending.pop_back();
    Spec* const instance = flat.find(path);
    const Path prototype = instance == nullptr ? Path() : prototype_of(*instance);
    if (!prototype.empty()) {
      instance->erase(fields::references);
      for (const Path& child : child_prims(flat, prototype)) {
        copy_tree(flat, child, flat, path.child(child.name()),
                  [&](Path at) { return at.replace_prefix(prototype, path); });
      }
      if (std::find(prototypes.begin(), prototypes.end(), prototype) == prototypes.end()) {
        prototypes.push_back(prototype);
      }
    }
    if (flat.spec_count() > limits::kStagePrims) {
      return Error(ErrorCode::Limit,
                   "the asset has too many prims when its instances are unfolded");
    }
    const std::vector<Path> children = child_prims(flat, path);
    pending.insert(pending.end(), children.rbegin(), children.rend());
  }
  for (const Path& prototype : prototypes) {
    remove_tree(flat, prototype);
  }
  return {};
}

/// Prims that are switched off are in no flattened stage.
void add_inactive(const stage::Stage& stage, Layer& flat) {
  std::vector<stage::Prim> pending{stage.pseudo_root()};
  while (!pending.empty()) {
    const stage::Prim prim = pending.back();
    pending.pop_back();
    std::vector<Token> names;
    for (const stage::Prim& child : prim.children()) {
      names.push_back(child.name());
      if (child.is_active()) {
        pending.push_back(child);
      } else {
        Spec& spec = make_prim(flat, child.path());
        spec.set(fields::specifier, child.specifier());
        if (!child.type_name().empty()) {
          spec.set(fields::typeName, child.type_name());
        }
        spec.set(fields::active, false);
      }
    }
    if (!names.empty()) {
      make_prim(flat, prim.path()).set(fields::primChildren, std::move(names));
    }
  }
}

void tidy_prim(Spec& prim) {
  prim.erase(fields::instanceable);
  prim.erase(fields::variantSelection);
  prim.erase(fields::variantSetNames);
  if (prim.get_or(fields::active, false)) {
    prim.erase(fields::active);
  }
  if (prim.get_or(fields::hidden, true) == false) {
    prim.erase(fields::hidden);
  }
}

/// Relationships that MaterialBindingAPI covers; its definition lists none of them, because their
/// names go on with purposes and collections.
bool is_material_binding(std::string_view name) {
  return name == "material:binding" || name.starts_with("material:binding:");
}

/// The default, else the first sample that is no block; null for none.
const layer::Value* some_value(const Spec& property) {
  if (const layer::Value* value = property.find(fields::default_value)) {
    return value;
  }
  const auto* samples = property.get<layer::TimeSamples>(fields::timeSamples);
  if (samples == nullptr) {
    return nullptr;
  }
  const auto found = std::find_if(samples->values.begin(), samples->values.end(),
                                  [](const layer::Value& value) { return !value.is_block(); });
  return found == samples->values.end() ? nullptr : &*found;
}

/// A value of another type than the schema's keeps the type that it was authored with: as text it
/// could not be read again otherwise. Names of types are the current ones: "float3" for "Vec3f".
void keep_type_of_value(Spec& property) {
  const layer::Value* value = some_value(property);
  const layer::TypeName* named = layer::find_type_name(property.get_or(fields::typeName, Token()));
  const layer::TypeName* own =
      value == nullptr ? nullptr : layer::type_name_of(value->type(), value->is_array());
  if (named != nullptr && own != nullptr &&
      (named->type != own->type || named->is_array != own->is_array)) {
    property.set(fields::typeName, own->name);
  } else if (named != nullptr && named->name != property.get_or(fields::typeName, Token())) {
    property.set(fields::typeName, named->name);
  }
}

/// As the schemas of vendors declare it, which stock OpenUSD does not know.
void tidy_property(Spec& property, const schema::PropertyDefinition* declared) {
  if (declared == nullptr) {
    return;
  }
  property.set(fields::custom, false);
  if (!declared->is_relationship && property.kind == layer::SpecKind::Attribute) {
    property.set(fields::variability, declared->variability);
  }
}

void tidy(Layer& content) {
  schema::DefinitionCache definitions;
  for (const Path& prim : prims_below(content)) {
    tidy_prim(*content.find(prim));
    if (content.find(prim)->has(fields::apiSchemas)) {
      set_apis(*content.find(prim), apis_of(content, prim));  // one form of several
    }
    const schema::PrimDefinition& definition =
        definitions.get(type_of(content, prim), apis_of(content, prim));
    for (const Path& property : properties_of(content, prim)) {
      Spec& spec = *content.find(property);
      tidy_property(spec, definition.find(property.name()));
      keep_type_of_value(spec);
      if (spec.kind == layer::SpecKind::Relationship && targets_of(spec).empty()) {
        spec.erase(fields::targetPaths);  // arcs do not tell an empty list from none
      }
      if (is_material_binding(property.name().view())) {
        spec.set(fields::custom, false);
      }
    }
  }
}

/// Fields in the order of their names: binary files keep the order in which a layer came by them.
void order_fields(Layer& content) {
  const auto by_name = [](const layer::Field& a, const layer::Field& b) {
    return a.name.view() < b.name.view();
  };
  for (const Layer::Entry& entry : content.entries()) {
    std::vector<layer::Field> fields(entry.spec.fields().begin(), entry.spec.fields().end());
    if (std::is_sorted(fields.begin(), fields.end(), by_name)) {
      continue;
    }
    std::sort(fields.begin(), fields.end(), by_name);
    layer::FieldList ordered;
    for (layer::Field& field : fields) {
      ordered.append(field.name, std::move(field.value));
    }
    if (Spec* spec = content.find(entry.path)) {
      spec->set_field_list(std::move(ordered));
    }
  }
}

/// Prims that point instancers repeat: often overs, so that they are drawn there alone.
std::vector<Path> prototypes_of_points(const Layer& content) {
  std::vector<Path> all;
  for (const Path& prim : prims_below(content)) {
    if (const Spec* prototypes = content.find(prim.property(Token("prototypes")))) {
      const std::vector<Path> targets = targets_of(*prototypes);
      all.insert(all.end(), targets.begin(), targets.end());
    }
  }
  return all;
}

/// Other prims that are overridden and defined nowhere act on nothing.
void drop_undefined(Layer& content, Path robot) {
  const std::vector<Path> prototypes = prototypes_of_points(content);
  const auto is_used = [&](Path prim) {
    return std::any_of(prototypes.begin(), prototypes.end(), [&](Path prototype) {
      return prototype.has_prefix(prim) || prim.has_prefix(prototype);
    });
  };
  for (const Path& prim : prims_below(content)) {
    const Spec* spec = content.find(prim);
    if (spec != nullptr && prim != robot && !is_used(prim) &&
        spec->get_or(fields::specifier, layer::Specifier::Over) == layer::Specifier::Over) {
      remove_tree(content, prim);
    }
  }
}

/// Where prims of the root beside the robot come: below it, under names that are free.
std::vector<std::pair<Path, Path>> places_below(const Layer& flat, Path top) {
  std::vector<std::pair<Path, Path>> places;
  std::vector<Path> taken = child_prims(flat, top);
  for (const Path& other : child_prims(flat, Path::absolute_root())) {
    if (other == top) {
      continue;
    }
    const Path to = free_child(top, other.name().str(), [&](Path path) {
      return std::find(taken.begin(), taken.end(), path) != taken.end();
    });
    taken.push_back(to);
    places.emplace_back(other, to);
  }
  return places;
}

/// The content with everything below the default prim.
Layer below_default_prim(Layer flat, Token robot, std::map<Path, Path>* moved) {
  const Path top = Path::absolute_root().child(robot);
  const std::vector<std::pair<Path, Path>> places = places_below(flat, top);
  if (places.empty()) {  // as it is already
    flat.root().erase(fields::subLayers);
    flat.root().set(fields::defaultPrim, robot);
    return flat;
  }
  if (moved != nullptr) {
    moved->insert(places.begin(), places.end());
  }
  const PathMap map = [&](Path path) {
    for (const auto& [from, to] : places) {
      if (path.has_prefix(from)) {
        return path.replace_prefix(from, to);
      }
    }
    return path;
  };
  Layer content = without_prims(flat, flat.identifier());
  remove_note(content);  // it is about the source's files
  content.root().erase(fields::subLayers);
  content.root().set(fields::defaultPrim, robot);
  copy_tree(flat, top, content, top, map);
  for (const auto& [from, to] : places) {
    copy_tree(flat, from, content, to, map);
  }
  return content;
}

/// A joint or a scene goes with the physics that it is a part of, and all below it would, too.
Error not_a_robot(const stage::Prim& prim, const Layer& root) {
  return Error(ErrorCode::Invalid, "the default prim is a " + prim.type_name().str() +
                                       ", which is physics itself and cannot hold an asset")
      .in_file(root.identifier())
      .with_prim(prim.path().str())
      .with_rule("stage.default-prim-missing")
      .with_fix("put it below an Xform, and name that as defaultPrim");
}

}  // namespace

Error no_default_prim(const Layer& root) {
  return Error(ErrorCode::NotFound, "the asset defines no default prim, which becomes the robot")
      .in_file(root.identifier())
      .with_rule("stage.default-prim-missing")
      .with_fix("author defaultPrim with the name of the root prim");
}

Result<Layer> content_of(const stage::Stage& stage, std::map<Path, Path>* moved) {
  const stage::Prim robot = stage.default_prim();
  if (!robot) {
    return no_default_prim(stage.root_layer());
  }
  const Role owner = owner_of_type(robot.type_name()).owner;
  if (owner == Role::Physics || is_engine(owner)) {
    return not_a_robot(robot, stage.root_layer());
  }
  Layer flat = stage::flatten(stage);
  TENON_CHECK(unfold_instances(flat));
  add_inactive(stage, flat);
  drop_undefined(flat, robot.path());
  Layer content = below_default_prim(std::move(flat), robot.name(), moved);
  tidy(content);
  order_fields(content);
  return content;
}

}  // namespace tenon::structure
