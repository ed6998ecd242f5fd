// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/engines/jolt/model.h"

namespace tenon::engines::jolt {

/// Where colliders touched at the beginning of the last step, and what they exerted during it.
std::vector<Contact> read_contacts(const scene::PhysicsScene& scene, const Model& model);

}  // namespace tenon::engines::jolt
