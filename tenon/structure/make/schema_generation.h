// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>

#include "tenon/base/diagnostics.h"
#include "tenon/structure/make/make_package.h"
#include "tenon/structure/make/source_views.h"

namespace tenon::structure {

/// Says joints of one axis in vendors' schemas of a generation:
///
///   legacy                              current
///   PhysxMimicJointAPI:rot<A>           NewtonMimicAPI    gearing = -coef1, offset = -coef0
///   PhysxJointAPI                       PhysxJointAxisAPI:angular|linear
///                                       armature, maxJointVelocity alike
///
/// What the other generation cannot say stays as it is, with an Info "structure.schema-kept": the
/// compliance of PhysX's mimic joints, `jointFriction`, which has no unit, efforts of friction,
/// samples, joints of several axes. NewtonMimicAPI is for every engine: a law that only some
/// variants of "Physics" have in a legacy schema then holds in all that have the joint (Info
/// "structure.mimic-in-all"). The names of these variants are returned.
std::set<std::string> use_generation(SourceViews& views, SchemaGeneration generation,
                                     Diagnostics& diagnostics);

}  // namespace tenon::structure
