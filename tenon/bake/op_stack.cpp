// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Ops are kept where they are translate, one rotation and scale, in this order and each at most
// once: then local = scale * rotation * translation with row vectors, and with the scale constant
// every rigid motion fits. If the matrix without the scale is not a rotation to 1e-6, the caller
// starts over with one matrix op, which holds anything. A rotation is kept as a quaternion, in the
// sign nearer to the one before so that interpolation takes the short way, and as angles that
// continue the last ones. The angles are given up for good when one sample does not fit them; the
// quaternions always do.
#include "tenon/bake/op_stack.h"

#include <cmath>
#include <string_view>

#include "tenon/bake/euler.h"
#include "tenon/bake/over_specs.h"
#include "tenon/math/transform.h"

namespace tenon::bake {
namespace {

using layer::TimeSamples;
using layer::Value;

const Token kTranslate{"xformOp:translate"};
const Token kOrient{"xformOp:orient"};
// Beside an orient op of single precision: OpenUSD takes the angle of such a quaternion by the arc
// cosine of its real part, which loses turns below 3e-4 rad.
const Token kBakedOrient{"xformOp:orient:baked"};
const Token kScale{"xformOp:scale"};
const Token kTransform{"xformOp:transform"};
const Token kReset{"!resetXformStack!"};
const Token kOrder{"xformOpOrder"};

bool is_plain_rotation(Token op) {
  static const Token kPlain[] = {"xformOp:rotateX",   "xformOp:rotateY",   "xformOp:rotateZ",
                                 "xformOp:rotateXYZ", "xformOp:rotateXZY", "xformOp:rotateYXZ",
                                 "xformOp:rotateYZX", "xformOp:rotateZXY", "xformOp:rotateZYX"};
  for (const Token& plain : kPlain) {
    if (op == plain) {
      return true;
    }
  }
  return false;
}

std::optional<Vec3d> read_vector(const Value& value) {
  if (const auto* d = value.get<Vec3d>()) {
    return *d;
  }
  if (const auto* f = value.get<Vec3f>()) {
    return to_double(*f);
  }
  if (const auto* h = value.get<Vec3h>()) {
    return to_double(*h);
  }
  return std::nullopt;
}

Value vector_value(const Vec3d& v, Token type) {
  return type == "float3" ? Value(to_float(v)) : Value(v);
}

/// Half precision loses turns of a fraction of a degree.
bool can_hold_angles(Token type) {
  return type == "float" || type == "double" || type == "float3" || type == "double3";
}

/// The axis of an op about one; 3 of one about three.
std::size_t axis_of(Token op) {
  constexpr std::size_t kBefore = std::string_view("xformOp:rotate").size();
  const std::string_view order = op.view().substr(kBefore);
  return order.size() == 1 ? static_cast<std::size_t>(order[0] - 'X') : 3;
}

/// What a rotate op says, about x, y, z [deg]; zero where it says nothing.
Vec3d angles_at(const Value& value, Token op) {
  const std::size_t axis = axis_of(op);
  Vec3d angles;
  if (axis < 3) {
    const auto* wide = value.get<double>();
    angles[axis] = wide != nullptr ? *wide : static_cast<double>(value.get_or<float>(0));
    return angles;
  }
  return read_vector(value).value_or(angles);
}

Value angle_value(const Vec3d& angles, Token op, Token type) {
  const std::size_t axis = axis_of(op);
  if (axis < 3) {
    return type == "float" ? Value(static_cast<float>(angles[axis])) : Value(angles[axis]);
  }
  return vector_value(angles, type);
}

/// Translate, then one rotation, then scale: each at most once, in this order.
enum class Stage : unsigned char { Start, Translated, Rotated, Scaled };

std::optional<Stage> after(Stage stage, Token op) {
  if (op == kTranslate && stage == Stage::Start) {
    return Stage::Translated;
  }
  if ((op == kOrient || is_plain_rotation(op)) && stage <= Stage::Translated) {
    return Stage::Rotated;
  }
  if (op == kScale && stage <= Stage::Rotated) {
    return Stage::Scaled;
  }
  return std::nullopt;
}

/// What remains of `local` = scale * rotation * translation without the scale; empty where that is
/// not a rotation.
std::optional<Mat3d> rotation_without(const Vec3d& scale, const Mat4d& local) {
  Mat3d rigid = upper_left(local);
  for (std::size_t row = 0; row < 3; ++row) {
    if (!(std::fabs(scale[row]) > 0)) {
      return std::nullopt;
    }
    for (double& number : rigid[row]) {
      number /= scale[row];
    }
  }
  const Mat3d product = rigid * transpose(rigid);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (std::fabs(product[i][j] - (i == j ? 1 : 0)) > 1e-6) {
        return std::nullopt;
      }
    }
  }
  return determinant(rigid) < 0 ? std::nullopt : std::optional(rigid);
}

}  // namespace

OpStack OpStack::of(const stage::Prim& prim, double start_code) {
  OpStack stack;
  auto order = prim.attribute(kOrder).get_as<layer::Array<Token>>().value_or(std::vector<Token>{});
  if (!order.empty() && order.front() == kReset) {
    stack.resets_stack_ = true;
    order.erase(order.begin());
  }
  bool has_translate = false;
  bool has_orient = false;
  Stage at = Stage::Start;
  for (const Token& op : order) {
    const auto next = after(at, op);
    if (!next) {
      stack.use_matrix();
      return stack;
    }
    at = *next;
    has_translate = has_translate || op == kTranslate;
    if (is_plain_rotation(op) && can_hold_angles(prim.attribute(op).type_name())) {
      stack.rotate_ = op;
      stack.rotate_type_ = prim.attribute(op).type_name();
      stack.angles_.push_back(angles_at(prim.attribute(op).get(start_code), op));
    }
    has_orient = has_orient || (op == kOrient && prim.attribute(op).type_name() == "quatd");
    if (op == kScale) {
      const auto scale = read_vector(prim.attribute(kScale).get(start_code));
      if (!scale) {
        stack.use_matrix();
        return stack;
      }
      stack.has_scale_ = true;
      stack.scale_ = *scale;
    }
  }
  // A half-precision translate cannot hold a pose: it becomes a double3.
  if (has_translate && prim.attribute(kTranslate).type_name() == "float3") {
    stack.translate_type_ = "float3";
  }
  stack.orient_ = has_orient ? kOrient : kBakedOrient;
  stack.has_orient_ = has_orient;
  stack.has_translate_ = has_translate;
  return stack;
}

void OpStack::use_matrix() {
  as_matrix_ = true;
  codes_.clear();
}

bool OpStack::add(double code, const Mat4d& local) {
  codes_.push_back(code);
  if (as_matrix_) {
    matrices_.push_back(local);
    return true;
  }
  const std::optional<Mat3d> rigid = rotation_without(scale_, local);
  if (!rigid) {
    return false;
  }
  Quatd q = rotation_of(*rigid);
  if (!orientations_.empty() && dot(orientations_.back(), q) < 0) {
    q = {-q.x, -q.y, -q.z, -q.w};
  }
  orientations_.push_back(q);
  if (!rotate_.empty()) {
    if (const auto angles = euler_degrees(*rigid, rotate_, angles_.back())) {
      angles_.push_back(*angles);
    } else {
      rotate_ = {};
    }
  }
  translations_.push_back({{local[3][0], local[3][1], local[3][2]}});
  return true;
}

void OpStack::write_angles(layer::Layer& layer, Path prim) const {
  TimeSamples samples;
  for (std::size_t i = 0; i < codes_.size(); ++i) {
    samples.set(codes_[i], angle_value(angles_[i + 1], rotate_, rotate_type_));
  }
  over_attribute(layer, prim, rotate_, rotate_type_)
      .set(layer::fields::timeSamples, Value(std::move(samples)));
}

void OpStack::write(layer::Layer& layer, Path prim) const {
  std::vector<Token> order;
  if (resets_stack_) {
    order.push_back(kReset);
  }
  if (as_matrix_) {
    order.push_back(kTransform);
    TimeSamples samples;
    for (std::size_t i = 0; i < codes_.size(); ++i) {
      samples.set(codes_[i], Value(matrices_[i]));
    }
    over_attribute(layer, prim, kTransform, "matrix4d")
        .set(layer::fields::timeSamples, Value(std::move(samples)));
  } else {
    const bool rotates = !rotate_.empty();
    order.insert(order.end(), {kTranslate, rotates ? rotate_ : orient_});
    if (has_scale_) {
      order.push_back(kScale);
    }
    TimeSamples translations;
    TimeSamples orientations;
    for (std::size_t i = 0; i < codes_.size(); ++i) {
      translations.set(codes_[i], vector_value(translations_[i], translate_type_));
      orientations.set(codes_[i], Value(orientations_[i]));
    }
    over_attribute(layer, prim, kTranslate, translate_type_)
        .set(layer::fields::timeSamples, Value(std::move(translations)));
    if (rotates) {
      write_angles(layer, prim);
    } else {
      over_attribute(layer, prim, orient_, "quatd")
          .set(layer::fields::timeSamples, Value(std::move(orientations)));
    }
  }
  if (as_matrix_ || !has_translate_ || (!has_orient_ && rotate_.empty())) {
    layer::Spec& spec = over_attribute(layer, prim, kOrder, "token[]");
    spec.set(layer::fields::variability, Value(layer::Variability::Uniform));
    spec.set(layer::fields::default_value, Value(std::move(order)));
  }
}

}  // namespace tenon::bake
