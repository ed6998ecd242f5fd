// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// All passes read attributes here, so they agree about what counts as authored. Attributes of the
// schema must have its type unless an option converts them (S-3); vendors' attributes may have any
// numeric type. NaN counts as unauthored and a very large magnitude as infinite (S-4). An authored
// default counts, else the value at the start, which is asked for only when some layer has samples,
// splines or clips (S-6). A finding gets the place of the strongest opinion about the attribute.
#include "tenon/physics/attribute_values.h"

#include <cmath>
#include <utility>

#include "tenon/base/text/text_number.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"
#include "tenon/layer/finding_place.h"
#include "tenon/layer/type_names.h"

namespace tenon::physics {

std::optional<double> number_of(const layer::Value& value) {
  if (value.is_array()) {
    return std::nullopt;
  }
  switch (value.type()) {
    case layer::ValueType::Float:
      return static_cast<double>(*value.get<float>());
    case layer::ValueType::Double:
      return *value.get<double>();
    case layer::ValueType::Half:
      return static_cast<double>(static_cast<float>(*value.get<Half>()));
    case layer::ValueType::Int:
      return static_cast<double>(*value.get<std::int32_t>());
    case layer::ValueType::UInt:
      return static_cast<double>(*value.get<std::uint32_t>());
    case layer::ValueType::Int64:
      return static_cast<double>(*value.get<std::int64_t>());
    case layer::ValueType::UInt64:
      return static_cast<double>(*value.get<std::uint64_t>());
    case layer::ValueType::UChar:
      return static_cast<double>(*value.get<std::uint8_t>());
    default:
      return std::nullopt;
  }
}

std::string text_of_float(double value) { return shortest(static_cast<float>(value)); }

// S-6: the default where one is authored, else the value at the start, held before the first
// sample.
const layer::Value& AttributeValues::resolved(const stage::Attribute& attribute,
                                              layer::Value& room) const {
  if (contents_.animated) {
    if (asked_ != nullptr && attribute.is_animated()) {
      asked_->insert(attribute.path().str());
    }
    if (samples_first_ || attribute.value_source() != stage::ValueSource::Default) {
      return room = attribute.get(start_);
    }
  }
  const layer::Value* const in_place = memo_->value_in_place(attribute);
  return in_place != nullptr ? *in_place : room = attribute.get();
}

bool AttributeValues::check_number(const stage::Prim& prim, Token name, double value) const {
  if (!std::isnan(value)) {
    return true;
  }
  // S-4
  report(prim, name, Severity::Error, "attribute.not-a-number",
         name.str() + " is not a number; it is treated as unauthored", "author a finite number");
  return false;
}

std::optional<double> AttributeValues::number(const stage::Prim& prim, Token name) const {
  layer::Value room;
  const layer::Value& value = resolved(prim.attribute(name), room);
  if (value.empty() || value.is_block()) {
    return std::nullopt;
  }
  const float* exact = value.get<float>();
  std::optional<double> number = exact != nullptr ? static_cast<double>(*exact) : number_of(value);
  if (exact == nullptr) {
    const bool converted = types_ == ValueTypes::Lenient && number.has_value();
    report_type(prim, name, layer::ValueType::Float, false, converted);
    if (!converted) {
      return std::nullopt;
    }
  }
  if (!number || !check_number(prim, name, *number)) {
    return std::nullopt;
  }
  return unlimited_or(*number);
}

std::optional<double> AttributeValues::wide_number(const stage::Prim& prim, Token name) const {
  const std::optional<double> value = get<double>(prim, name);
  if (!value || !check_number(prim, name, *value)) {
    return std::nullopt;
  }
  return value;
}

std::optional<Vec3d> AttributeValues::vector(const stage::Prim& prim, Token name) const {
  const std::optional<Vec3f> value = get<Vec3f>(prim, name);
  if (!value) {
    return std::nullopt;
  }
  const Vec3d wide = to_double(*value);
  for (std::size_t i = 0; i < 3; ++i) {
    if (!check_number(prim, name, wide[i])) {
      return std::nullopt;
    }
  }
  return wide;
}

std::optional<Quatd> AttributeValues::rotation(const stage::Prim& prim, Token name) const {
  const std::optional<Quatf> value = get<Quatf>(prim, name);
  if (!value) {
    return std::nullopt;
  }
  const Quatd wide = to_double(*value);
  const double square = dot(wide, wide);
  if (!check_number(prim, name, square) || !(square > 0)) {
    return std::nullopt;
  }
  return normalized(wide);
}

std::optional<double> AttributeValues::authored_number(const stage::Prim& prim, Token name) const {
  const stage::Attribute attribute = prim.attribute(name);
  if (!memo_->has_authored_value(attribute)) {
    return std::nullopt;
  }
  layer::Value room;
  const layer::Value& value = resolved(attribute, room);
  const std::optional<double> number = number_of(value);
  if (!number && !value.empty() && !value.is_block()) {
    report_type(prim, name, layer::ValueType::Float, false);
  }
  if (!number || !check_number(prim, name, *number)) {
    return std::nullopt;
  }
  return unlimited_or(*number);
}

std::optional<bool> AttributeValues::authored_flag(const stage::Prim& prim, Token name) const {
  const stage::Attribute attribute = prim.attribute(name);
  if (!memo_->has_authored_value(attribute)) {
    return std::nullopt;
  }
  layer::Value room;
  const layer::Value& value = resolved(attribute, room);
  if (const bool* flag = value.get<bool>()) {
    return *flag;
  }
  const std::optional<double> number = number_of(value);
  return number ? std::optional<bool>(*number != 0) : std::nullopt;
}

void AttributeValues::report(const stage::Prim& prim, Token name, Severity severity,
                             const char* rule, const Message& message, std::string fix,
                             StatementPart part) const {
  Diagnostic finding = prim.attribute(name).located(severity, rule, message, std::move(part));
  if (finding.prim.empty()) {
    finding.prim = prim.path().str();
  }
  if (finding.property.empty()) {
    finding.property = name.str();
  }
  finding.fix = std::move(fix);
  diagnostics_->add(std::move(finding));
}

void AttributeValues::report_target(const stage::Prim& prim, Token name, Path target,
                                    Severity severity, const char* rule, const Message& message,
                                    std::string fix) const {
  const stage::Relationship relationship = prim.relationship(name);
  Diagnostic finding = placed_->take(prim.path().property(name))
                           ? relationship.located_target(severity, rule, message, target)
                           : relationship.located(severity, rule, message);
  finding.fix = std::move(fix);
  diagnostics_->add(std::move(finding));
}

// S-3: OpenUSD silently uses the fallback.
void AttributeValues::report_type(const stage::Prim& prim, Token name, layer::ValueType wanted,
                                  bool wanted_array, bool converted) const {
  layer::Value room;
  const layer::Value& value = resolved(prim.attribute(name), room);
  const layer::TypeName* found = layer::type_name_of(value.type(), value.is_array());
  const layer::TypeName* schema = layer::type_name_of(wanted, wanted_array);
  const std::string found_name = found == nullptr ? "of another type" : found->name.str();
  const std::string wanted_name = schema == nullptr ? "another type" : schema->name.str();
  report(prim, name, converted ? Severity::Warning : Severity::Error, "attribute.wrong-type",
         name.str() + " is " + found_name + ", the schema says " + wanted_name +
             (converted ? "; it is converted" : "; it is treated as unauthored"),
         "declare it as " + wanted_name);
}

void report(Diagnostics& diagnostics, const stage::Prim& prim, Severity severity, const char* rule,
            const Message& message, std::string fix, StatementPart part) {
  Diagnostic finding = prim.located(severity, rule, message, std::move(part));
  if (finding.prim.empty()) {
    finding.prim = prim.path().str();
  }
  finding.fix = std::move(fix);
  diagnostics.add(std::move(finding));
}

StatementPart api_part(std::string name) {
  return layer::item_part(layer::fields::apiSchemas, std::move(name));
}

StatementPart type_part() { return layer::field_part(layer::fields::typeName); }

StatementPart value_part(std::string item) {
  return layer::item_part(layer::fields::default_value, std::move(item));
}

}  // namespace tenon::physics
