// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/asset/authoring/add_edits.h"
#include "tenon/base/result.h"

namespace tenon {

/// A request whose paths are patterns (NamePattern), as one whose paths are those of all prims
/// that they mean under any selection: of a kind that is put on one type those of that type, of
/// colliders shapes and meshes, of drives and limits no fixed joints. Prims that have the kind
/// already are skipped, and so is what is inside of instances. Errors: those of reading requests
/// and patterns; Invalid (edit.bad-argument) for kinds that make prims; NotFound (edit.no-prim)
/// where a pattern means no prim.
Result<AuthoringRequest> matched_request(const Stages& stages, const AuthoringRequest& request);

}  // namespace tenon
