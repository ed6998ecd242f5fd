// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cli/report.h"
#include "tenon/physics/accounts.h"
#include "tenon/stage/stage.h"

namespace tenon::cli {

/// A stage with what physics made of it, for those who ask where a number comes from.
struct Explained {
  const stage::Stage& stage;
  physics::PhysicsScene scene;
  physics::Accounts accounts;
};

/// {"prim", "type", "apis", "specs", "body", "collider", "joint", "material", "scene", "group",
/// "articulation", "properties"}: those that the prim is.
Json explain_prim(const Explained& explained, const stage::Prim& prim);
std::string explain_prim_text(const Json& answer);

/// {"prim", "property", "type", "value", "source", "fallback", "opinions", "mass"}.
Json explain_property(const Explained& explained, const stage::Prim& prim, Token property);
std::string explain_property_text(const Json& answer);

/// {"pair", "collide", "pairs": [{"a", "b", "collide", "reasons": [...]}]}: every collider at or
/// below the one prim (or of the body that it is) against every one of the other.
Json explain_pair(const Explained& explained, const stage::Prim& a, const stage::Prim& b);
std::string explain_pair_text(const Json& answer);

/// Parts of `explain_prim`.
Json joint_json(const Explained& explained, physics::Index joint);
std::string joint_text(const Json& joint);
Json binding_json(const Explained& explained, const physics::Collider& collider);
std::string binding_text(const Json& binding);

}  // namespace tenon::cli
