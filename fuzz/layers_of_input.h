// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "tenon/base/result.h"
#include "tenon/layer/layer.h"
#include "tenon/stage/stage.h"

namespace tenon::fuzz {

/// The layers that an input holds as text: lines `--- NAME` stand before each but the first, which
/// is the root layer. Nothing when the root layer cannot be read; others may be absent.
class LayersOfInput {
 public:
  explicit LayersOfInput(std::string_view text);

  static constexpr std::size_t kMaxNodes = 50'000;

  const layer::LayerPtr& root() const { return root_; }
  compose::LayerOpener opener() const;
  Result<stage::Stage> open_stage(stage::StageOptions options = {}) const;

 private:
  layer::LayerPtr root_;
  std::map<std::string, layer::LayerPtr> layers_;
};

}  // namespace tenon::fuzz
