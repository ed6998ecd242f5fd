// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/dynamics/multibody.h"

/// Coordinates and bodies by the names that Python has for them.
namespace tenon::python {

/// The coordinate of a joint, a path or a name, in Multibody::coordinates(). `dof` is "rotX" and
/// the like; empty: what follows a colon in `joint`, or the only one that the joint has.
/// Errors (rules dynamics.no-joint, dynamics.no-dof): NotFound, Invalid for a name of several.
Result<std::size_t> coordinate_named(const dynamics::Multibody& multibody, const std::string& joint,
                                     const std::string& dof);

/// A body by its path or name. Errors (rule dynamics.no-body): NotFound, Invalid for a name of
/// several.
Result<scene::Index> body_named(const scene::PhysicsScene& scene, const std::string& body);

/// The start with joints, as coordinate_named knows them, put to values [m, rad]. Errors: those of
/// coordinate_named; Invalid (rule pose.bad-value) for numbers that are not finite, for followers
/// of mimics and for joints that turn as balls.
Result<dynamics::Posture> posture_from_values(
    const dynamics::Multibody& multibody,
    const std::vector<std::pair<std::string, double>>& values);

}  // namespace tenon::python
