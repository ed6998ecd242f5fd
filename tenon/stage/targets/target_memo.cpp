// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage/targets/target_memo.h"

#include <functional>

#include "tenon/compose/targets.h"
#include "tenon/stage/targets/composed_targets.h"

namespace tenon::stage {

std::size_t TargetMemo::KeyHash::operator()(const Key& key) const noexcept {
  return std::hash<const void*>()(key.prim) * 31 + std::hash<Token>()(key.name);
}

std::vector<Path> TargetMemo::targets(const Relationship& relationship) {
  const PrimData* const prim = relationship.prim_;
  if (prim == nullptr || !prim->in_prototype ||
      !prim->index->may_have_property(relationship.name_)) {
    return relationship.targets();
  }
  const auto [known, is_new] = composed_.try_emplace(Key{prim, relationship.name_});
  if (is_new) {
    known->second = compose::compose_stage_targets(*prim->index, relationship.name_).paths;
  }
  std::vector<Path> targets = known->second;
  if (targets.empty()) {
    return targets;
  }
  const Path parent = relationship.path().parent().parent();
  if (parent != parent_) {
    parent_ = parent;
    sources_ = source_map(*relationship.stage_, *prim, relationship.proxy_path_);
  }
  for (Path& target : targets) {
    target = translated(sources_, target);
  }
  return targets;
}

}  // namespace tenon::stage
