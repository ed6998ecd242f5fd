// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/base/path.h"
#include "tenon/layer/layer.h"
#include "tenon/stage/property.h"

namespace tenon::stage {

/// A relationship of a composed prim; a small handle by value.
class Relationship : public Property {
 public:
  Relationship() = default;

  bool is_defined() const;
  bool is_authored() const { return is_authored_as(layer::SpecKind::Relationship); }
  bool is_custom() const;

  bool has_authored_targets() const;
  /// Targets in the stage's namespace, list edits combined.
  std::vector<Path> targets() const { return composed_targets(); }
  /// The same with relationships followed to what they target.
  std::vector<Path> forwarded_targets() const;

  layer::Value metadata(Token field) const;

 private:
  friend class Prim;
  Relationship(const StageData* stage, const PrimData* prim, Path proxy_path, Token name)
      : Property(stage, prim, proxy_path, name) {}
};

}  // namespace tenon::stage
