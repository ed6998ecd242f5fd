// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "tenon/base/result.h"
#include "tenon/scene/physics_scene.h"

/// The description as bytes, for other processes and machines of the same byte order: a head that
/// names the form, then every field in the order of the tables.
namespace tenon::scene {

std::string wire_form(const PhysicsScene& scene);

/// The scene encoded by all of `bytes`; equal to the original, bit by bit. Untrusted bytes are
/// checked. Errors: Corrupt; Unsupported where a build with other fields wrote them.
Result<PhysicsScene> read_wire_form(std::string_view bytes);

/// Differs between scenes that differ in any field, provenance included.
std::uint64_t scene_hash(const PhysicsScene& scene);

/// Of one mesh: equal meshes of any scenes have one hash.
std::uint64_t mesh_hash(const TriangleMesh& mesh);

}  // namespace tenon::scene
