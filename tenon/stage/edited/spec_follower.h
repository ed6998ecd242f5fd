// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "tenon/layer/spec.h"
#include "tenon/stage/edited/arc_names.h"
#include "tenon/stage/stage.h"

namespace tenon::stage {

struct PrimData;

/// What changed in the spec of a prim, a variant or the root, in the layer where it is. Its list of
/// properties, type name and applied schemas may be others; it has these children more than before,
/// behind the others, which have no arcs, variants, clips or instances.
struct SpecNews {
  const layer::Spec* spec = nullptr;
  std::vector<Token> new_children;
};

/// Keeps a stage true to layers that are edited where they are. Values are looked up in the specs
/// whenever they are asked for; a stage keeps which prims there are, which properties the specs of
/// each list, its type and its applied schemas.
class SpecFollower {
 public:
  /// `stage` has to live as long as this.
  explicit SpecFollower(Stage& stage) : stage_(stage) {}

  /// False where the stage keeps more than that, for value clips: any edit takes a new one.
  bool can_follow() const;
  /// Takes over what changed. Specs that are not of the stage count for nothing. The first call
  /// looks at all prims, and that with the first new child at all specs; each of the others costs
  /// what the prims with these specs cost. False where it takes a new stage, and this one is no
  /// good: where something else may depend on a new prim, or more comes than a prim without arcs.
  bool follow(const std::vector<SpecNews>& news);

 private:
  const std::vector<std::uint32_t>& prims_of(const layer::Spec* spec);
  void note_prim(std::uint32_t number);
  bool may_be_waited_for(const std::vector<Token>& names);
  bool add_children(std::uint32_t parent, const std::vector<Token>& names);
  bool add_child(std::uint32_t parent, Token name);
  void link(std::uint32_t parent, std::uint32_t child);

  Stage& stage_;
  std::unordered_map<const layer::Spec*, std::vector<std::uint32_t>> prims_of_;  ///< by number
  std::unordered_map<std::uint32_t, std::uint32_t> last_child_;                  ///< of prims
  std::optional<ArcNames> arc_names_;
  std::size_t known_ = 0;  ///< prims before the call
};

}  // namespace tenon::stage
