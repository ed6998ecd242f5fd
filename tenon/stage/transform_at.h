// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unordered_map>
#include <vector>

#include "tenon/base/diagnostics.h"
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

/// From the prim's space to that of a prim above it, as if no prim between them reset the stack.
Mat4d local_to_ancestor(const Prim& prim, Path ancestor, Time time);

/// Times at which any op of the prim or its ancestors has a sample, ascending.
std::vector<double> transform_samples(const Prim& prim);

/// local_to_world at one time with every prim's result kept: for whole stages.
class TransformCache {
 public:
  explicit TransformCache(Time time) : time_(time) {}
  const Mat4d& local_to_world(const Prim& prim);

 private:
  Time time_;
  std::unordered_map<Path, Mat4d> world_;
};

}  // namespace tenon::stage
