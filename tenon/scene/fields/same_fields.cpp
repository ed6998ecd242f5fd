// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/fields/same_fields.h"

#include <cmath>
#include <cstring>
#include <string>

#include "tenon/base/path.h"

namespace tenon::scene {
namespace {

bool same_reals(const double* a, const double* b, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    if (!(a[i] == b[i] || (std::isnan(a[i]) && std::isnan(b[i])))) {
      return false;
    }
  }
  return true;
}

bool holds_reals(const DataType& type) {
  return type.kind == DataKind::Real || type.kind == DataKind::Rotation ||
         type.kind == DataKind::Pose ||
         (type.kind == DataKind::Numbers && type.item->kind == DataKind::Real);
}

/// Of what is no optional, pair, list or struct.
bool same_leaf(DataView a, DataView b) {
  if (holds_reals(*a.type)) {
    return same_reals(&a.as<double>(), &b.as<double>(), a.type->size / sizeof(double));
  }
  if (a.kind() == DataKind::Text) {
    return a.as<std::string>() == b.as<std::string>();
  }
  if (a.kind() == DataKind::Path) {
    return a.as<Path>() == b.as<Path>();
  }
  return std::memcmp(a.at, b.at, a.type->size) == 0;
}

bool lists_agree(DataView a, DataView b, bool (*agree)(DataView, DataView)) {
  const std::size_t count = a.size();
  if (count != b.size()) {
    return false;
  }
  // The same bytes, as of unchanged meshes.
  if (count == 0 ||
      (a.type->item->is_flat && std::memcmp(a[0].at, b[0].at, count * a.type->item->size) == 0)) {
    return true;
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!data_agrees(a[i], b[i], agree)) {
      return false;
    }
  }
  return true;
}

}  // namespace

bool data_agrees(DataView a, DataView b, bool (*agree)(DataView, DataView)) {
  switch (a.kind()) {
    case DataKind::Optional:
    case DataKind::List:
      return lists_agree(a, b, agree);
    case DataKind::Pair:
      return data_agrees(a.first(), b.first(), agree) && data_agrees(a.second(), b.second(), agree);
    case DataKind::Struct:
      for (const DataField& field : a.type->fields) {
        if (!data_agrees(a.member(field), b.member(field), agree)) {
          return false;
        }
      }
      return true;
    default:
      return agree(a, b);
  }
}

bool same_data(DataView a, DataView b) { return data_agrees(a, b, same_leaf); }

}  // namespace tenon::scene
