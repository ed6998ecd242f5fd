// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/math/matrix.h"
#include "tenon/stage/prim.h"
#include "tenon/stage/time.h"

namespace tenon::stage {

/// xformOps of a prim, read and multiplied; row vectors, stage units.
struct LocalTransform {
  Mat4d matrix = Mat4d::identity();
  bool resets_stack = false;  ///< "!resetXformStack!": the parent's transform does not apply
};

/// Identity for prims that are not Xformable. Unknown ops are diagnosed and taken as identity.
LocalTransform local_transform(const Prim& prim, Time time, Diagnostics* diagnostics = nullptr);

/// From the prim's space to the stage's.
Mat4d local_to_world(const Prim& prim, Time time);

/// Times at which any op of the prim or its ancestors has a sample, ascending.
std::vector<double> transform_samples(const Prim& prim);

}  // namespace tenon::stage
