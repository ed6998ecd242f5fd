// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/check/simready/requirement.h"

/// The functions of requirements.def, and questions that several of them ask.
namespace tenon::check::rep0158 {

using simready::Judged;
using simready::Report;

#define TENON_REP(code, need, judge, asks) simready::Judge judge;
#include "tenon/check/rep0158/requirements.def"

/// Names in xformOpOrder of a prim that can have a transform, of those ops that are there.
std::vector<std::string> xform_op_names(const stage::Prim& prim);
/// The same in lower case.
std::vector<std::string> xform_ops(const stage::Prim& prim);
std::string lower_case(std::string text);
/// apiSchemas of the prim has this name.
bool names_api(const stage::Prim& prim, const char* schema);
/// Stock OpenUSD says that the schema is applied: those of vendors bring none with them.
bool has_stock_api(const stage::Prim& prim, const char* schema);
/// Exactly one of UsdPhysics' types of joints.
bool has_joint_type(const stage::Prim& prim);
bool has_payload(const stage::Prim& prim);
/// A joint, a body, a context, topic, service or action of ROS.
bool is_kinematic_or_ros(const stage::Prim& prim);

}  // namespace tenon::check::rep0158
