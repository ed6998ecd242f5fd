// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/layer/layer.h"
#include "tenon/stage/attribute.h"
#include "tenon/stage/relationship.h"

namespace tenon::schema {
class PrimDefinition;
}

namespace tenon::stage {

class Stage;
struct PrimData;
struct StageData;

/// A composed prim; a small handle by value. An invalid one answers everything with "no" or empty.
/// Inside instances a handle is an instance proxy: its path is under the instance, its opinions
/// are those of the shared prototype.
class Prim {
 public:
  Prim() = default;

  bool is_valid() const { return data_ != nullptr; }
  explicit operator bool() const { return is_valid(); }
  bool operator==(const Prim&) const = default;

  Path path() const;
  Token name() const { return path().name(); }
  Token type_name() const;
  layer::Specifier specifier() const;

  bool is_pseudo_root() const;
  bool is_active() const;
  bool is_loaded() const;
  bool is_defined() const;   ///< this and all ancestors are def or class
  bool is_abstract() const;  ///< this or an ancestor is a class
  bool is_model() const;
  bool is_group() const;
  bool is_instance() const;
  bool is_instance_proxy() const;
  bool is_prototype() const;
  bool is_in_prototype() const;

  Prim parent() const;
  /// All children in order, inactive and undefined ones too; proxies below an instance.
  std::vector<Prim> children() const;
  Prim child(Token name) const;
  Prim prototype() const;          ///< of an instance (or a proxy of one), else invalid
  Prim prim_in_prototype() const;  ///< of an instance proxy
  /// Another prim of the same stage; invalid when there is none.
  Prim prim_at(Path path) const;

  /// The prim's type is `type` or derived from it, per the schema registry.
  bool is_a(Token type) const;
  /// The API schema is applied (or built into the type or another applied one). Multiple-apply
  /// schemas are asked with their instance: "PhysicsDriveAPI:angular". Unregistered names count.
  bool has_api(Token schema) const;
  /// Instance names of a multiple-apply schema: {"angular"} for "PhysicsDriveAPI".
  std::vector<Token> api_instances(Token schema) const;
  /// Composed apiSchemas list, names that no registry knows included, built-ins not.
  std::vector<Token> authored_api_schemas() const;
  /// As stock OpenUSD reports it: built-ins of the type first, without names that it does not know.
  std::vector<Token> applied_schemas() const;
  /// What the type and the applied schemas declare; never null for a valid prim.
  const schema::PrimDefinition* definition() const;

  /// A handle even when nothing is authored; `is_defined` tells.
  Attribute attribute(Token name) const;
  Relationship relationship(Token name) const;
  /// Authored properties in OpenUSD's order (dictionary order, then propertyOrder).
  std::vector<Token> authored_property_names() const;
  /// The same in the order of layers, as the stage keeps them.
  const std::vector<Token>& unordered_property_names() const;
  /// Authored properties with those that schemas of stock OpenUSD declare.
  std::vector<Token> property_names() const;
  bool has_property(Token name) const;
  bool is_relationship(Token name) const;

  /// Composed metadata: list edits and dictionaries combined, registered fallbacks not included.
  layer::Value metadata(Token field) const;
  bool has_authored_metadata(Token field) const;
  /// All authored fields of the prim, composed, sorted by name.
  std::map<std::string, layer::Value> all_authored_metadata() const;

  std::vector<std::string> variant_set_names() const;
  std::vector<std::string> variant_names(const std::string& set) const;  ///< sorted
  std::string variant_selection(const std::string& set) const;

  /// Specs strongest first: for "where does this come from".
  std::vector<SpecSite> spec_stack() const;
  /// A diagnostic with the place of the strongest spec, or of the strongest that says what `part`
  /// names.
  Diagnostic located(Severity severity, std::string rule, const Message& message,
                     StatementPart part = {}) const;

 private:
  friend class Stage;
  friend struct StageData;
  Prim(const StageData* stage, const PrimData* data, Path proxy_path = {})
      : stage_(stage), data_(data), proxy_path_(proxy_path) {}

  const StageData* stage_ = nullptr;
  const PrimData* data_ = nullptr;  // the prim's record; in the prototype for proxies
  Path proxy_path_;                 // empty unless this is an instance proxy
};

}  // namespace tenon::stage
