// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/fields/fact.h"

#include <algorithm>
#include <cmath>

#include "tenon/math/transform.h"
#include "tenon/scene/fields/same_fields.h"

namespace tenon::scene {
namespace {

double row_distance(const double* a, const double* b, std::size_t count, const Nearness& near) {
  double largest = 0;
  for (std::size_t i = 0; i < count; ++i) {
    largest = std::max(largest, distance(a[i], b[i], near));
  }
  return largest;
}

/// q and -q are one rotation.
double rotation_distance(const Quatd& a, const Quatd& b, const Nearness& near) {
  const Quatd negative{-b.x, -b.y, -b.z, -b.w};
  return std::min(row_distance(&a.x, &b.x, 4, near), row_distance(&a.x, &negative.x, 4, near));
}

double pose_distance(const Pose& a, const Pose& b, const Nearness& near) {
  return std::max(row_distance(a.position.v.data(), b.position.v.data(), 3, near),
                  rotation_distance(a.orientation, b.orientation, near));
}

double list_distance(DataView a, DataView b, const Nearness& near) {
  if (a.size() != b.size()) {
    return kNoMeasure;
  }
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, distance(a[i], b[i], near));
  }
  return largest;
}

}  // namespace

double distance(double a, double b, const Nearness& near) {
  if (a == b || (std::isnan(a) && std::isnan(b))) {
    return 0;
  }
  const double apart = std::fabs(a - b);
  if (!std::isfinite(apart)) {
    return kNoMeasure;
  }
  const double size = std::max({near.smallest_size, std::fabs(a), std::fabs(b)});
  return apart <= near.tolerance * size ? 0 : apart;
}

double distance(DataView a, DataView b, const Nearness& near) {
  if (same_data(a, b)) {
    return 0;  // as most are
  }
  switch (a.kind()) {
    case DataKind::Real:
    case DataKind::Integer:
    case DataKind::Ordinal:
      return distance(number_of(a), number_of(b), near);
    case DataKind::Rotation:
      return rotation_distance(a.as<Quatd>(), b.as<Quatd>(), near);
    case DataKind::Pose:
      return pose_distance(a.as<Pose>(), b.as<Pose>(), near);
    case DataKind::Numbers:
    case DataKind::List:
      return list_distance(a, b, near);
    case DataKind::Pair:
      return std::max(distance(a.first(), b.first(), near), distance(a.second(), b.second(), near));
    case DataKind::Flag:
    case DataKind::Word:
    case DataKind::Text:
    case DataKind::Path:
    case DataKind::Optional:
    case DataKind::Struct:
      break;
  }
  return kNoMeasure;
}

void add_numbers(DataView value, std::vector<double>& numbers) {
  switch (value.kind()) {
    case DataKind::Real:
    case DataKind::Integer:
    case DataKind::Ordinal:
      numbers.push_back(number_of(value));
      break;
    case DataKind::Rotation: {
      const Quatd& q = value.as<Quatd>();
      numbers.insert(numbers.end(), {q.w, q.x, q.y, q.z});
      break;
    }
    case DataKind::Pose: {
      const Pose& pose = value.as<Pose>();
      const auto& [x, y, z] = pose.position.v;
      const Quatd& q = pose.orientation;
      numbers.insert(numbers.end(), {x, y, z, q.w, q.x, q.y, q.z});
      break;
    }
    case DataKind::Numbers:
    case DataKind::List:
      for (std::size_t i = 0; i < value.size(); ++i) {
        add_numbers(value[i], numbers);
      }
      break;
    case DataKind::Pair:
      add_numbers(value.first(), numbers);
      add_numbers(value.second(), numbers);
      break;
    default:
      break;
  }
}

std::string in_words(std::string_view camel) {
  std::string words;
  for (const char c : camel) {
    const bool upper = c >= 'A' && c <= 'Z';
    const bool digit = c >= '0' && c <= '9';
    if (upper || digit) {
      words += words.empty() ? "" : " ";
    }
    words += upper ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return words;
}

}  // namespace tenon::scene
