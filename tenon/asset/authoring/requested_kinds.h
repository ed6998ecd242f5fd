// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/asset/authoring/add_edits.h"
#include "tenon/asset/authoring/kinds.h"
#include "tenon/base/path.h"
#include "tenon/base/result.h"
#include "tenon/stage/prim.h"

/// Internal to the wiring.
namespace tenon {

/// One PATH=KIND,KIND of a request.
struct RequestedKinds {
  Path prim;
  std::vector<const AuthoringKind*> kinds;  ///< empty: the prim as a whole
};

/// Errors: Invalid (edit.bad-path, edit.unknown-kind with the nearest name).
Result<RequestedKinds> read_requested(const std::string& text, bool kinds_needed);

/// Each option that is given is one of the kinds'. Errors: Invalid (edit.bad-argument).
Result<void> check_options(const AuthoringRequest& request,
                           const std::vector<RequestedKinds>& requested);

/// The lists of IsaacRobotAPI.
inline constexpr const char* kRobotLinks = "isaac:physics:robotLinks";
inline constexpr const char* kRobotJoints = "isaac:physics:robotJoints";
/// This list of the robot that contains `prim`; empty where there is no robot, or it has no such
/// list.
Path robot_list(const Stages& stages, Path prim, const char* list);

/// The prim under the first selection that has it; an invalid one where none has.
stage::Prim find_in(const Stages& stages, Path prim);
/// The same. Errors: NotFound (edit.no-prim).
Result<stage::Prim> need_in(const Stages& stages, Path prim);

/// The instance of an API schema of a kind for joints of a type: what --dof says, or the only one
/// of a hinge or slider, empty for others.
std::string instance_of(Token joint, const AuthoringKind& kind,
                        const std::map<std::string, std::string>& options);
/// "limit:*:physics:low" -> "limit:rotX:physics:low".
std::string with_instance(std::string_view name, const std::string& instance);
/// A hinge and a slider have their limits in properties of their own.
bool has_own_limits(Token joint);

}  // namespace tenon
