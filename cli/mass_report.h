// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/report.h"
#include "tenon/physics/accounts.h"
#include "tenon/stage/stage.h"

namespace tenon::cli {

/// Why a body has its mass properties: {"authored", "resolved", "computed", "candidates",
/// "colliders"}; each candidate with the place of the opinion that gives it.
Json mass_json(const stage::Stage& stage, const physics::PhysicsScene& scene,
               const physics::MassAccount& account);
/// The same for people.
std::string mass_text(const Json& mass, const std::string& indent);

/// `tenon physics --mass`: a row per body of what is authored, what counts and why.
Json mass_table_json(const stage::Stage& stage, const physics::PhysicsScene& scene,
                     const physics::Accounts& accounts);
std::string mass_table_text(const Json& table);

}  // namespace tenon::cli
