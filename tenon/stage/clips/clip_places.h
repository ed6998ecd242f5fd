// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "tenon/base/diagnostics.h"
#include "tenon/compose/layer_stack.h"
#include "tenon/layer/layer.h"

/// Where findings about clip sets stand. Internal to tenon/stage.
namespace tenon::stage {

/// Places a finding at what the strongest layer of a stack says about a clip set at `site`: at the
/// key that the message about it begins with, or the template's path, else at the whole set.
void place_clip_finding(Diagnostic& finding, const compose::LayerStack& stack, Path site,
                        const std::string& set, std::string_view message);

/// Places a finding at the asset path of a clip or a manifest that `layer` authors at `site`.
void place_clip_asset(Diagnostic& finding, const layer::Layer& layer, Path site,
                      const std::string& asset);

}  // namespace tenon::stage
