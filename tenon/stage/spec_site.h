// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/base/path.h"
#include "tenon/layer/layer.h"

namespace tenon::stage {

/// One layer's spec that contributes to a prim or property.
struct SpecSite {
  const layer::Layer* layer = nullptr;
  Path path;  ///< in that layer
  const layer::Spec* spec = nullptr;
};

}  // namespace tenon::stage
