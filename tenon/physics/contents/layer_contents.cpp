// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Layers have many specs and few names of properties, which are hardly ever judged twice. A scene
// without physics, however large, is not asked prim by prim for what it may have meant.
#include <array>
#include <functional>
#include <utility>

#include "tenon/layer/fields.h"
#include "tenon/physics/attribute_values.h"

namespace tenon::physics {
namespace {

class ContentsReader {
 public:
  /// Looks at a spec; false once there is nothing more to find out.
  bool take(const layer::Layer::Entry& entry) {
    const layer::Spec& spec = entry.spec;
    if (spec.kind == layer::SpecKind::Attribute) {
      contents.animated = contents.animated || is_animated(spec);
    } else if (spec.kind == layer::SpecKind::Prim) {
      contents.animated = contents.animated || spec.has(layer::fields::clips);
      return !(contents.animated && contents.names_apis);
    }
    if (!contents.names_apis && entry.path.is_property()) {
      contents.names_apis = !was_judged(entry.path.name()) && names_physics(entry.path.name());
    }
    return !(contents.animated && contents.names_apis);
  }

  LayerContents contents;

 private:
  static bool is_animated(const layer::Spec& spec) {
    for (const layer::Field& field : spec.fields()) {
      if (field.name == layer::fields::timeSamples || field.name == layer::fields::spline) {
        return true;
      }
    }
    return false;
  }

  /// Lately: names that were met before that are judged again.
  bool was_judged(Token name) {
    Token& last = recent_[std::hash<Token>()(name) >> 16U & (kRecent - 1)];
    return std::exchange(last, name) == name;
  }

  static constexpr std::size_t kRecent = 64;
  std::array<Token, kRecent> recent_;
};

}  // namespace

LayerContents layer_contents(const stage::Stage& stage) {
  ContentsReader reader;
  for (const layer::LayerPtr& layer : stage.used_layers()) {
    for (const layer::Layer::Entry& entry : layer->entries()) {
      if (!reader.take(entry)) {
        return reader.contents;
      }
    }
  }
  return reader.contents;
}

}  // namespace tenon::physics
