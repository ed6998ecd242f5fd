// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/base/diagnostics.h"
#include "tenon/math/matrix.h"
#include "tenon/stage/prim.h"
#include "tenon/stage/time.h"

/// Single transform operations. Internal to tenon/stage.
namespace tenon::stage {

/// The parts of `!invert!xformOp:translate:pivot`.
struct XformOp {
  Token attribute;  ///< xformOp:translate:pivot
  Token kind;       ///< translate
  bool inverted = false;
};

/// Names without the prefix "xformOp:" have an empty kind.
XformOp parse_xform_op(Token name);

/// Row-vector matrix of the operation at a time; identity when its attribute is missing, has no
/// value or is of an unknown kind or type (diagnosed as "xform.op").
Mat4d xform_op_matrix(const Prim& prim, const XformOp& op, Time time, Diagnostics* diagnostics);

}  // namespace tenon::stage
