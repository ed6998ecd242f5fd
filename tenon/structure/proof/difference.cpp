// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A layer put over a weaker one can add and replace but not take back. What only `weak` has is
// therefore switched off, blocked or given an empty list of targets. Below a prim that is off
// nothing more has to be taken away. Properties omit fields that both have alike, but not their
// declaration, which every spec repeats. A metadata field of `weak` alone cannot be undone, and the
// proof of the package finds it.
#include <algorithm>

#include "tenon/layer/fields.h"
#include "tenon/layer/spec_equality.h"
#include "tenon/structure/layer_tree.h"
#include "tenon/structure/proof/content.h"

namespace tenon::structure {
namespace {

namespace fields = layer::fields;
using layer::Layer;
using layer::Spec;

bool contains(const std::vector<Token>& list, Token item) {
  return std::find(list.begin(), list.end(), item) != list.end();
}

bool says_something(const Spec& property) {
  return property.has(fields::default_value) || property.has(fields::timeSamples) ||
         property.has(fields::spline) || property.has(fields::targetPaths) ||
         property.has(fields::connectionPaths);
}

class Differ {
 public:
  Differ(const Layer& weak, const Layer& strong, std::string identifier)
      : weak_(weak), strong_(strong), over_(std::move(identifier)) {}

  Layer run() {
    for (const Path& prim : prims_below(strong_)) {
      if (!weak_.has(prim)) {
        copy_prim(prim);
      } else {
        compare_prims(prim);
      }
    }
    for (const Path& prim : prims_below(weak_)) {
      const bool above = prim.parent().is_absolute_root() || strong_.has(prim.parent());
      if (!strong_.has(prim) && above && is_active(weak_, prim) &&
          is_active(strong_, prim.parent())) {
        make_prim(over_, prim).set(fields::active, false);
      }
    }
    return std::move(over_);
  }

 private:
  void copy_prim(Path path) {
    Spec& prim = make_prim(over_, path);
    put_prim_fields(prim, *strong_.find(path));
    set_apis(prim, apis_of(strong_, path));
    for (const Path& property : properties_of(strong_, path)) {
      put_property(over_, property, *strong_.find(property));
    }
  }

  void compare_prims(Path path) {
    const Spec& weak = *weak_.find(path);
    const Spec& strong = *strong_.find(path);
    for (const layer::Field& field : strong.fields()) {
      compare_field(path, field, weak);
    }
    if (is_active(strong_, path) != is_active(weak_, path)) {
      make_prim(over_, path).set(fields::active, is_active(strong_, path));
    }
    if (!is_active(strong_, path)) {
      return;
    }
    compare_apis(path);
    for (const Path& property : properties_of(strong_, path)) {
      compare_property(property);
    }
    for (const Path& property : properties_of(weak_, path)) {
      if (!strong_.has(property) && says_something(*weak_.find(property))) {
        block(property);
      }
    }
  }

  void compare_field(Path path, const layer::Field& field, const Spec& weak) {
    const bool elsewhere = field.name == fields::primChildren || field.name == fields::properties ||
                           field.name == fields::apiSchemas || field.name == fields::active;
    const layer::Value* known = weak.find(field.name);
    if (elsewhere || (known != nullptr && *known == field.value)) {
      return;
    }
    if (field.name != fields::specifier ||
        field.value.get_or(layer::Specifier::Over) != layer::Specifier::Over) {
      make_prim(over_, path).set(field.name, field.value);
    }
  }

  void compare_apis(Path path) {
    const std::vector<Token> weak = apis_of(weak_, path);
    const std::vector<Token> strong = apis_of(strong_, path);
    layer::ListOp<Token> op;
    std::copy_if(strong.begin(), strong.end(), std::back_inserter(op.prepended),
                 [&](Token api) { return !contains(weak, api); });
    std::copy_if(weak.begin(), weak.end(), std::back_inserter(op.deleted),
                 [&](Token api) { return !contains(strong, api); });
    if (!op.empty()) {
      make_prim(over_, path).set(fields::apiSchemas, std::move(op));
    }
  }

  void compare_property(Path path) {
    const Spec& strong = *strong_.find(path);
    const Spec* weak = weak_.find(path);
    if (weak != nullptr && layer::same_spec(*weak, strong)) {
      return;
    }
    make_prim(over_, path.parent());
    Spec& spec = put_property(over_, path, strong);
    if (weak == nullptr || weak->kind != strong.kind) {
      return;
    }
    if (targets_of(*weak).empty()) {
      prepend_robot_lists(spec, path.name());
    }
    for (const layer::Field& field : weak->fields()) {
      const bool declares = field.name == fields::typeName || field.name == fields::custom ||
                            field.name == fields::variability;
      const layer::Value* same = spec.find(field.name);
      // A default also hides samples of the weaker layer that the stronger content does not have.
      const bool hides = field.name == fields::default_value &&
                         ((weak->has(fields::timeSamples) && !strong.has(fields::timeSamples)) ||
                          (weak->has(fields::spline) && !strong.has(fields::spline)));
      if (!declares && !hides && same != nullptr && *same == field.value) {
        spec.erase(field.name);
      }
    }
  }

  void block(Path path) {
    make_prim(over_, path.parent());
    Spec& spec = put_property(over_, path, *weak_.find(path));
    if (spec.kind == layer::SpecKind::Relationship) {
      set_targets(spec, {});
      return;
    }
    spec.erase(fields::timeSamples);
    spec.erase(fields::spline);
    spec.set(fields::default_value, layer::ValueBlock{});
    if (spec.has(fields::connectionPaths)) {
      set_targets(spec, {});
    }
  }

  const Layer& weak_;
  const Layer& strong_;
  Layer over_;
};

}  // namespace

Layer difference(const Layer& weak, const Layer& strong, std::string identifier) {
  return Differ(weak, strong, std::move(identifier)).run();
}

}  // namespace tenon::structure
