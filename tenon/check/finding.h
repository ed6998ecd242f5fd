// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/path.h"
#include "tenon/base/token.h"
#include "tenon/layer/value.h"

namespace tenon::check {

struct Rule;

/// One change of one spec, in the layer that owns the opinion.
struct SpecEdit {
  std::string layer;  ///< identifier
  Path path;          ///< of the spec in that layer
  Token field;
  layer::Value value;  ///< empty: the field is erased
  Token type_name;     ///< not empty: `path` is an attribute, made with this type where it is none
  bool uniform = false;  ///< the variability of that attribute
  Token added_api;       ///< not empty: put into the spec's apiSchemas; no field is set
  Token removed_api;     ///< not empty: taken out of them
  Token new_name{};      ///< not empty: `path` is a property, which gets this name
};

/// What removes a finding without changing what the asset means to tenon.
struct Fix {
  std::string what;  ///< "author physics:approximation = \"convexHull\""
  std::vector<SpecEdit> edits;
};

/// One place of an asset that breaks a rule.
struct Finding {
  const Rule* rule = nullptr;  ///< null: no rule of that id is known
  Diagnostic diagnostic;
  std::optional<Fix> fix;
  /// What is most likely meant, where the finding knows it: not made unless it is asked for.
  std::optional<Fix> suggestion{};
  /// Variants of the default prim's set "Physics" under which it holds; empty: all that there are.
  std::vector<std::string> variants;
};

}  // namespace tenon::check
