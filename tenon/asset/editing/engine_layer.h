// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "tenon/base/result.h"
#include "tenon/layer/layer.h"

/// Internal to the wiring.
namespace tenon {

/// A variant of "Physics" for an engine, and the layer that it loads.
struct EngineLayer {
  layer::Layer interface;  ///< with the variant
  layer::Layer file;       ///< over physics.usda, without opinions
};

/// The two for "physx", "mujoco" or "newton"; nullopt where `interface` opens no asset of the
/// structure 3.0 with physics, has such a variant, or the engine is another one.
Result<std::optional<EngineLayer>> missing_engine_layer(const layer::Layer& interface,
                                                        const std::string& engine);

/// `interface` with a variant of "Physics" on the default prim that loads `file`.
Result<layer::Layer> with_engine_variant(const layer::Layer& interface, const std::string& engine,
                                         const std::string& file);

}  // namespace tenon
