// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "tenon/layer/layer.h"
#include "tenon/schema/registry.h"

namespace tenon::convert {

/// The same without -0.
Quatd with_plain_zeros(const Quatd& rotation);
/// A unit quaternion without the rounding errors of zeros, -0 too.
Quatd without_noise(const Quatd& rotation);
/// The same of a place: nothing that anybody could measure is lost.
Vec3d without_noise(Vec3d metres);

/// Makes a layer of `def` prims whose properties have the types that their schemas declare.
class LayerBuilder {
 public:
  explicit LayerBuilder(std::string identifier);

  /// A new prim; its parent must be there, its name free.
  Path define(Path parent, Token name, Token type);
  void set_metadata(Path prim, Token field, layer::Value value);
  /// Applies an API schema, also one with an instance ("PhysicsDriveAPI:angular").
  void apply(Path prim, Token api);

  // Properties that `schema` (a type or an API, with its instance) declares; a name that it does
  // not declare is a mistake in this program (assert). Instance names replace the pattern:
  // "drive:angular:physics:stiffness".
  /// A number as a float, a double or an int, as declared.
  void set_number(Path prim, Token schema, std::string_view property, double value);
  /// The same of arrays, vectors, colours and flags; no value without numbers.
  void set_numbers(Path prim, Token schema, std::string_view property,
                   const std::vector<double>& numbers);
  void set_vector(Path prim, Token schema, std::string_view property, const Vec3d& value);
  void set_rotation(Path prim, Token schema, std::string_view property, const Quatd& value);
  void set_value(Path prim, Token schema, std::string_view property, layer::Value value);
  void set_targets(Path prim, Token schema, std::string_view property, std::vector<Path> targets);

  // Properties without a schema.
  void set_attribute(Path prim, Token name, Token type_name, layer::Value value,
                     layer::Variability variability = layer::Variability::Varying);
  void set_custom(Path prim, Token name, Token type_name, layer::Value value);
  void set_relationship(Path prim, Token name, std::vector<Path> targets);
  /// An attribute without a value.
  void declare(Path prim, Token name, Token type_name);
  void set_connection(Path prim, Token name, Token type_name, Path source);
  /// Of a property that is there.
  void set_property_metadata(Path property, Token field, layer::Value value);
  /// An attribute that `schema` declares, without a value.
  void declare_of(Path prim, Token schema, std::string_view property);

  /// The layer, with the lists of children in place.
  layer::Layer take();
  layer::Layer& layer() { return layer_; }

 private:
  struct Lists {
    std::vector<Token> children;
    std::vector<Token> properties;
    std::vector<Token> apis;
  };

  const schema::PropertyDefinition& declared(Token schema, std::string_view property) const;
  layer::Spec& property_spec(Path prim, Token name, layer::SpecKind kind);

  layer::Layer layer_;
  std::unordered_map<Path, Lists> lists_;
};

}  // namespace tenon::convert
