// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/check/rule.h"

/// What `--fix` does, one function per kind of fix. Each gives nothing where it would have to guess
/// or where no file holds the opinion.
namespace tenon::check {

FixFunction fix_metadata;           ///< writes down the value that counts
FixFunction fix_default_prim;       ///< where there is one root prim
FixFunction fix_selection;          ///< where one variant differs in capitals only
FixFunction fix_unselected;         ///< selects "physics"
FixFunction fix_quaternion_length;  ///< of localRot0, localRot1, principalAxes, orient
FixFunction fix_rotation_zero;
FixFunction fix_dynamic_mesh;
FixFunction fix_friction_order;
FixFunction fix_restitution;
FixFunction fix_negative_gravity;
FixFunction fix_mesh_api;
FixFunction fix_material_api;
FixFunction fix_nested_root;
FixFunction fix_binding_api;
FixFunction fix_guide_purpose;

/// What findings of a rule suggest beside safe fixes: the name or type that their message knows.
/// Null: nothing.
FixFunction* suggestion_for(std::string_view rule);

}  // namespace tenon::check
