// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "tenon/answers/json.h"
#include "tenon/base/path.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/base/token.h"

/// What is not there, in JSON.
namespace tenon::answers {

/// Null for an empty text.
inline Json or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }
inline Json or_null(Token token) { return or_null(token.str()); }
inline Json or_null(Path path) { return or_null(path.str()); }
/// A file as people are shown it.
inline Json file_or_null(const std::string& file) {
  return file.empty() ? Json(nullptr) : Json(shown_path(file));
}
/// Null for the line or column 0, which does not exist.
inline Json or_null(std::uint32_t number) { return number == 0 ? Json(nullptr) : Json(number); }

/// Null for a number that is not finite; 0 for -0.
inline Json finite_or_null(double number) {
  return std::isfinite(number) ? Json(number + 0.0) : Json(nullptr);
}
inline Json finite_or_null(const std::optional<double>& number) {
  return number ? finite_or_null(*number) : Json(nullptr);
}

template <class T, class ToJson>
Json or_null(const std::optional<T>& value, ToJson to_json) {
  return value ? Json(to_json(*value)) : Json(nullptr);
}

}  // namespace tenon::answers
