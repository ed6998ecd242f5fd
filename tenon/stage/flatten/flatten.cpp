// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Each prim is written once with what it composes to: metadata, defaults, samples in stage time.
// Prims below an instance exist once in its prototype, so a prototype is written as a prim of its
// own that its instances reference, and paths into it follow. Omissions, and the order of things,
// follow OpenUSD's flattening. Most attributes have one opinion that means the same anywhere: their
// specs share the authored list of fields instead of being composed field by field.
#include "tenon/stage/flatten/flatten.h"

#include <algorithm>
#include <set>
#include <unordered_map>

#include "tenon/layer/type_names.h"
#include "tenon/stage/composed_fields.h"
#include "tenon/stage/flatten/flat_values.h"
#include "tenon/stage/stage_data.h"
#include "tenon/stage/values/resolve_value.h"

namespace tenon::stage {
namespace {

using layer::Layer;
using layer::Spec;
using layer::SpecKind;
using layer::Value;
namespace fields = layer::fields;

/// Fields that no schema knows are skipped, as in OpenUSD.
void copy_field(Token name, const Value& value, Spec& spec) {
  if (!value.holds<layer::UnregisteredValue>()) {
    spec.set(name, value);
  }
}

bool is_custom(const Spec& spec) { return spec.get_or(fields::custom, false); }
layer::Variability variability_of(const Spec& spec) {
  return spec.get_or(fields::variability, layer::Variability::Varying);
}

bool agrees_with_schema(const Spec& spec, const schema::PropertyDefinition* declared) {
  const auto* type_name = spec.get<Token>(fields::typeName);
  if (type_name == nullptr) {
    return false;
  }
  return declared == nullptr
             ? layer::find_type_name(*type_name) != nullptr
             : declared->type_name == *type_name && !is_custom(spec) &&
                   declared->variability == variability_of(spec) && !declared->is_relationship;
}

bool stays_the_same(const Spec& spec) {
  for (const layer::Field& field : spec.fields()) {
    const auto* samples = field.value.get<layer::TimeSamples>();
    if (samples != nullptr && field.name == fields::timeSamples && !samples->empty()) {
      for (const Value& value : samples->values) {
        if (!value.is_block() && !means_same_anywhere(value)) {
          return false;
        }
      }
    } else if (!means_same_anywhere(field.value) ||
               (field.name != fields::default_value && is_structure(field.name))) {
      return false;
    }
  }
  return true;
}

/// The spec of an attribute's only opinion when flattening would repeat it field by field.
const Spec* spec_to_share(const PrimData& prim, Token name) {
  const Spec* found = nullptr;
  bool is_only = prim.clips() == nullptr;
  visit_property_opinions(prim, name, [&](const compose::Opinion& opinion) {
    is_only = is_only && found == nullptr && opinion.offset.is_identity();
    found = opinion.spec;
    return !is_only;
  });
  return is_only && found != nullptr && found->kind == SpecKind::Attribute &&
                 agrees_with_schema(*found, prim.definition->find_stock(name)) &&
                 stays_the_same(*found)
             ? found
             : nullptr;
}

/// Clips may give values to attributes that no layer of the stage names.
std::vector<Token> names_to_copy(const Prim& prim, const PrimData& data) {
  if (data.clips() == nullptr) {
    return prim.authored_property_names();
  }
  std::vector<Token> names = prim.property_names();
  const std::vector<Token>& authored = data.index->property_names.list();
  std::erase_if(names, [&](Token name) {
    return std::find(authored.begin(), authored.end(), name) == authored.end() &&
           (prim.is_relationship(name) || !prim.attribute(name).has_authored_value());
  });
  return names;
}

/// The weakest opinion decides, as in OpenUSD; what schemas declare is not custom.
bool is_custom(const PrimData& prim, Token name, const std::vector<SpecSite>& sites) {
  return prim.definition->find_stock(name) == nullptr && !sites.empty() &&
         sites.back().spec->get_or(fields::custom, false);
}

class Flattener {
 public:
  explicit Flattener(const Stage& stage) : stage_(stage), layer_("anon:flattened.usda") {
    std::size_t number = 0;
    for (const Prim& prototype : stage.prototypes()) {
      Path path;
      do {
        const std::string name = "Flattened_Prototype_" + std::to_string(++number);
        path = Path::absolute_root().child(Token(name));
      } while (stage.prim(path));
      prototype_paths_.emplace(prototype.path(), path);
    }
  }

  Layer run() {
    const StageData& data = stage_.data();
    visit_metadata(data, *data.root, root_opinions(data), AssetForm::Anchored,
                   [&](Token name, const Value& value) { copy_field(name, value, layer_.root()); });
    for (const Token arc : {fields::subLayers, fields::layerRelocates}) {
      layer_.root().erase(arc);
    }
    reserve();
    copy_below(stage_.pseudo_root(), Path::absolute_root());
    for (const Prim& prototype : stage_.prototypes()) {
      copy_prototype(prototype);
    }
    put_prototypes_first();
    if (stage_.may_lack_text()) {
      layer_.set_may_lack_text();
    }
    return std::move(layer_);
  }

 private:
  struct Copy {
    Prim prim;
    Path path;
  };

  /// Room for a spec of each prim.
  void reserve() { layer_.reserve(stage_.data().prims.size() + 1); }

  void copy_prototype(const Prim& prototype) {
    const Path path = prototype_paths_.at(prototype.path());
    Spec& spec = layer_.create(path, SpecKind::Prim);
    spec.set(fields::specifier, layer::Specifier::Over);
    add_child(Path::absolute_root(), fields::primChildren, path.name());
    copy_below(prototype, path);
  }

  // As OpenUSD orders them.
  void put_prototypes_first() {
    std::vector<Token> names = layer_.children(Path::absolute_root(), fields::primChildren);
    if (!names.empty()) {
      const auto count = static_cast<std::ptrdiff_t>(prototype_paths_.size());
      std::rotate(names.begin(), names.end() - count, names.end());
      layer_.root().set(fields::primChildren, std::move(names));
    }
  }

  void copy_below(const Prim& root, Path root_path) {
    std::vector<Copy> pending{{root, root_path}};
    while (!pending.empty()) {
      const Copy copy = pending.back();
      pending.pop_back();
      if (copy.path != root_path) {
        copy_prim(copy.prim, copy.path);
      }
      if (copy.prim.is_instance()) {
        continue;
      }
      std::vector<Prim> children = copy.prim.children();
      std::erase_if(children, [](const Prim& child) { return !child.is_active(); });
      std::vector<Token> names;
      for (auto child = children.rbegin(); child != children.rend(); ++child) {
        pending.push_back({*child, copy.path.child(child->name())});
      }
      for (const Prim& child : children) {
        names.push_back(child.name());
      }
      if (!names.empty()) {
        layer_.create(copy.path, SpecKind::Prim).set(fields::primChildren, std::move(names));
      }
    }
  }

  void add_child(Path parent, Token field, Token name) {
    Spec& spec = layer_.create(parent, SpecKind::Prim);
    std::vector<Token> names = Layer::children(spec, field);
    names.push_back(name);
    spec.set(field, std::move(names));
  }

  void copy_prim(const Prim& prim, Path path) {
    Spec& spec = layer_.create(path, SpecKind::Prim);
    spec.set(fields::specifier, prim.specifier());
    if (!prim.type_name().empty()) {
      spec.set(fields::typeName, prim.type_name());
    }
    const PrimData& data = *stage_.data().record(prim.path());
    copy_prim_metadata(data, spec);
    if (prim.is_instance()) {
      layer::Reference reference;
      reference.prim_path = prototype_paths_.at(prim.prototype().path());
      layer::ListOp<layer::Reference> references;
      references.appended.push_back(std::move(reference));
      spec.set(fields::references, std::move(references));
    }
    std::vector<Token> names;
    for (const Token name : names_to_copy(prim, data)) {
      if (copy_property(prim, data, path, name)) {
        names.push_back(name);
      }
    }
    if (!names.empty()) {
      spec.set(fields::properties, std::move(names));
    }
  }

  void copy_prim_metadata(const PrimData& data, Spec& spec) const {
    visit_metadata(stage_.data(), data, data.index->opinions(), AssetForm::Anchored,
                   [&](Token name, const Value& value) {
                     if (name != fields::specifier && name != fields::typeName) {
                       copy_field(name, value, spec);
                     }
                   });
  }

  // False for attributes of unknown types: they are skipped, as in OpenUSD.
  bool copy_property(const Prim& prim, const PrimData& data, Path owner, Token name) {
    if (const Spec* same = spec_to_share(data, name)) {
      layer_.create(owner.property(name), SpecKind::Attribute).set_field_list(complete(*same));
    } else if (prim.is_relationship(name)) {
      copy_relationship(data, prim.relationship(name), owner.property(name));
    } else if (const Attribute attribute = prim.attribute(name);
               layer::find_type_name(attribute.type_name()) != nullptr) {
      copy_attribute(data, attribute, owner.property(name));
    } else {
      return false;
    }
    return true;
  }

  /// The fields of an attribute with those that binary layers omit. Specs that share their fields
  /// share these, too.
  layer::FieldList complete(const Spec& spec) {
    if (spec.has(fields::custom) && spec.has(fields::variability)) {
      return spec.field_list();
    }
    layer::FieldList& completed = completed_[spec.field_list().id()];
    if (completed.items().empty()) {
      Spec whole = spec;
      whole.set(fields::custom, is_custom(spec));
      whole.set(fields::variability, variability_of(spec));
      completed = whole.field_list();
    }
    return completed;
  }

  // An empty list leaves no trace in what OpenUSD flattens.
  void copy_targets(Spec& spec, Token field, std::vector<Path> targets) {
    if (targets.empty()) {
      return;
    }
    for (Path& target : targets) {
      target = values_.moved(target);
    }
    spec.set(field, layer::ListOp<Path>::make_explicit(std::move(targets)));
  }

  void copy_metadata(const PrimData& prim, Token name, Spec& spec) {
    visit_metadata(stage_.data(), prim, property_opinions(prim, name), AssetForm::Anchored,
                   [&](Token field, const Value& value) {
                     if (field != fields::targetPaths && field != fields::connectionPaths) {
                       copy_field(field, value, spec);
                     }
                   });
  }

  void copy_relationship(const PrimData& prim, const Relationship& relationship, Path path) {
    Spec& spec = layer_.create(path, SpecKind::Relationship);
    copy_metadata(prim, relationship.name(), spec);
    spec.set(fields::custom, is_custom(prim, relationship.name(), relationship.spec_stack()));
    if (relationship.has_authored_targets()) {
      copy_targets(spec, fields::targetPaths, relationship.targets());
    }
  }

  void copy_attribute(const PrimData& prim, const Attribute& attribute, Path path) {
    Spec& spec = layer_.create(path, SpecKind::Attribute);
    copy_metadata(prim, attribute.name(), spec);
    spec.set(fields::typeName, attribute.type_name());
    spec.set(fields::custom, is_custom(prim, attribute.name(), attribute.spec_stack()));
    spec.set(fields::variability, attribute.variability());
    copy_values(prim, attribute, spec);
    if (attribute.has_authored_connections()) {
      copy_targets(spec, fields::connectionPaths, attribute.connections());
    }
  }

  /// A value of another type than the attribute's has no text there, and nor may the layer then.
  void note_type(const Value& value, const layer::TypeName* type) {
    const bool fits =
        value.empty() || value.is_block() ||
        (type != nullptr && value.type() == type->type && value.is_array() == type->is_array);
    if (!fits) {
      layer_.set_may_lack_text();
    }
  }

  void copy_values(const PrimData& prim, const Attribute& attribute, Spec& spec) {
    const Token name = attribute.name();
    const layer::TypeName* const type = layer::find_type_name(attribute.type_name());
    const ResolvedValue unanimated = resolve_value(prim, name, Asked::DefaultTime);
    if (unanimated.blocked) {
      spec.set(fields::default_value, layer::ValueBlock{});
    } else if (unanimated.source == ValueSource::Default) {
      Value value = values_.read(prim, name, unanimated, Time());
      note_type(value, type);
      spec.set(fields::default_value, std::move(value));
    }
    layer::TimeSamples samples = values_.samples(prim, attribute);
    for (const Value& value : samples.values) {
      note_type(value, type);
    }
    if (!samples.empty()) {
      spec.set(fields::timeSamples, std::move(samples));
    }
    if (const std::optional<layer::Spline> spline = attribute.spline()) {
      spec.set(fields::spline, *spline);
    }
  }

  const Stage& stage_;
  Layer layer_;
  PathMap prototype_paths_;
  FlatValues values_{stage_.data(), prototype_paths_};
  std::unordered_map<const void*, layer::FieldList> completed_;  // by authored fields
};

}  // namespace

layer::Layer flatten(const Stage& stage) { return Flattener(stage).run(); }

}  // namespace tenon::stage
