// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/structure/make/interface_layer.h"

#include <cctype>

#include "tenon/layer/fields.h"
#include "tenon/structure/layer_tree.h"
#include "tenon/structure/layout.h"

namespace tenon::structure {
namespace {

namespace fields = layer::fields;
using layer::Layer;
using layer::Spec;
using layer::SpecKind;

void append_name(Spec& spec, Token field, Token name) {
  std::vector<Token> names = Layer::children(spec, field);
  names.push_back(name);
  spec.set(field, std::move(names));
}

void add_variant(Layer& layer, Path robot, const InterfaceVariant& variant) {
  const Token set(variant.set);
  const Path set_path = robot.variant_selection(set, Token());
  if (!layer.has(set_path)) {
    append_name(make_prim(layer, robot), fields::variantSetChildren, set);
  }
  append_name(layer.create(set_path, SpecKind::VariantSet), fields::variantChildren,
              Token(variant.variant));
  Spec& spec =
      layer.create(robot.variant_selection(set, Token(variant.variant)), SpecKind::Variant);
  spec.set(fields::specifier, layer::Specifier::Over);
  if (!variant.file.empty()) {
    layer::Payload payload;
    payload.asset_path = "./" + variant.file;
    spec.set(fields::payload, layer::ListOp<layer::Payload>::make_prepended({payload}));
  }
}

}  // namespace

Layer interface_layer(const Layer& content, const InterfaceParts& parts, std::string identifier) {
  Layer layer = without_prims(content, std::move(identifier));
  const Path robot = Path::absolute_root().child(parts.robot);
  Spec& prim = define_prim(layer, robot, type_of(content, robot));
  layer::Reference base;
  base.asset_path = "./" + parts.base;
  prim.set(fields::references, layer::ListOp<layer::Reference>::make_prepended({base}));
  layer::VariantSelections selections;
  layer::ListOp<std::string> sets;
  const auto add = [&](const InterfaceVariant& variant) {
    if (sets.appended.empty() || sets.appended.back() != variant.set) {
      sets.appended.push_back(variant.set);
    }
    add_variant(layer, robot, variant);
  };
  for (const InterfaceVariant& variant : parts.runtimes) {
    add(variant);
  }
  for (const InterfaceVariant& variant : parts.physics) {
    add(variant);
  }
  for (const InterfaceVariant& variant : parts.others) {
    add(variant);
  }
  for (const auto& [set, variant] : parts.selections) {
    if (!variant.empty()) {
      selections.items[set] = variant;
    }
  }
  prim.set(fields::variantSetNames, std::move(sets));
  prim.set(fields::variantSelection, std::move(selections));
  return layer;
}

void put_stage_metadata(const Layer& content, Layer& file, bool of_robot) {
  for (const Token field :
       {fields::endTimeCode, fields::framesPerSecond, fields::kilogramsPerUnit,
        fields::metersPerUnit, fields::startTimeCode, fields::timeCodesPerSecond, fields::upAxis}) {
    if (const layer::Value* value = content.root().find(field)) {
      file.root().set(field, *value);
    }
  }
  if (of_robot) {
    file.root().set(fields::defaultPrim, content.default_prim());
  }
}

std::string file_of_variant(const std::string& set, const std::string& variant) {
  std::string name = variant;
  for (char& c : name) {
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return "payloads/" + set + "/" + name + ".usda";
}

}  // namespace tenon::structure
