// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/engines/mujoco/model.h"

namespace tenon::engines::mujoco {

/// While one lives, MuJoCo asks `filter` which geoms may touch on this thread. MuJoCo's callback is
/// one for the whole process; calls of others fall through to whatever was there before. Scopes of
/// different models do not nest.
class FilterScope {
 public:
  explicit FilterScope(const ContactFilter& filter) : needed_(filter.needed) {
    if (needed_) {
      begin(filter);
    }
  }
  ~FilterScope() {
    if (needed_) {
      end();
    }
  }
  FilterScope(const FilterScope&) = delete;
  FilterScope& operator=(const FilterScope&) = delete;

 private:
  void begin(const ContactFilter& filter);
  void end();

  bool needed_ = false;
  const ContactFilter* outer_ = nullptr;
};

/// Whether two geoms would touch where they meet. Those of one body are not asked about.
bool may_touch(const Model& model, int a, int b);

}  // namespace tenon::engines::mujoco
