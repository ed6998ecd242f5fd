// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tenon/base/change.h"
#include "tenon/base/path.h"
#include "tenon/layer/layer.h"

/// What differs between two layers as values: specs and fields, not text.
namespace tenon::diff {

/// One thing that differs. For specs that came or went, `field` is empty and `count` tells how many
/// specs there are with it and below it; these are not listed one by one.
struct Difference {
  Change change = Change::Changed;
  Path path;                                     ///< of the spec; variants included
  layer::SpecKind kind = layer::SpecKind::None;  ///< of the spec
  Token field;                                   ///< "default", "apiSchemas", ...
  std::string key;      ///< within a dictionary ("a:b"), selections (the set), or a time
  layer::Value before;  ///< empty where there is none
  layer::Value after;
  std::uint32_t before_line = 0;  ///< of the spec in its text; 0: unknown or none
  std::uint32_t after_line = 0;
  std::size_t count = 1;     ///< specs that came or went; elements of an array that differ
  std::size_t elements = 1;  ///< of the longer array
  std::size_t first = 0;     ///< index of the first element that differs
  double largest = 0;        ///< largest difference of two numbers; infinite: no measure
};

struct DiffOptions {
  double tolerance = 0;  ///< numbers a, b are equal when |a - b| <= tolerance max(1, |a|, |b|)
};

/// Everything that differs, sorted by path, fields in authored order. Not compared: the order of
/// properties (it says nothing), source lines, identifiers. The order of child prims is, as the
/// field "primChildren", where common children are in another order.
std::vector<Difference> layer_differences(const layer::Layer& before, const layer::Layer& after,
                                          const DiffOptions& options = {});

}  // namespace tenon::diff
