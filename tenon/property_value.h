// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/base/result.h"
#include "tenon/layer/layer.h"
#include "tenon/stage/stage.h"

/// Properties and values as people write them, alike for edits of files and for values of one run.
namespace tenon {

enum class AssignmentKind : std::uint8_t {
  Whole,   ///< "=": all that it has then
  Add,     ///< "+=": to the targets that a relationship has
  Remove,  ///< "-="
};

struct PropertyAssignment {
  Path property;      ///< absolute
  std::string value;  ///< of an attribute as text layers print it, quotes and @ optional,
                      ///< "None" blocks; of a relationship: paths, all that it has then
  Token type_name;    ///< of an attribute that no schema and no layer knows: makes it
  AssignmentKind kind = AssignmentKind::Whole;
};

/// The error for `text` where the absolute path of a `kind` ("prim") is asked for: edit.bad-path.
Error not_a_path(const std::string& text, const std::string& kind);

/// The error for "+=" and "-=" on what is no relationship: edit.type-mismatch.
Error not_a_list(Path property);

/// "PATH.property=VALUE", "PATH.rel+=PATH", "PATH.rel-=PATH". Errors: Invalid, with rule
/// usage.value or edit.bad-path.
Result<PropertyAssignment> read_assignment(const std::string& text);

/// A property as schemas and layers declare it, and a value for it.
struct PropertyValue {
  bool is_relationship = false;
  Token type_name;  ///< of attributes
  layer::Variability variability = layer::Variability::Varying;
  bool custom = false;
  layer::Value value;         ///< of attributes
  std::vector<Path> targets;  ///< of relationships, in the stage's namespace
};

/// The declaration alone: the one of `spec` (where the target layer has one), of the schemas, or of
/// other layers; else what `type_name` says. Errors: NotFound (edit.no-property), with the nearest
/// property or the API schema that would declare it.
Result<PropertyValue> known_property(const stage::Prim& prim, Token name, Token type_name,
                                     const layer::Spec* spec);

/// The declaration with the value read by its type. Errors also: Invalid (edit.unknown-type,
/// edit.type-mismatch), with the form of the type or the tokens that are allowed.
Result<PropertyValue> read_property_value(const stage::Prim& prim,
                                          const PropertyAssignment& assignment,
                                          const layer::Spec* spec);

}  // namespace tenon
