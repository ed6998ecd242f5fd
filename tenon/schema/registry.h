// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "tenon/base/token.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/type_names.h"
#include "tenon/schema/schema_rows.h"

namespace tenon::schema {

/// A property that a schema declares.
struct PropertyDefinition {
  Token name;  ///< may hold __INSTANCE_NAME__ in a Schema, never in a PrimDefinition
  bool is_relationship = false;
  Token type_name;                        ///< empty for relationships
  const layer::TypeName* type = nullptr;  ///< of type_name
  layer::Variability variability = layer::Variability::Varying;
  layer::Value fallback;              ///< empty when there is none
  std::vector<Token> allowed_tokens;  ///< empty: any
  bool vendor = false;  ///< only there through a schema that stock OpenUSD does not know
};

struct Schema {
  Token name;
  SchemaKind kind = SchemaKind::ConcreteTyped;
  Token base;
  std::vector<Token> chain;              ///< itself, its base, and so on
  std::vector<Token> built_in_apis;      ///< complete, strongest first; may hold __INSTANCE_NAME__
  std::vector<Token> can_only_apply_to;  ///< types, of an API schema; empty: any
  std::vector<PropertyDefinition> properties;
  bool vendor = false;  ///< physx, newton, mjc, isaac: unknown to stock OpenUSD

  bool is_applied_api() const {
    return kind == SchemaKind::SingleApplyApi || kind == SchemaKind::MultipleApplyApi;
  }
};

/// "PhysicsDriveAPI:angular" -> {"PhysicsDriveAPI", "angular"}; the instance is empty without ':'.
std::pair<Token, Token> split_api_name(Token applied);

/// All schemas known to tenon; one immutable instance. Each is made from its row when it is first
/// asked for, so that a program pays for those that its scenes use. From any thread.
class Registry {
 public:
  static const Registry& instance();

  /// nullptr when no schema has that name.
  const Schema* find(Token name) const;
  /// A schema of that name that stock OpenUSD does not know: Schema::vendor.
  bool is_vendor(Token name) const;
  /// `type` is `base` or derives from it.
  bool is_a(Token type, Token base) const;
  /// Sorted by name.
  std::vector<const Schema*> schemas() const;

 private:
  struct Slot {
    const SchemaRow* row = nullptr;
    bool vendor = false;
    mutable std::once_flag made;
    mutable Schema schema;
  };

  Registry();
  void add(const SchemaRow& row, bool vendor);
  const Slot* slot(std::string_view name) const;
  static const Schema& schema_of(const Slot& slot);

  std::unordered_map<std::string_view, Slot> slots_;
};

/// What the type of a prim and its API schemas say together.
class PrimDefinition {
 public:
  /// `type` may be unknown or empty; `apis` are the authored apiSchemas, strongest first.
  PrimDefinition(Token type, const std::vector<Token>& apis);
  PrimDefinition(const PrimDefinition&) = delete;
  PrimDefinition& operator=(const PrimDefinition&) = delete;

  Token type() const { return type_; }
  const Schema* schema() const { return schema_; }
  /// The declaration of a property; nullptr when no schema declares it.
  const PropertyDefinition* find(Token property) const {
    const auto it = properties_.find(property);
    return it == properties_.end() ? nullptr : it->second;
  }
  /// The same over the schemas of stock OpenUSD alone.
  const PropertyDefinition* find_stock(Token property) const {
    const PropertyDefinition* found = find(property);
    return found == nullptr || !found->vendor ? found : nullptr;
  }
  /// The schema that declares a property, with its instance; applied ones before those of the
  /// type. Empty when none does.
  Token declaring_schema(Token property) const;
  /// Names of all declared properties, in dictionary order.
  std::vector<Token> property_names(bool with_vendor) const;

  /// Applied schemas as stock OpenUSD reports them: built-ins of the type, then authored ones, each
  /// followed by its own built-ins; names that it does not know are skipped.
  const std::vector<Token>& applied_stock() const { return applied_stock_; }
  /// The same with vendor schemas, their built-ins and unknown names.
  const std::vector<Token>& applied() const { return applied_; }
  bool has_api(Token schema) const {
    for (const Token& name : applied_) {
      if (name == schema) {
        return true;
      }
    }
    return false;
  }

 private:
  void apply(Token api, bool built_in_of_vendor);
  void add_properties(const Schema& schema, Token instance, bool through_vendor);

  Token type_;
  const Schema* schema_ = nullptr;
  std::vector<Token> applied_stock_;
  std::vector<Token> applied_;
  std::unordered_map<Token, const PropertyDefinition*> properties_;
  std::vector<std::unique_ptr<PropertyDefinition>> instanced_;
};

}  // namespace tenon::schema
