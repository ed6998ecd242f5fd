// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "tenon/answers/explain.h"
#include "tenon/answers/where_opinions.h"

namespace tenon::answers {
namespace {

struct Object {
  stage::Prim prim;
  Token property;  // empty: the prim itself
};

Result<Object> find_object(const stage::Stage& stage, const std::string& text) {
  const Path path = Path::from(text);
  const Path prim_path = path.is_property() ? path.parent() : path;
  const stage::Prim prim =
      path.is_prim() || path.is_property() ? stage.prim(prim_path) : stage::Prim();
  if (!prim) {
    return Error(ErrorCode::NotFound, "there is no prim <" + text + ">")
        .with_fix("tenon tree lists all prims");
  }
  Object object{prim, path.is_property() ? path.name() : Token()};
  if (path.is_property()) {
    TENON_CHECK(check_property(prim, object.property));
  }
  return object;
}

}  // namespace

Result<void> check_object(const stage::Stage& stage, const std::string& object) {
  TENON_TRY([[maybe_unused]] const Object found, find_object(stage, object));
  return {};
}

Result<Json> explain_object(const Explained& explained, const std::string& object,
                            const std::string& other) {
  TENON_TRY(const Object first, find_object(explained.stage, object));
  if (!other.empty()) {
    TENON_TRY(const Object second, find_object(explained.stage, other));
    return explain_pair(explained, first.prim, second.prim);
  }
  return first.property.empty() ? explain_prim(explained, first.prim)
                                : explain_property(explained, first.prim, first.property);
}

}  // namespace tenon::answers
