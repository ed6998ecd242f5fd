// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/schema/definition_cache.h"

#include <functional>

namespace tenon::schema {

std::size_t DefinitionCache::KeyHash::operator()(const Key& key) const noexcept {
  std::size_t hash = std::hash<Token>()(key.type);
  for (const Token api : key.apis) {
    hash = hash * 1000003u ^ std::hash<Token>()(api);
  }
  return hash;
}

const PrimDefinition& DefinitionCache::get(Token type, const std::vector<Token>& apis) {
  std::unique_ptr<PrimDefinition>& slot = apis.empty() ? plain_[type] : with_apis_[Key{type, apis}];
  if (slot == nullptr) {
    slot = std::make_unique<PrimDefinition>(type, apis);
  }
  return *slot;
}

}  // namespace tenon::schema
