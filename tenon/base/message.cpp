// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/message.h"

#include <algorithm>
#include <utility>

#include "tenon/base/limits/fault_limits.h"
#include "tenon/base/path.h"

namespace tenon {

std::string_view role_name(RelatedRole role) {
  switch (role) {
    case RelatedRole::Prim:
      return "prim";
    case RelatedRole::Body:
      return "body";
    case RelatedRole::Collider:
      return "collider";
    case RelatedRole::Joint:
      return "joint";
    case RelatedRole::Articulation:
      return "articulation";
    case RelatedRole::Material:
      return "material";
    case RelatedRole::Scene:
      return "scene";
    case RelatedRole::CollisionGroup:
      return "collisionGroup";
    case RelatedRole::Property:
      return "property";
    case RelatedRole::Target:
      break;
  }
  return "target";
}

Message::Message(std::string text) : text_(std::move(text)) {}
Message::Message(const char* text) : text_(text) {}

Message& Message::operator+=(const Message& tail) {
  text_ += tail.text_;
  for (const RelatedPrim& prim : tail.related_) {
    relate(prim);
  }
  return *this;
}

Message& Message::about(Path path, RelatedRole role, std::string file) {
  relate({path.str(), role, std::move(file)});
  return *this;
}

void Message::relate(RelatedPrim prim) {
  const bool fits = prim.path.starts_with('/') && related_.size() < limits::kRelatedPrims;
  if (fits && std::find(related_.begin(), related_.end(), prim) == related_.end()) {
    related_.push_back(std::move(prim));
  }
}

Message named(Path path, RelatedRole role, std::string file) {
  std::string text = file.empty() ? std::string() : "@" + file + "@";
  Message message(text + "<" + path.str() + ">");
  message.relate({path.str(), role, std::move(file)});
  return message;
}

}  // namespace tenon
