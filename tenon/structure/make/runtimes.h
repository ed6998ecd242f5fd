// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "tenon/layer/dictionary.h"
#include "tenon/layer/layer.h"
#include "tenon/structure/layout.h"
#include "tenon/structure/make/source_views.h"

/// The variant sets of SimReady, one for each engine, beside "Physics" of Asset Structure 3.0.
namespace tenon::structure {

/// An engine with a set of its own on the default prim: "Disabled" has nothing, "Enabled" the file
/// as its payload.
struct Runtime {
  std::string_view set;
  Role role;
  std::string_view file;  ///< in the asset's folder
};
inline constexpr std::string_view kEnabled = "Enabled";
inline constexpr std::string_view kDisabled = "Disabled";

std::span<const Runtime> known_runtimes();
/// What a source composes to with its own set of the runtime enabled; null where it has none.
const layer::Layer* enabled_content(const std::vector<OtherVariant>& others,
                                    const Runtime& runtime);
bool is_runtime_set(std::string_view set);

/// Takes out Newton's schemas and what they declare, which SimReady counts to its runtime alone; of
/// meshes that only collide it stays, because nothing can be said on them outside of their
/// instance. `but_contacts`: so do NewtonCollisionAPI, contact gaps and margins.
void drop_newton(layer::Layer& content, bool but_contacts = false);

/// Takes physics out of the materials that are in no instance, for physics.usda to give it to them.
void drop_material_physics(layer::Layer& content);

/// `content`, the physics of a robot with the schemas of one engine and of Newton, as it is with
/// the runtime enabled: with no schema of another one. What the engine asks for and other schemas
/// say is said in its own. Joints that nothing moves get what exerts no force: a drive without
/// gains, for MuJoCo an actuator, which passes on the force that it is given.
layer::Layer runtime_content(const Runtime& runtime, layer::Layer content);

/// Puts into SimReady_Metadata of `data` which variants of the robot enable which engine.
void tell_runtimes(layer::Dictionary& data, Path robot);

}  // namespace tenon::structure
