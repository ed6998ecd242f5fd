// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Dumps are compared with those of OpenUSD, so a dump asks where implementations may differ: at
// every sample and knot, halfway between two of them and beyond both ends, which shows
// interpolation and extrapolation. Points between samples are bounded by kMaxMidpoints. A fallback
// of a vendor's schema counts as no value, since OpenUSD alone does not know these schemas. Fields
// that only compose, or that have a key of their own, are no metadata here.
#include "tenon/answers/dump/dump_properties.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>

#include "tenon/answers/dump/spline_text.h"
#include "tenon/layer/type_names.h"
#include "tenon/schema/registry.h"

namespace tenon::answers {
namespace {

using stage::Attribute;
using stage::Time;
using stage::ValueSource;

constexpr std::size_t kMaxMidpoints = 8;

std::string_view usd_source_name(ValueSource source) {
  switch (source) {
    case ValueSource::None:
      return "No value";
    case ValueSource::Fallback:
      return "Built-in fallback value";
    case ValueSource::Default:
      return "Attribute default value";
    case ValueSource::TimeSamples:
      return "Attribute time samples";
    case ValueSource::ValueClips:
      return "Value clips";
    case ValueSource::Spline:
      return "Spline value";
  }
  return "";
}

void write_sampled(JsonWriter& json, const Attribute& attribute, const std::vector<double>& times,
                   const ValueStyle& style) {
  json.array(times, [&](double time) {
    json.begin_array();
    json.number(time);
    write_value(json, attribute.get(time), style);
    json.end_array();
  });
}

void write_samples(JsonWriter& json, const Attribute& attribute, const ValueStyle& style) {
  const std::vector<double> times = attribute.time_samples();
  if (times.empty()) {
    return;
  }
  json.key("timeSamples");
  write_sampled(json, attribute, times, style);
  if (times.size() < 2) {
    return;
  }
  std::vector<double> between{times.front() - 1};
  for (std::size_t i = 0; i + 1 < times.size() && i < kMaxMidpoints; ++i) {
    between.push_back((times[i] + times[i + 1]) / 2);
  }
  between.push_back(times.back() + 1);
  json.key("interpolated");
  write_sampled(json, attribute, between, style);
}

void write_spline(JsonWriter& json, const Attribute& attribute, const ValueStyle& style) {
  const std::optional<layer::Spline> spline = attribute.spline();
  if (!spline || spline->knots.empty()) {
    return;
  }
  json.key("spline");
  json.string(spline_text(*spline));
  std::vector<double> times{spline->knots.front().time - 1};
  for (const layer::SplineKnot& knot : spline->knots) {
    times.push_back(knot.time);
  }
  for (std::size_t i = 0; i + 1 < spline->knots.size(); ++i) {
    times.push_back((spline->knots[i].time + spline->knots[i + 1].time) / 2);
  }
  times.push_back(spline->knots.back().time + 1);
  json.key("splineSamples");
  write_sampled(json, attribute, times, style);
}

void write_default(JsonWriter& json, const Attribute& attribute, const ValueStyle& style) {
  const schema::PropertyDefinition* declared = attribute.definition();
  ValueSource source = attribute.value_source();
  const bool vendor = source == ValueSource::Fallback && declared->vendor;
  if (vendor) {
    source = ValueSource::None;
  }
  json.key("defaultSource");
  json.string(usd_source_name(source));
  json.key("default");
  if (attribute.is_blocked()) {
    write_value(json, layer::ValueBlock{}, style);
  } else {
    write_value(json, vendor ? layer::Value() : attribute.get(), style);
  }
}

void write_paths(JsonWriter& json, std::string_view key, const std::vector<Path>& paths,
                 const ValueStyle& style) {
  json.key(key);
  json.array(paths, [&](Path path) { json.string(style.path_text(path)); });
}

void write_metadata_if_any(JsonWriter& json, std::map<std::string, layer::Value> fields,
                           const ValueStyle& style) {
  std::erase_if(fields, [](const auto& field) { return is_composition_field(field.first); });
  if (!fields.empty()) {
    json.key("metadata");
    write_metadata(json, fields, style);
  }
}

}  // namespace

bool is_composition_field(std::string_view name) {
  static const std::set<std::string_view> fields{"references",
                                                 "payload",
                                                 "inheritPaths",
                                                 "specializes",
                                                 "subLayers",
                                                 "subLayerOffsets",
                                                 "layerRelocates",
                                                 "relocates",
                                                 "variantSetNames",
                                                 "variantSelection",
                                                 "primChildren",
                                                 "properties",
                                                 "propertyChildren",
                                                 "variantSetChildren",
                                                 "variantChildren",
                                                 "timeSamples",
                                                 "default",
                                                 "spline",
                                                 "connectionPaths",
                                                 "targetPaths",
                                                 "connectionChildren",
                                                 "targetChildren",
                                                 "specifier",
                                                 "typeName",
                                                 "variability",
                                                 "custom",
                                                 "apiSchemas"};
  return fields.contains(name);
}

void write_metadata(JsonWriter& json, const std::map<std::string, layer::Value>& fields,
                    const ValueStyle& style) {
  json.begin_object();
  for (const auto& [name, value] : fields) {
    if (!is_composition_field(name)) {
      json.key(name);
      write_value(json, value, style);
    }
  }
  json.end_object();
}

void write_attribute(JsonWriter& json, const Attribute& attribute, const ValueStyle& style) {
  json.key("kind");
  json.string("attribute");
  json.key("type");
  const Token type = attribute.type_name();
  json.string(layer::find_type_name(type) == nullptr ? "" : type.view());
  json.key("variability");
  json.string(attribute.variability() == layer::Variability::Uniform ? "uniform" : "varying");
  json.key("custom");
  json.boolean(attribute.is_custom());
  json.key("authored");
  json.boolean(attribute.is_authored());
  write_default(json, attribute, style);
  write_samples(json, attribute, style);
  write_spline(json, attribute, style);
  const std::vector<Path> connections = attribute.connections();
  if (!connections.empty() || attribute.has_authored_connections()) {
    write_paths(json, "connections", connections, style);
  }
  write_metadata_if_any(json, attribute.all_authored_metadata(), style);
}

void write_relationship(JsonWriter& json, const stage::Relationship& relationship,
                        const ValueStyle& style) {
  json.key("kind");
  json.string("relationship");
  json.key("custom");
  json.boolean(relationship.is_custom());
  write_paths(json, "targets", relationship.targets(), style);
  write_paths(json, "forwarded", relationship.forwarded_targets(), style);
  write_metadata_if_any(json, relationship.all_authored_metadata(), style);
}

}  // namespace tenon::answers
