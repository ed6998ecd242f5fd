// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Vectors are rows: in a product of matrices the left one acts first. An inverted operation is
// built from inverted numbers: the opposite translation or angle, the reciprocal scale, the
// conjugate quaternion, Euler angles in reverse order. Only a full matrix is inverted numerically.
// An operation that cannot be read counts as identity and is reported, unless its attribute just
// has no value.
#include "tenon/stage/xform_op.h"

#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "tenon/base/containers/token_memo.h"
#include "tenon/layer/fields.h"
#include "tenon/layer/finding_place.h"

namespace tenon::stage {
namespace {

using layer::Value;

std::optional<double> scalar(const Value& value) {
  if (const auto* x = value.get<double>()) {
    return *x;
  }
  if (const auto* x = value.get<float>()) {
    return static_cast<double>(*x);
  }
  if (const auto* x = value.get<Half>()) {
    return static_cast<double>(float(*x));
  }
  return std::nullopt;
}

std::optional<Vec3d> vector(const Value& value) {
  if (const auto* x = value.get<Vec3d>()) {
    return *x;
  }
  if (const auto* x = value.get<Vec3f>()) {
    return to_double(*x);
  }
  if (const auto* x = value.get<Vec3h>()) {
    return to_double(*x);
  }
  return std::nullopt;
}

std::optional<Quatd> quaternion(const Value& value) {
  if (const auto* x = value.get<Quatd>()) {
    return *x;
  }
  if (const auto* x = value.get<Quatf>()) {
    return to_double(*x);
  }
  if (const auto* x = value.get<Quath>()) {
    return to_double(*x);
  }
  return std::nullopt;
}

// As OpenUSD reads a quaternion that is not of unit length: the axis is normalised, the angle comes
// from the real part alone.
Quatd as_rotation(const Quatd& q) {
  const double length = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z);
  if (!(length > 1e-10)) {
    return kIdentityRotation;
  }
  const double real = std::fmin(1.0, std::fmax(-1.0, q.w));
  const double s = std::sin(std::acos(real)) / length;
  return {q.x * s, q.y * s, q.z * s, real};
}

Mat4d rotation(int axis, double degrees) {
  Vec3d direction;
  direction[static_cast<std::size_t>(axis)] = 1;
  return to_mat4(rotation_matrix(rotation_about(direction, degrees * std::numbers::pi / 180)));
}

int axis_of(char letter) { return letter - 'X'; }

// "rotateZYX": about Z first, then Y, then X.
Mat4d euler(std::string_view axes, const Vec3d& degrees, bool inverted) {
  Mat4d result = Mat4d::identity();
  for (const char letter : axes) {
    const int axis = axis_of(letter);
    const double angle = degrees[static_cast<std::size_t>(axis)];
    result = inverted ? rotation(axis, -angle) * result : result * rotation(axis, angle);
  }
  return result;
}

struct Reader {
  std::string_view kind;
  const Value& value;
  bool inverted;

  Mat4d translation(Vec3d t) const { return translation_matrix(inverted ? -t : t); }
  Mat4d scaling(Vec3d s) const {
    return scale_matrix(inverted ? Vec3d{{1 / s[0], 1 / s[1], 1 / s[2]}} : s);
  }

  // translateX, scaleY, rotateZ
  std::optional<Mat4d> along_axis() const {
    const char letter = kind.back();
    const std::optional<double> x = scalar(value);
    if (!x || letter < 'X' || letter > 'Z') {
      return std::nullopt;
    }
    const auto axis = static_cast<std::size_t>(axis_of(letter));
    const std::string_view stem = kind.substr(0, kind.size() - 1);
    if (stem == "rotate") {
      return rotation(axis_of(letter), inverted ? -*x : *x);
    }
    Vec3d v = stem == "scale" ? Vec3d{{1, 1, 1}} : Vec3d();
    v[axis] = *x;
    if (stem == "translate") {
      return translation(v);
    }
    return stem == "scale" ? std::optional<Mat4d>(scaling(v)) : std::nullopt;
  }

  std::optional<Mat4d> of_vector() const {
    const std::optional<Vec3d> v = vector(value);
    if (!v) {
      return std::nullopt;
    }
    if (kind == "translate") {
      return translation(*v);
    }
    if (kind == "scale") {
      return scaling(*v);
    }
    static constexpr std::array<std::string_view, 6> kOrders{"XYZ", "XZY", "YXZ",
                                                             "YZX", "ZXY", "ZYX"};
    for (const std::string_view order : kOrders) {
      if (kind.starts_with("rotate") && kind.substr(6) == order) {
        return euler(order, *v, inverted);
      }
    }
    return std::nullopt;
  }

  std::optional<Mat4d> matrix() const {
    if (kind == "transform") {
      const auto* m = value.get<Mat4d>();
      return m == nullptr ? std::nullopt : std::optional(inverted ? inverse(*m) : *m);
    }
    if (kind == "orient") {
      const std::optional<Quatd> q = quaternion(value);
      if (!q) {
        return std::nullopt;
      }
      const Quatd unit = as_rotation(*q);
      return to_mat4(rotation_matrix(inverted ? conjugate(unit) : unit));
    }
    const std::optional<Mat4d> result = of_vector();
    return result || kind.empty() ? result : along_axis();
  }
};

}  // namespace

namespace {

XformOp parse_name(Token name) {
  XformOp op;
  std::string_view text = name.view();
  static constexpr std::string_view kInvert = "!invert!";
  static constexpr std::string_view kPrefix = "xformOp:";
  if (text.starts_with(kInvert)) {
    op.inverted = true;
    text.remove_prefix(kInvert.size());
  }
  op.attribute = Token(text);
  if (text.starts_with(kPrefix)) {
    text.remove_prefix(kPrefix.size());
    op.kind = Token(text.substr(0, text.find(':')));
  }
  return op;
}

}  // namespace

XformOp parse_xform_op(Token name) {
  thread_local TokenMemo<XformOp, 64> known;
  return known.find_or_make(name, parse_name);
}

Mat4d xform_op_matrix(const Prim& prim, const XformOp& op, Time time, Diagnostics* diagnostics) {
  const Attribute attribute = prim.attribute(op.attribute);
  Value read;
  const Value* value = time.is_default() ? attribute.value_in_place() : nullptr;
  if (value == nullptr) {
    read = attribute.get(time);
    value = &read;
  }
  std::optional<Mat4d> result;
  if (!value->empty()) {
    result = Reader{op.kind.view(), *value, op.inverted}.matrix();
  }
  if (!result && diagnostics != nullptr && !(value->empty() && attribute.is_defined())) {
    const std::string item = (op.inverted ? "!invert!" : "") + op.attribute.str();
    Diagnostic diagnostic = prim.attribute("xformOpOrder")
                                .located(Severity::Warning, "xform.op",
                                         "`" + op.attribute.str() +
                                             "` is not a transform operation that has a value here",
                                         layer::item_part(layer::fields::default_value, item));
    diagnostic.property = op.attribute.str();
    diagnostic.fix = "remove it from xformOpOrder or author the attribute";
    diagnostics->add(std::move(diagnostic));
  }
  return result.value_or(Mat4d::identity());
}

}  // namespace tenon::stage
