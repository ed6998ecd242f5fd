// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <mutex>

#include "tenon/stage/clips/clip_places.h"
#include "tenon/stage/clips/clip_set.h"

namespace tenon::stage {
namespace {

// Arguments for file formats change nothing in the formats that are read here.
std::string without_arguments(const std::string& asset_path) {
  return asset_path.substr(0, asset_path.find(":SDF_FORMAT_ARGS:"));
}

}  // namespace

const layer::Layer* ClipLayers::open(const std::string& asset_path, const layer::Layer& anchor,
                                     const ClipUser& user) {
  const std::lock_guard lock(mutex_);
  auto layer = opener_(without_arguments(asset_path), anchor);
  if (!layer || *layer == nullptr) {
    Diagnostic diagnostic;
    diagnostic.severity = Severity::Warning;
    diagnostic.rule = "clips.layer";
    diagnostic.message = "the clip layer @" + asset_path + "@ cannot be opened" +
                         (layer ? "" : ": " + layer.error().message());
    diagnostic.prim = user.prim;
    place_clip_asset(diagnostic, anchor, user.site, asset_path);
    diagnostic.fix = "correct the path in the `clips` metadata, or add the file";
    diagnostics_.add(std::move(diagnostic));
    return nullptr;
  }
  return opened_.emplace((*layer)->identifier(), *layer).first->second.get();
}

std::vector<layer::LayerPtr> ClipLayers::opened() const {
  const std::lock_guard lock(mutex_);
  std::vector<layer::LayerPtr> result;
  for (const auto& [identifier, layer] : opened_) {
    result.push_back(layer);
  }
  return result;
}

Diagnostics ClipLayers::take_diagnostics() {
  const std::lock_guard lock(mutex_);
  return std::exchange(diagnostics_, Diagnostics());
}

const layer::Layer* ClipLayer::get() const {
  if (!known_.load(std::memory_order_acquire)) {
    layer_.store(layers_.open(asset_path_, anchor_, user_), std::memory_order_relaxed);
    known_.store(true, std::memory_order_release);
  }
  return layer_.load(std::memory_order_relaxed);
}

}  // namespace tenon::stage
