// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/fields/data_type.h"

#include <cmath>
#include <cstring>

namespace tenon::scene {
namespace {

/// The bytes of a whole number of at most eight; all machines that this runs on put the low one
/// first.
std::uint64_t low_bytes(DataView value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, value.at, value.type->size);
  return bits;
}

}  // namespace

void DataRef::assign(DataView from) const {
  switch (kind()) {
    case DataKind::List:
    case DataKind::Optional:
      type->resize(at, from.size());
      for (std::size_t i = 0; i < from.size(); ++i) {
        (*this)[i].assign(from[i]);
      }
      return;
    case DataKind::Pair:
      first().assign(from.first());
      second().assign(from.second());
      return;
    case DataKind::Struct:
      for (const DataField& field : type->fields) {
        member(field).assign(from.member(field));
      }
      return;
    default:
      type->assign(at, from.at);
  }
}

const DataField* find_field(const DataType& type, std::string_view name) {
  for (const DataField& field : type.fields) {
    if (field.info->name == name) {
      return &field;
    }
  }
  return nullptr;
}

const Path* path_of(DataView object) {
  const DataField* path = find_field(*object.type, "path");
  return path == nullptr || path->type->kind != DataKind::Path ? nullptr
                                                               : &object.member(*path).as<Path>();
}

bool has_numbers(const DataType& type) {
  switch (type.kind) {
    case DataKind::Ordinal:
    case DataKind::Integer:
    case DataKind::Real:
    case DataKind::Numbers:
    case DataKind::Rotation:
    case DataKind::Pose:
      return true;
    case DataKind::List:
      return has_numbers(*type.item);
    case DataKind::Pair:
      return has_numbers(*type.item) && has_numbers(*type.second);
    case DataKind::Flag:
    case DataKind::Word:
    case DataKind::Text:
    case DataKind::Path:
    case DataKind::Optional:
    case DataKind::Struct:
      break;
  }
  return false;
}

double number_of(DataView value) {
  if (value.kind() == DataKind::Real) {
    return value.as<double>();
  }
  const std::uint64_t bits = low_bytes(value);
  if (!value.type->is_signed) {
    return static_cast<double>(bits);
  }
  const unsigned unused = 64 - 8 * static_cast<unsigned>(value.type->size);
  return static_cast<double>(static_cast<std::int64_t>(bits << unused) >> unused);
}

void set_number(DataRef to, double value) {
  if (to.kind() == DataKind::Real) {
    to.as<double>() = value;
  } else {
    set_integer(to, static_cast<std::int64_t>(value));
  }
}

IntegerRange integer_range(const DataType& type) {
  const double count = std::ldexp(1.0, static_cast<int>(8 * type.size));
  return type.is_signed ? IntegerRange{-count / 2, count / 2 - 1} : IntegerRange{0, count - 1};
}

void set_integer(DataRef to, std::int64_t value) { std::memcpy(to.at, &value, to.type->size); }

std::size_t enumerator_of(DataView word) { return static_cast<std::size_t>(low_bytes(word)); }

}  // namespace tenon::scene
