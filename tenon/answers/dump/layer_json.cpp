// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Specs are sorted by path and their fields by name, so that the text depends on what a layer says
// and not on how it is stored. The switch over types is made of value_types.def; dictionaries,
// samples and values without a schema lead back to it. Fields that only repeat what holds without
// them are omitted, and so are target and connection specs that have no fields, since their
// property lists them.
#include "tenon/answers/dump/layer_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "tenon/answers/specifier_word.h"
#include "tenon/base/text/text_number.h"
#include "tenon/formats/text/write/value_text.h"
#include "tenon/layer/field_values.h"

namespace tenon::answers {
namespace {

using layer::SpecKind;
using layer::Value;
using layer::ValueType;
namespace fields = layer::fields;

std::string_view name_of(layer::SplineCurve x) {
  return x == layer::SplineCurve::Bezier ? "bezier" : "hermite";
}

std::string_view name_of(layer::SplineInterpolation x) {
  constexpr std::string_view kNames[] = {"none", "held", "linear", "curve"};
  return kNames[static_cast<std::size_t>(x)];
}

std::string_view name_of(layer::SplineExtrapolation x) {
  constexpr std::string_view kNames[] = {"none",       "held",      "linear",       "sloped",
                                         "loopRepeat", "loopReset", "loopOscillate"};
  return kNames[static_cast<std::size_t>(x)];
}

std::string_view name_of(layer::TangentAlgorithm x) {
  constexpr std::string_view kNames[] = {"none", "custom", "autoEase"};
  return kNames[static_cast<std::size_t>(x)];
}

struct PlainWriter {
  JsonWriter& json;

  void write(bool x) { json.boolean(x); }
  void write(std::uint8_t x) { json.integer(x); }
  void write(std::int32_t x) { json.integer(x); }
  void write(std::uint32_t x) { json.integer(x); }
  void write(std::int64_t x) { json.number_text(std::to_string(x)); }
  void write(std::uint64_t x) { json.number_text(std::to_string(x)); }
  void write(Half x) { write(float(x)); }
  void write(float x) {
    std::isfinite(x) ? json.number_text(shortest(x)) : json.number(static_cast<double>(x));
  }
  void write(double x) { json.number(x); }
  void write(const std::string& x) { json.string(x); }
  void write(Token x) { json.string(x.view()); }
  void write(Path x) { json.string(x.str()); }
  void write(layer::TimeCode x) { json.number(x.value); }
  void write(layer::Duration x) { json.number(x.value); }
  void write(const layer::AssetPath& x) { json.string(x.authored); }
  void write(const layer::PathExpression& x) { json.string(x.text); }
  void write(const layer::ArrayEdit& x) { json.string(formats::value_text(x)); }
  void write(layer::ValueBlock) { json.null(); }
  void write(layer::AnimationBlock) { json.null(); }
  void write(layer::Opaque) { json.null(); }
  void write(layer::Permission x) {
    json.string(x == layer::Permission::Public ? "public" : "private");
  }
  void write(layer::Specifier x) { json.string(specifier_word(x)); }
  void write(layer::Variability x) {
    json.string(x == layer::Variability::Uniform ? "uniform" : "varying");
  }
  template <class T, std::size_t N>
  void write(const Vec<T, N>& x) {
    json.array(x.v, [this](const auto& item) { this->write(item); });
  }
  template <class T>
  void write(const Quat<T>& x) {
    json.array(std::array{x.x, x.y, x.z, x.w}, [this](const auto& item) { this->write(item); });
  }
  template <std::size_t N>
  void write(const Matrix<N>& x) {
    json.array(x.m, [this](const auto& row) {
      json.array(row, [this](double item) { json.number(item); });
    });
  }
  template <class T>
  void write(const std::vector<T>& items) {
    json.array(items, [this](const auto& item) { this->write(item); });
  }

  template <class T>
  void member(std::string_view name, const T& value) {
    json.key(name);
    write(value);
  }
  template <class T>
  void list_member(std::string_view name, const std::vector<T>& items) {
    if (!items.empty()) {
      member(name, items);
    }
  }
  template <class T>
  void write(const layer::ListOp<T>& x) {
    json.begin_object();
    list_member("explicit", x.explicit_items);
    list_member("delete", x.deleted);
    list_member("add", x.added);
    list_member("prepend", x.prepended);
    list_member("append", x.appended);
    list_member("order", x.ordered);
    json.end_object();
  }
  void write(const layer::Dictionary& x) {
    json.begin_object();
    for (const auto& [key, item] : x.items) {
      json.key(key);
      write_plain_value(json, item);
    }
    json.end_object();
  }
  void write(const layer::VariantSelections& x) {
    json.begin_object();
    for (const auto& [set, variant] : x.items) {
      member(set, variant);
    }
    json.end_object();
  }
  void write(const layer::Relocates& x) {
    json.begin_object();
    for (const auto& [from, to] : x.pairs) {
      member(from.str(), to);
    }
    json.end_object();
  }
  void write(const layer::LayerOffset& x) {
    json.begin_object();
    member("offset", x.offset);
    member("scale", x.scale);
    json.end_object();
  }
  template <class Arc>
  void arc_members(const Arc& x) {
    if (!x.asset_path.empty()) {
      member("asset", x.asset_path);
    }
    if (!x.prim_path.empty()) {
      member("path", x.prim_path);
    }
    if (!x.offset.is_identity()) {
      member("layerOffset", x.offset);
    }
  }
  void write(const layer::Payload& x) {
    json.begin_object();
    arc_members(x);
    json.end_object();
  }
  void write(const layer::Reference& x) {
    json.begin_object();
    arc_members(x);
    if (!x.custom_data.empty()) {
      member("customData", x.custom_data);
    }
    json.end_object();
  }
  void write(const layer::TimeSamples& x) {
    json.begin_object();
    for (std::size_t i = 0; i < x.size(); ++i) {
      json.key(json_number(x.times[i]));
      write_plain_value(json, x.values[i]);
    }
    json.end_object();
  }

  // Without a schema only the writing tells the type: numbers, None, quoted text, words.
  void write(const layer::UnregisteredValue& x) {
    const auto* text = x.value.get<std::string>();
    if (text == nullptr) {
      return write_plain_value(json, x.value);
    }
    const std::optional<double> number = parse_double(*text);
    const bool quoted = text->size() >= 2 && (text->front() == '"' || text->front() == '\'') &&
                        text->back() == text->front();
    if (*text == "None") {
      json.null();
    } else if (number && std::isfinite(*number)) {
      json.number(*number);
    } else {
      json.string(quoted ? std::string_view(*text).substr(1, text->size() - 2) : *text);
    }
  }

  void write(const layer::SplineEnd& x) {
    json.begin_object();
    member("mode", std::string(name_of(x.mode)));
    if (x.mode == layer::SplineExtrapolation::Sloped) {
      member("slope", x.slope);
    }
    if (x.boundary) {
      member("boundary", *x.boundary);
    }
    json.end_object();
  }
  void write(const layer::SplineTangent& x) {
    json.begin_object();
    member("width", x.width);
    member("slope", x.slope);
    member("algorithm", std::string(name_of(x.algorithm)));
    json.end_object();
  }
  void write(const layer::SplineKnot& x) {
    json.begin_object();
    member("value", x.value);
    if (x.pre_value) {
      member("preValue", *x.pre_value);
    }
    member("interpolation", std::string(name_of(x.next)));
    member("preTangent", x.pre_tangent);
    member("postTangent", x.post_tangent);
    if (!x.custom_data.empty()) {
      member("customData", x.custom_data);
    }
    json.end_object();
  }
  void write(const layer::SplineLoop& x) {
    json.begin_object();
    member("start", x.start);
    member("end", x.end);
    member("preLoops", x.pre_loops);
    member("postLoops", x.post_loops);
    member("valueOffset", x.value_offset);
    json.end_object();
  }
  void write(const layer::Spline& x) {
    json.begin_object();
    member("curve", std::string(name_of(x.curve)));
    member("pre", x.pre);
    member("post", x.post);
    if (x.loop) {
      member("loop", *x.loop);
    }
    json.key("knots");
    json.begin_object();
    for (const layer::SplineKnot& knot : x.knots) {
      member(json_number(knot.time), knot);
    }
    json.end_object();
    json.end_object();
  }

  template <class T>
  void scalar_or_array(const Value& value) {
    if (!value.is_array()) {
      return write(*value.get<T>());
    }
    const auto* array = value.get<layer::Array<T>>();
    if (array == nullptr) {
      return json.null();  // corrupt data
    }
    json.array(*array, [this](const auto& item) {
      if constexpr (std::is_same_v<T, bool>) {
        json.boolean(item != 0);  // bools are stored as char
      } else {
        this->write(item);
      }
    });
  }
};

bool says_nothing_new(const layer::Spec& spec, const layer::Field& field) {
  const auto* variability = field.value.get<layer::Variability>();
  const auto* custom = field.value.get<bool>();
  return field.name == fields::connectionChildren || field.name == fields::targetChildren ||
         (field.name == fields::custom && custom != nullptr && !*custom) ||
         (spec.kind == SpecKind::Attribute && field.name == fields::variability &&
          variability != nullptr && *variability == layer::Variability::Varying) ||
         (spec.kind == SpecKind::Relationship && field.name == fields::variability) ||
         (spec.kind == SpecKind::Variant && field.name == fields::specifier);
}

/// Target and connection specs only say that they are there, which their property says, too.
bool is_shown(const layer::Spec& spec) {
  switch (spec.kind) {
    case SpecKind::PseudoRoot:
    case SpecKind::Prim:
    case SpecKind::Attribute:
    case SpecKind::Relationship:
    case SpecKind::VariantSet:
    case SpecKind::Variant:
      return true;
    case SpecKind::None:
      return false;
    default:
      return !spec.fields().empty();
  }
}

void write_spec(JsonWriter& json, const layer::Spec& spec) {
  std::vector<const layer::Field*> shown;
  for (const layer::Field& field : spec.fields()) {
    if (!says_nothing_new(spec, field)) {
      shown.push_back(&field);
    }
  }
  std::sort(shown.begin(), shown.end(), [](const layer::Field* a, const layer::Field* b) {
    return a->name.view() < b->name.view();
  });
  json.begin_object();
  for (const layer::Field* field : shown) {
    json.key(field->name == fields::properties ? "propertyChildren" : field->name.view());
    // A default that is a path is held as a list of one.
    const auto* paths = field->value.get<std::vector<Path>>();
    if (field->name == fields::default_value && paths != nullptr && paths->size() == 1) {
      json.string(paths->front().str());
    } else {
      write_plain_value(json, field->value);
    }
  }
  json.end_object();
}

}  // namespace

void write_plain_value(JsonWriter& json, const Value& value) {
  PlainWriter writer{json};
  switch (value.type()) {
#define TENON_SCALAR(enumerator, type, name, crate_id) \
  case ValueType::enumerator: {                        \
    using namespace layer;                             \
    return writer.scalar_or_array<type>(value);        \
  }
#define TENON_FIELD(enumerator, type, crate_id) \
  case ValueType::enumerator: {                 \
    using namespace layer;                      \
    return writer.write(*value.get<type>());    \
  }
#include "tenon/layer/value_types.def"
    case ValueType::None:
      break;
  }
  json.null();
}

void write_layer_json(std::ostream& out, const layer::Layer& layer) {
  std::vector<const layer::Layer::Entry*> entries;
  for (const layer::Layer::Entry& entry : layer.entries()) {
    if (!entry.path.empty() && is_shown(entry.spec)) {
      entries.push_back(&entry);
    }
  }
  std::sort(entries.begin(), entries.end(),
            [](const auto* a, const auto* b) { return a->path < b->path; });
  JsonWriter json(out);
  json.begin_object();
  for (const layer::Layer::Entry* entry : entries) {
    json.key(entry->path.str());
    write_spec(json, entry->spec);
  }
  json.end_object();
}

}  // namespace tenon::answers
