// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "tenon/compose/layer_stack.h"

/// Internal: what composition looked at. All that a prim index is made of, besides the index above
/// and the options, is what layer stacks say at these sites.
namespace tenon::compose {

class SiteTrace {
 public:
  struct Look {
    const LayerStack* stack = nullptr;
    Path path;
    bool operator==(const Look&) const = default;
  };

  /// Takes note of what this thread looks at from now on.
  SiteTrace() : outer_(std::exchange(current_, this)) {}
  SiteTrace(const SiteTrace&) = delete;
  SiteTrace& operator=(const SiteTrace&) = delete;
  ~SiteTrace() { end(); }

  /// To be called by whatever asks a stack for specs at a path.
  static void note(const LayerStack& stack, Path path) {
    if (current_ != nullptr) {
      current_->looks_.push_back({&stack, path});
    }
  }

  /// Takes no more notes. What was looked at, with repetitions.
  std::vector<Look> end() {
    current_ = current_ == this ? outer_ : current_;
    return std::move(looks_);
  }

 private:
  inline static thread_local SiteTrace* current_ = nullptr;

  SiteTrace* outer_;
  std::vector<Look> looks_;
};

}  // namespace tenon::compose
