// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <unordered_map>
#include <vector>

#include "tenon/base/token.h"
#include "tenon/schema/registry.h"

namespace tenon::schema {

/// Definitions shared by all prims of one type and one list of API schemas: making one takes longer
/// than most queries of it.
class DefinitionCache {
 public:
  /// Lives as long as the cache.
  const PrimDefinition& get(Token type, const std::vector<Token>& apis);

 private:
  struct Key {
    Token type;
    std::vector<Token> apis;
    bool operator==(const Key&) const = default;
  };
  struct KeyHash {
    std::size_t operator()(const Key& key) const noexcept;
  };
  std::unordered_map<Token, std::unique_ptr<PrimDefinition>> plain_;
  std::unordered_map<Key, std::unique_ptr<PrimDefinition>, KeyHash> with_apis_;
};

}  // namespace tenon::schema
