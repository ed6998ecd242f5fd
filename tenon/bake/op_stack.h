// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "tenon/base/token.h"
#include "tenon/layer/layer.h"
#include "tenon/math/matrix.h"
#include "tenon/stage/prim.h"

namespace tenon::bake {

/// How a prim's local transform is written over time: on the translate, orient or rotate ops that
/// it has (or on translate and orient ops that it gets), with its scale op left alone; or, where
/// scale or shear do not allow that, as one matrix op (S-35).
class OpStack {
 public:
  /// Looks at the prim's xformOpOrder. `start_code` is the stage time at which its scale is read.
  static OpStack of(const stage::Prim& prim, double start_code);

  /// Collects one sample. False when a translate and orient op cannot express the matrix; the
  /// caller then starts over with `as_matrix`.
  bool add(double code, const Mat4d& local);
  void use_matrix();

  /// Writes op order and samples to the prim's spec in `layer`.
  void write(layer::Layer& layer, Path prim) const;

 private:
  void write_angles(layer::Layer& layer, Path prim) const;

  Token translate_type_ = "double3";
  Token orient_;  // name of the op that gets the orientations, quatd
  Token rotate_;  // rotate op that gets them instead; empty: none, or it cannot hold them
  Token rotate_type_;
  bool has_scale_ = false;
  Vec3d scale_{{1, 1, 1}};
  bool resets_stack_ = false;
  bool has_translate_ = false;
  bool has_orient_ = false;
  bool as_matrix_ = false;
  std::vector<double> codes_;
  std::vector<Vec3d> translations_;
  std::vector<Quatd> orientations_;
  std::vector<Vec3d> angles_;  // of rotate_, about x, y, z [deg]
  std::vector<Mat4d> matrices_;
};

}  // namespace tenon::bake
