// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// By option each layer means its own units (S-11). Such layers are rewritten in the units of the
// stage, and the stage is composed again from them, so that nothing else has to know. A number that
// measures length^a mass^b is multiplied by the ratios of the units to these powers; seconds and
// degrees are the same everywhere. The name of an attribute tells a and b, for some with the type
// of the prim or of the drive, which layers say together. So prims are found by where their
// opinions stand. Numbers that mean "unlimited" stay.
#include "tenon/physics/layer_units.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "tenon/layer/time/spline.h"
#include "tenon/layer/time/time_samples.h"
#include "tenon/physics/attribute_values.h"
#include "tenon/physics/units.h"
#include "tenon/stage/stage_units.h"

namespace tenon::physics {
namespace {

constexpr double kSameUnit = 1e-5;  // S-8

constexpr Dimension kLength{1, 0};
constexpr Dimension kMass{0, 1};
constexpr Dimension kForce{1, 1};   // M L / T^2
constexpr Dimension kTorque{2, 1};  // M L^2 / T^2, also of moments of inertia

struct NamedDimension {
  std::string_view name;
  Dimension dimension;
};
/// Sorted by name.
constexpr NamedDimension kNamed[] = {
    {"accelerations", kLength},
    {"extent", kLength},
    {"height", kLength},
    {"length", kLength},
    {"physics:breakForce", kForce},
    {"physics:breakTorque", kTorque},
    {"physics:centerOfMass", kLength},
    {"physics:density", {-3, 1}},
    {"physics:diagonalInertia", kTorque},
    {"physics:gravityMagnitude", kLength},
    {"physics:localPos0", kLength},
    {"physics:localPos1", kLength},
    {"physics:mass", kMass},
    {"physics:maxDistance", kLength},
    {"physics:minDistance", kLength},
    {"physics:velocity", kLength},
    {"physxCollision:contactOffset", kLength},
    {"physxCollision:restOffset", kLength},
    {"points", kLength},
    {"positions", kLength},
    {"primvars:widths", kLength},
    {"radius", kLength},
    {"radiusBottom", kLength},
    {"radiusTop", kLength},
    {"size", kLength},
    {"velocities", kLength},
    {"width", kLength},
    {"widths", kLength},
};

static_assert(std::is_sorted(std::begin(kNamed), std::end(kNamed),
                             [](const NamedDimension& a, const NamedDimension& b) {
                               return a.name < b.name;
                             }));

/// The instance measures distances: "transX", "linear", "distance", not "rotX" or "angular".
bool is_linear(std::string_view instance) {
  return instance.starts_with("trans") || instance == "linear" || instance == "distance";
}

Dimension drive_dimension(std::string_view quantity, bool linear, bool acceleration) {
  if (quantity == "targetPosition" || quantity == "targetVelocity") {
    return linear ? kLength : Dimension();
  }
  if (quantity == "maxForce") {
    return linear ? kForce : kTorque;
  }
  if (acceleration || (quantity != "stiffness" && quantity != "damping")) {
    return {};  // per unit of inertia
  }
  return linear ? kMass : kTorque;
}

/// "drive:transX:physics:stiffness" and the like, of APIs with instances.
Dimension instance_dimension(std::string_view name, bool acceleration) {
  const std::size_t first = name.find(':');
  const std::size_t second = first == name.npos ? name.npos : name.find(":physics:", first + 1);
  if (second == name.npos) {
    return {};
  }
  const std::string_view api = name.substr(0, first);
  const bool linear = is_linear(name.substr(first + 1, second - first - 1));
  const std::string_view quantity = name.substr(second + 9);
  if (api == "drive") {
    return drive_dimension(quantity, linear, acceleration);
  }
  const bool measured = (api == "limit" && (quantity == "low" || quantity == "high")) ||
                        (api == "state" && (quantity == "position" || quantity == "velocity"));
  return measured && linear ? kLength : Dimension();
}

template <class T>
T scaled_number(T number, double factor) {
  const double value = static_cast<double>(number);
  return is_sentinel(value) ? number : static_cast<T>(static_cast<float>(value * factor));
}
double scaled_number(double number, double factor) {
  return is_sentinel(number) ? number : number * factor;
}

template <class T>
T scaled_element(T element, double factor) {
  if constexpr (std::is_same_v<T, Mat4d>) {
    for (std::size_t i = 0; i < 3; ++i) {
      element[3][i] *= factor;
    }
  } else if constexpr (requires { element.v; }) {
    for (auto& component : element.v) {
      component = scaled_number(component, factor);
    }
  } else {
    element = scaled_number(element, factor);
  }
  return element;
}

/// True when the value holds a T or an array of them, which is scaled then.
template <class T>
bool scale_as(layer::Value& value, double factor) {
  if (const T* one = value.get<T>()) {
    value = layer::Value(scaled_element(*one, factor));
    return true;
  }
  if (const auto* array = value.get<layer::Array<T>>()) {
    std::vector<T> elements(array->begin(), array->end());
    for (T& element : elements) {
      element = scaled_element(element, factor);
    }
    value = layer::Value(std::move(elements));
    return true;
  }
  return false;
}

layer::Spline scaled_spline(layer::Spline spline, double factor) {
  for (layer::SplineKnot& knot : spline.knots) {
    knot.value *= factor;
    knot.pre_tangent.slope *= factor;
    knot.post_tangent.slope *= factor;
    if (knot.pre_value) {
      *knot.pre_value *= factor;
    }
  }
  spline.pre.slope *= factor;
  spline.post.slope *= factor;
  if (spline.loop) {
    spline.loop->value_offset *= factor;
  }
  return spline;
}

double authored_unit(const layer::Layer& layer, const char* field, double otherwise) {
  const layer::Value* value = layer.root().find(Token(field));
  const double authored = value == nullptr ? otherwise : number_of(*value).value_or(otherwise);
  return std::isfinite(authored) && authored > 0 ? authored : otherwise;
}

/// Prims of the stage by where their opinions stand: types come from all layers together. Instances
/// of one prototype are walked into once.
class PrimsOfSpecs {
 public:
  explicit PrimsOfSpecs(const stage::Stage& stage) {
    std::vector<stage::Prim> pending = stage.pseudo_root().children();
    std::set<Path> prototypes;
    while (!pending.empty()) {
      const stage::Prim prim = pending.back();
      pending.pop_back();
      for (const stage::SpecSite& site : prim.spec_stack()) {
        prims_[site.layer].try_emplace(site.path, prim);
      }
      if (!prim.is_instance() || prototypes.insert(prim.prototype().path()).second) {
        const std::vector<stage::Prim> children = prim.children();
        pending.insert(pending.end(), children.begin(), children.end());
      }
    }
  }

  /// The invalid prim where no prim takes opinions from there.
  stage::Prim find(const layer::Layer& layer, Path spec) const {
    const auto known = prims_.find(&layer);
    if (known == prims_.end()) {
      return {};
    }
    const auto prim = known->second.find(spec);
    return prim == known->second.end() ? stage::Prim() : prim->second;
  }

 private:
  std::unordered_map<const layer::Layer*, std::unordered_map<Path, stage::Prim>> prims_;
};

/// Some opinion says that the drive which the attribute belongs to gives accelerations.
bool is_acceleration(const stage::Prim& prim, std::string_view attribute) {
  const std::size_t end = attribute.find(":physics:");
  if (!prim.is_valid() || !attribute.starts_with("drive:") || end == attribute.npos) {
    return false;
  }
  const Token type(std::string(attribute.substr(0, end)) + ":physics:type");
  return prim.attribute(type).get_as<Token>() == Token("acceleration");
}

class LayerConversion {
 public:
  LayerConversion(const PrimsOfSpecs& prims, const layer::Layer& layer, double length, double mass)
      : prims_(prims), layer_(layer), result_(layer), length_(length), mass_(mass) {}

  layer::Layer run() {
    for (const layer::Layer::Entry& entry : layer_.entries()) {
      if (entry.spec.kind == layer::SpecKind::Attribute) {
        convert(entry.path);
      }
    }
    return std::move(result_);
  }

 private:
  void convert(Path path) {
    const std::string_view name = path.name().view();
    const Path owner = path.parent();
    const stage::Prim prim = prims_.find(layer_, owner);
    const layer::Spec* spec = layer_.find(owner);
    const Token type = prim.is_valid()   ? prim.type_name()
                       : spec != nullptr ? spec->get_or(layer::fields::typeName, Token())
                                         : Token();
    const Dimension dimension = dimension_of(name, type, is_acceleration(prim, name));
    if (dimension == Dimension()) {
      return;
    }
    const double factor = std::pow(length_, dimension.length) * std::pow(mass_, dimension.mass);
    const layer::Spec* const source = layer_.find(path);
    layer::Spec* const edited = result_.find(path);
    for (const char* field : {"default", "timeSamples", "spline"}) {
      const layer::Value* value = source == nullptr ? nullptr : source->find(Token(field));
      if (value != nullptr && edited != nullptr) {
        edited->set(field, scaled_value(*value, factor));
      }
    }
  }

  const PrimsOfSpecs& prims_;
  const layer::Layer& layer_;
  layer::Layer result_;
  double length_;  ///< stage units in one of the layer's
  double mass_;
};

}  // namespace

Dimension dimension_of(std::string_view attribute, Token prim_type, bool acceleration) {
  if (attribute.starts_with("xformOp:translate") || attribute.starts_with("xformOp:transform")) {
    return kLength;
  }
  if (attribute == "physics:lowerLimit" || attribute == "physics:upperLimit") {
    return prim_type == Token("PhysicsPrismaticJoint") ? kLength : Dimension();
  }
  const auto* found = std::lower_bound(
      std::begin(kNamed), std::end(kNamed), attribute,
      [](const NamedDimension& row, std::string_view name) { return row.name < name; });
  if (found != std::end(kNamed) && found->name == attribute) {
    return found->dimension;
  }
  return instance_dimension(attribute, acceleration);
}

layer::Value scaled_value(const layer::Value& value, double factor) {
  layer::Value result = value;
  if (const auto* samples = value.get<layer::TimeSamples>()) {
    layer::TimeSamples scaled = *samples;
    for (layer::Value& sample : scaled.values) {
      sample = scaled_value(sample, factor);
    }
    return scaled;
  }
  if (const auto* spline = value.get<layer::Spline>()) {
    return scaled_spline(*spline, factor);
  }
  static_cast<void>(scale_as<float>(result, factor) || scale_as<double>(result, factor) ||
                    scale_as<Half>(result, factor) || scale_as<Vec3f>(result, factor) ||
                    scale_as<Vec3d>(result, factor) || scale_as<Vec3h>(result, factor) ||
                    scale_as<Mat4d>(result, factor));
  return result;
}

std::map<std::string, layer::LayerPtr> layers_in_stage_units(const stage::Stage& stage) {
  Diagnostics said;  // reported by the physics reader
  const stage::StageUnits units = stage::read_stage_units(stage, said);
  std::unique_ptr<PrimsOfSpecs> prims;
  std::map<std::string, layer::LayerPtr> converted;
  for (const layer::LayerPtr& layer : stage.used_layers()) {
    if (layer.get() == &stage.root_layer() || layer.get() == stage.session_layer()) {
      continue;
    }
    const double length =
        authored_unit(*layer, "metersPerUnit", units.meters_per_unit) / units.meters_per_unit;
    const double mass = authored_unit(*layer, "kilogramsPerUnit", units.kilograms_per_unit) /
                        units.kilograms_per_unit;
    if (std::fabs(length - 1) <= kSameUnit && std::fabs(mass - 1) <= kSameUnit) {
      continue;
    }
    if (prims == nullptr) {
      prims = std::make_unique<PrimsOfSpecs>(stage);
    }
    layer::Layer result = LayerConversion(*prims, *layer, length, mass).run();
    for (const auto& [field, unit] : {std::pair("metersPerUnit", units.meters_per_unit),
                                      std::pair("kilogramsPerUnit", units.kilograms_per_unit)}) {
      if (result.root().find(Token(field)) != nullptr) {
        result.root().set(field, layer::Value(unit));
      }
    }
    converted.emplace(layer->identifier(), std::make_shared<const layer::Layer>(std::move(result)));
  }
  return converted;
}

}  // namespace tenon::physics
