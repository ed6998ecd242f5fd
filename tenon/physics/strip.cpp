// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Names decide what is physics. API schemas and properties are recognized by prefixes, so what a
// known vendor adds later is found as well. A prim type also has to be in the schema registry.
// Properties and API schemas go first. Then prims are judged from the deepest up, so that a parent
// is judged when its remaining children are known. A prim of a physics type goes when it has no
// children, else it loses its type. An over goes only when the removal itself emptied it.
#include "tenon/physics/strip.h"

#include <algorithm>
#include <unordered_map>
#include <vector>

#include "tenon/layer/fields.h"
#include "tenon/schema/registry.h"

namespace tenon::physics {
namespace {

using layer::SpecKind;

constexpr std::string_view kSchemaPrefixes[] = {
    "Physics", "Physx", "OmniPhysics", "Newton", "Mjc", "IsaacContactSensor", "IsaacImuSensor"};
constexpr std::string_view kPropertyPrefixes[] = {
    "physics:", "physx", "newton:", "mjc:", "omniphysics:", "isaac:physics:", "tenon:sensor"};
/// Metadata of layers that nothing but physics reads (S-8).
constexpr const char* kMassUnit = "kilogramsPerUnit";
/// Multiple-apply schemas: "drive:angular:physics:stiffness".
constexpr std::string_view kInstancePrefixes[] = {"drive:", "limit:", "state:"};
constexpr std::string_view kBinding = "material:binding:physics";
constexpr std::string_view kCollectionBinding = "material:binding:collection:physics:";

template <std::size_t count>
bool starts_with_any(std::string_view name, const std::string_view (&prefixes)[count]) {
  return std::any_of(std::begin(prefixes), std::end(prefixes),
                     [&](std::string_view prefix) { return name.starts_with(prefix); });
}

bool is_physics_type(Token type) {
  const schema::Schema* schema = schema::Registry::instance().find(type);
  return schema != nullptr && schema->kind == schema::SchemaKind::ConcreteTyped &&
         is_physics_schema(type.view());
}

class Stripper {
 public:
  explicit Stripper(layer::Layer& layer) : layer_(layer) {}

  StripCounts run() {
    std::vector<Path> prims;
    std::vector<Path> properties;
    for (const layer::Layer::Entry& entry : layer_.entries()) {
      const SpecKind kind = entry.spec.kind;
      if (kind == SpecKind::Prim || kind == SpecKind::Variant) {
        prims.push_back(entry.path);
      } else if (kind == SpecKind::Attribute || kind == SpecKind::Relationship) {
        if (is_physics_property(entry.path.name().view())) {
          properties.push_back(entry.path);
        }
      } else if (entry.path.is_property() == false && entry.spec.kind != SpecKind::PseudoRoot) {
        targets_.push_back(entry.path);  // specs of single targets and connections
      }
    }
    if (layer_.root().find(Token(kMassUnit)) != nullptr) {
      layer_.root().erase(Token(kMassUnit));
      ++counts_.metadata;
    }
    remove_properties(properties);
    for (const Path& prim : prims) {
      strip_schemas(prim);
    }
    std::stable_sort(prims.begin(), prims.end(), [](const Path& a, const Path& b) {
      return a.prefixes().size() > b.prefixes().size();
    });
    for (const Path& prim : prims) {
      judge_prim(prim);
    }
    return counts_;
  }

 private:
  void unlist(Path parent, Token field, Token name) {
    layer::Spec* spec = layer_.find(parent);
    if (spec == nullptr) {
      return;
    }
    auto names = spec->get_or(field, std::vector<Token>{});
    if (std::erase(names, name) > 0) {
      names.empty() ? spec->erase(field) : spec->set(field, layer::Value(std::move(names)));
    }
    changed_[parent] = true;
  }

  void remove_properties(const std::vector<Path>& properties) {
    for (const Path& path : properties) {
      unlist(path.parent(), layer::fields::properties, path.name());
      layer_.erase(path);
      ++counts_.properties;
    }
    for (const Path& path : targets_) {
      Path owner = path;
      while (!owner.empty() && !owner.is_property()) {
        owner = owner.parent();
      }
      if (!owner.empty() && is_physics_property(owner.name().view())) {
        layer_.erase(path);
      }
    }
  }

  void strip_schemas(Path prim) {
    layer::Spec* const found = layer_.find(prim);
    static const Token kField("apiSchemas");
    if (found == nullptr || found->find(kField) == nullptr) {
      return;
    }
    layer::Spec& spec = *found;
    auto op = spec.get_or(kField, layer::ListOp<Token>{});
    std::size_t removed = 0;
    for (std::vector<Token>* list :
         {&op.explicit_items, &op.prepended, &op.appended, &op.deleted, &op.added, &op.ordered}) {
      removed +=
          std::erase_if(*list, [](const Token& name) { return is_physics_schema(name.view()); });
    }
    if (removed == 0) {
      return;
    }
    counts_.api_schemas += removed;
    changed_[prim] = true;
    // A list that held nothing but physics says nothing any more.
    const bool nothing = op.is_explicit ? op.explicit_items.empty() : op.empty();
    nothing ? spec.erase(kField) : spec.set(kField, layer::Value(std::move(op)));
  }

  /// Removes prims of physics types and overs that became empty.
  void judge_prim(Path path) {
    layer::Spec* spec = layer_.find(path);
    if (spec == nullptr || spec->kind != SpecKind::Prim) {
      return;
    }
    const bool childless = layer::Layer::children(*spec, layer::fields::primChildren).empty() &&
                           layer::Layer::children(*spec, Token("variantSetChildren")).empty();
    const Token type = spec->get_or(layer::fields::typeName, Token());
    if (is_physics_type(type)) {
      childless ? remove_prim(path) : forget_type(path, *spec);
      return;
    }
    if (!changed_.contains(path) || !childless) {
      return;
    }
    const auto fields = spec->fields();
    const bool empty =
        spec->get_or(layer::fields::specifier, layer::Specifier::Over) == layer::Specifier::Over &&
        std::all_of(fields.begin(), fields.end(), [](const layer::Field& field) {
          return field.name == layer::fields::specifier;
        });
    if (empty) {
      unlist(path.parent(), layer::fields::primChildren, path.name());
      layer_.erase(path);
    }
  }

  void forget_type(Path path, layer::Spec& spec) {
    spec.erase(layer::fields::typeName);
    changed_[path] = true;
    ++counts_.prims;
  }

  void remove_prim(Path path) {
    for (const Token& name : std::vector<Token>(layer_.children(path, layer::fields::properties))) {
      const Path property = path.property(name);
      layer_.erase(property);
      for (const Path& target : targets_) {
        if (target.has_prefix(property)) {
          layer_.erase(target);
        }
      }
    }
    unlist(path.parent(), layer::fields::primChildren, path.name());
    layer_.erase(path);
    ++counts_.prims;
  }

  layer::Layer& layer_;
  std::vector<Path> targets_;
  std::unordered_map<Path, bool> changed_;
  StripCounts counts_;
};

}  // namespace

bool is_physics_schema(std::string_view name) { return starts_with_any(name, kSchemaPrefixes); }

bool is_physics_property(std::string_view name) {
  if (starts_with_any(name, kPropertyPrefixes) || name == kBinding ||
      name.starts_with(kCollectionBinding)) {
    return true;
  }
  return starts_with_any(name, kInstancePrefixes) && name.find(":physics:") != name.npos;
}

StripCounts strip_physics(layer::Layer& layer) { return Stripper(layer).run(); }

}  // namespace tenon::physics
