// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/layer/value.h"
#include "tenon/math/matrix.h"
#include "tenon/stage/stage.h"

/// Small questions about prims, in the words of the validators.
namespace tenon::check::simready {

/// The applied API schema, registered or not; "PhysicsDriveAPI:angular" with its instance.
bool has_api(const stage::Prim& prim, std::string_view schema);
/// Any instance of a multiple-apply schema.
bool has_any_api(const stage::Prim& prim, std::string_view schema);
/// Instances of a multiple-apply schema, as authored too.
std::vector<std::string> api_instances(const stage::Prim& prim, std::string_view schema);

bool is_joint(const stage::Prim& prim);
/// A joint other than a fixed one.
bool is_moving_joint(const stage::Prim& prim);
/// A moving joint that is not excluded from articulations.
bool is_articulated(const stage::Prim& prim);

bool is_revolute(const stage::Prim& prim);
bool is_prismatic(const stage::Prim& prim);
/// Axes of a joint with PhysicsDriveAPI: "angular", "linear", or some of the six of other joints.
std::vector<std::string> driven_axes(const stage::Prim& joint);
/// "drive:angular:physics:maxForce".
std::string drive_name(const std::string& axis, const char* property);

/// The value of an attribute as a number, the schema's fallback included; no bool.
std::optional<double> number(const stage::Prim& prim, const std::string& name);
/// The same where it is authored.
std::optional<double> authored_number_of(const stage::Prim& prim, const std::string& name);
bool is_authored(const stage::Prim& prim, const std::string& name);
bool flag(const stage::Prim& prim, const std::string& name, bool fallback);
/// A token or a string; empty for others.
std::string text(const stage::Prim& prim, const std::string& name);
/// Targets of a relationship; none where it is not there.
std::vector<Path> targets(const stage::Prim& prim, const std::string& name);
/// The first of them as a prim; invalid where there is none.
stage::Prim target_prim(const stage::Prim& prim, const std::string& name);
/// A finite number of at least `low`.
bool is_good_number(const std::optional<double>& value, double low);
/// A non-empty array of finite numbers.
bool holds_numbers(const layer::Value& value);

/// The nearest authored purpose at or above a prim, else "default".
std::string purpose_of(const stage::Prim& prim);
/// The prim or one above it is invisible.
bool is_invisible(const stage::Prim& prim);
/// A gprim with purpose default or render.
bool is_rendered(const stage::Prim& prim);

/// Lengths of the axes of an ellipsoid that the matrix makes of a unit sphere, negative where it
/// mirrors, ascending.
std::vector<double> stretches(const Mat4d& matrix);
bool is_uniform(const std::vector<double>& stretches);

/// Materials bound to a rendered gprim and to its subsets, each once.
std::vector<stage::Prim> bound_materials(const stage::Prim& prim);
/// GeomSubsets of the family materialBind.
std::vector<stage::Prim> bound_subsets(const stage::Prim& prim);
/// A material for contacts alone, without any surface.
bool is_physics_only(const stage::Prim& material);

}  // namespace tenon::check::simready
