// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

/// Numbers and text, independent of the locale.
namespace tenon {

/// Shortest text that reads back as the same number; "inf", "-inf", "nan" for the rest.
std::string shortest(double value);
std::string shortest(float value);

/// As OpenUSD prints numbers in text layers: shortest digits, exponent form as C's %g from 1e15 on
/// ("1e15") and below 1e-6, no trailing ".0".
std::string layer_text(double value);
std::string layer_text(float value);
void append_layer_text(std::string& out, double value);
void append_layer_text(std::string& out, float value);

/// Whole-text number; accepts a leading '+', "inf", "-inf", "nan"; nullopt when anything is left.
std::optional<double> parse_double(std::string_view text);
std::optional<std::int64_t> parse_int64(std::string_view text);
std::optional<std::uint64_t> parse_uint64(std::string_view text);

}  // namespace tenon
