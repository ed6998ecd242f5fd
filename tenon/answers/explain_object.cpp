// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <vector>

#include "tenon/answers/explain.h"
#include "tenon/answers/where_opinions.h"

namespace tenon::answers {
namespace {

struct Object {
  stage::Prim prim;
  Token property;  // empty: the prim itself
};

/// The prim that a name without a path means; empty where none or several have it.
std::string path_of_name(const stage::Stage& stage, const std::string& name) {
  std::string found;
  std::vector<stage::Prim> pending{stage.pseudo_root()};
  while (!pending.empty()) {
    const stage::Prim prim = pending.back();
    pending.pop_back();
    if (prim.path().name().str() == name) {
      if (!found.empty()) {
        return {};
      }
      found = prim.path().str();
    }
    const std::vector<stage::Prim> children = prim.children();
    pending.insert(pending.end(), children.begin(), children.end());
  }
  return found;
}

Result<Object> find_object(const stage::Stage& stage, const std::string& text) {
  const Path path = Path::from(text);
  const Path prim_path = path.is_property() ? path.parent() : path;
  const stage::Prim prim =
      path.is_prim() || path.is_property() ? stage.prim(prim_path) : stage::Prim();
  if (!prim) {
    const std::string meant = path_of_name(stage, text);
    return Error(ErrorCode::NotFound, "there is no prim <" + text + ">")
        .with_fix(meant.empty() ? "tenon tree lists all prims" : "did you mean " + meant + "?");
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
