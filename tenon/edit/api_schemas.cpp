// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/edit/api_schemas.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/text/nearest_name.h"
#include "tenon/schema/registry.h"

namespace tenon::edit {
namespace {

Error unfit_schema(Path prim, const std::string& message, const std::string& fix) {
  return Error(ErrorCode::Invalid, message)
      .with_prim(prim.str())
      .with_rule("edit.unknown-schema")
      .with_fix(fix);
}

std::string nearest_api(Token name) {
  std::vector<std::string_view> names;
  for (const schema::Schema* known : schema::Registry::instance().schemas()) {
    if (known->is_applied_api()) {
      names.push_back(known->name.view());
    }
  }
  return std::string(nearest_name(name.view(), names));
}

}  // namespace

Result<void> check_api_name(Path prim, Token api) {
  const auto [name, instance] = schema::split_api_name(api);
  const schema::Schema* schema = schema::Registry::instance().find(name);
  if (schema == nullptr || !schema->is_applied_api()) {
    const std::string nearest = nearest_api(name);
    return unfit_schema(prim, "no API schema is called \"" + name.str() + "\"",
                        nearest.empty() ? "tenon cat shows what other prims have"
                                        : "did you mean " + nearest + "?");
  }
  const bool multiple = schema->kind == schema::SchemaKind::MultipleApplyApi;
  if (multiple == instance.empty()) {
    return unfit_schema(
        prim,
        multiple ? name.str() + " is applied with a name of its own"
                 : name.str() + " is applied without a name",
        multiple ? "write " + name.str() + ":angular, or another name" : "write " + name.str());
  }
  return {};
}

Result<void> check_api(const stage::Prim& prim, Token api) {
  TENON_CHECK(check_api_name(prim.path(), api));
  const auto [name, instance] = schema::split_api_name(api);
  const auto& types = schema::Registry::instance().find(name)->can_only_apply_to;
  const bool fits = types.empty() || std::any_of(types.begin(), types.end(),
                                                 [&](Token type) { return prim.is_a(type); });
  return fits ? Result<void>()
              : unfit_schema(prim.path(), name.str() + " is not for a " + prim.type_name().str(),
                             "apply it to a " + types.front().str());
}

}  // namespace tenon::edit
