// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unordered_set>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/layer/layer.h"

namespace tenon::stage {

/// The names of prims in the targets of all arcs that layers author, in force or not, and in what
/// they open by default.
class ArcNames {
 public:
  explicit ArcNames(const std::vector<layer::LayerPtr>& layers);

  /// False where no arc leads to a prim of that name, or through one. True for every name where
  /// arcs give prims other names: relocates and specializes.
  bool may_have(Token name) const { return any_ || names_.contains(name); }

 private:
  void add_spec(const layer::Spec& spec);
  void add(Path path);

  std::unordered_set<Token> names_;
  bool any_ = false;
};

}  // namespace tenon::stage
