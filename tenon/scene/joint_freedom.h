// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "tenon/scene/physics_scene.h"

/// Which degrees of freedom a joint leaves, and within which bounds.
namespace tenon::scene {

/// Revolute, prismatic, distance: `lower` and `upper` are of their one degree of freedom.
bool has_one_dof(const Joint& joint);
/// "transX" .. "rotZ", "distance".
std::optional<Dof> dof_of(std::string_view token);
/// The bounds that hold for one degree of freedom; open ones when it has none. Unlimited for axes
/// that the joint's type locks: ask `is_locked` first.
Limit limit_of(const Joint& joint, Dof dof);
/// The joint's type or a limit holds this degree of freedom in place.
bool is_locked(const Joint& joint, Dof dof);
/// The joint can be part of a tree of joint coordinates (S-114).
bool is_reducible(const Joint& joint);
/// Without drives, mimic, limits by LimitAPI, armature, friction, damping and spring.
bool is_plain(const Joint& joint);
/// A load on the joint ends it (S-93).
bool can_break(const Joint& joint);
/// A spherical joint's cone with one angle for both directions, or kUnlimited [rad].
double circular_cone(const Joint& joint);
/// The joint is fully defined by how its two frames may be placed: nothing acts on a coordinate, so
/// it is a simple constraint where it closes a loop. Fixed joints, and plain revolute or spherical
/// ones without bounds except for a circular cone.
bool is_held_by_frames(const Joint& joint);
/// A fixed joint between the same sides and frames, which collide and belong to an articulation as
/// those of `joint`.
Joint fixed_in_place_of(const Joint& joint);

}  // namespace tenon::scene
