// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// xformOpOrder lists operations outermost first; with row vectors the matrix is the product of the
// list read backwards. An operation next to its own inverse cancels without being computed.
#include "tenon/stage/transform_at.h"

#include <algorithm>
#include <set>
#include <span>

#include "tenon/stage/xform_op.h"

namespace tenon::stage {
namespace {

const Token kOpOrder{"xformOpOrder"};
const Token kXformable{"Xformable"};

/// The operations of a prim, outermost first: those after the last "!resetXformStack!".
struct OpOrder {
  layer::Value value;  // that holds them, where no layer does
  std::span<const Token> ops;
  bool resets = false;
};

OpOrder op_order(const Prim& prim) {
  static const Token reset{"!resetXformStack!"};
  OpOrder order;
  const Attribute attribute = prim.attribute(kOpOrder);
  const layer::Value* value = attribute.value_in_place();
  if (value == nullptr) {
    order.value = attribute.get();
    value = &order.value;
  }
  if (const auto* ops = value->get<std::vector<Token>>()) {
    const auto last = std::find(ops->rbegin(), ops->rend(), reset);
    order.resets = last != ops->rend();
    order.ops = std::span(*ops).subspan(static_cast<std::size_t>(ops->rend() - last));
  }
  return order;
}

}  // namespace

LocalTransform local_transform(const Prim& prim, Time time, Diagnostics* diagnostics) {
  LocalTransform result;
  if (!prim.is_a(kXformable)) {
    return result;
  }
  const OpOrder order = op_order(prim);
  result.resets_stack = order.resets;
  for (std::size_t i = order.ops.size(); i-- > 0;) {
    const XformOp op = parse_xform_op(order.ops[i]);
    if (i > 0) {
      const XformOp next = parse_xform_op(order.ops[i - 1]);
      if (next.attribute == op.attribute && next.inverted != op.inverted) {
        --i;
        continue;
      }
    }
    result.matrix = result.matrix * xform_op_matrix(prim, op, time, diagnostics);
  }
  return result;
}

Mat4d local_to_world(const Prim& prim, Time time) {
  Mat4d result = Mat4d::identity();
  for (Prim at = prim; at && !at.is_pseudo_root(); at = at.parent()) {
    const LocalTransform local = local_transform(at, time);
    result = result * local.matrix;
    if (local.resets_stack) {
      break;
    }
  }
  return result;
}

Mat4d local_to_ancestor(const Prim& prim, Path ancestor, Time time) {
  Mat4d result = Mat4d::identity();
  for (Prim at = prim; at && !(at.path() == ancestor); at = at.parent()) {
    result = result * local_transform(at, time).matrix;
  }
  return result;
}

std::vector<double> transform_samples(const Prim& prim) {
  std::set<double> times;
  for (Prim at = prim; at && !at.is_pseudo_root(); at = at.parent()) {
    if (!at.is_a(kXformable)) {
      continue;
    }
    const OpOrder order = op_order(at);
    for (const Token name : order.ops) {
      const std::vector<double> samples =
          at.attribute(parse_xform_op(name).attribute).time_samples();
      times.insert(samples.begin(), samples.end());
    }
    if (order.resets) {
      break;
    }
  }
  return {times.begin(), times.end()};
}

const Mat4d& TransformCache::local_to_world(const Prim& prim) {
  const Path path = prim.path();
  if (const auto it = world_.find(path); it != world_.end()) {
    return it->second;
  }
  // From the nearest known ancestor down, without recursion.
  std::vector<Prim> chain;
  Mat4d world = Mat4d::identity();
  for (Prim at = prim; at && !at.is_pseudo_root(); at = at.parent()) {
    const auto it = world_.find(at.path());
    if (it != world_.end()) {
      world = it->second;
      break;
    }
    chain.push_back(at);
  }
  for (auto at = chain.rbegin(); at != chain.rend(); ++at) {
    const LocalTransform local = local_transform(*at, time_);
    world = local.resets_stack ? local.matrix : local.matrix * world;
    world_.emplace(at->path(), world);
  }
  return world_.try_emplace(path, world).first->second;
}

}  // namespace tenon::stage
