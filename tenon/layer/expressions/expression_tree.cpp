// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/layer/expressions/expression_tree.h"

namespace tenon::layer {

std::string expression_text(std::span<const ExpressionNode> nodes, std::int32_t root,
                            std::span<const std::string_view> operators,
                            const std::function<void(std::string&, std::int32_t)>& append_atom) {
  struct Step {
    std::int32_t node = kNoNode;
    std::string_view text;  // when there is no node
    bool in_parentheses = false;
  };
  std::string out;
  std::vector<Step> pending;
  if (root != kNoNode) {
    pending.push_back({root, {}, false});
  }
  const auto needs_parentheses = [&](std::uint8_t parent, std::int32_t child, bool is_right) {
    const std::uint8_t op = nodes[static_cast<std::size_t>(child)].op;
    return op != kAtom && (parent < op || (parent == op && is_right));
  };
  while (!pending.empty()) {
    const Step step = pending.back();
    pending.pop_back();
    if (step.node == kNoNode) {
      out += step.text;
      continue;
    }
    if (step.in_parentheses) {
      out += '(';
      pending.push_back({kNoNode, ")", false});
    }
    const ExpressionNode& node = nodes[static_cast<std::size_t>(step.node)];
    if (node.op == kAtom) {
      append_atom(out, node.left);
    } else if (node.op == kUnary) {
      out += operators[0];
      pending.push_back({node.left, {}, needs_parentheses(node.op, node.left, false)});
    } else {
      pending.push_back({node.right, {}, needs_parentheses(node.op, node.right, true)});
      pending.push_back({kNoNode, operators[node.op - kUnary], false});
      pending.push_back({node.left, {}, needs_parentheses(node.op, node.left, false)});
    }
  }
  return out;
}

void ExpressionBuilder::reduce() {
  const std::uint8_t op = operators_.back();
  operators_.pop_back();
  const std::int32_t last = operands_.back();
  operands_.pop_back();
  if (op == kUnary) {
    operands_.push_back(make_(op, last, kNoNode));
    return;
  }
  const std::int32_t first = operands_.back();
  operands_.back() = make_(op, first, last);
}

void ExpressionBuilder::operation(std::uint8_t op) {
  while (!operators_.empty() && operators_.back() != kOpen &&
         (operators_.back() < op || (operators_.back() == op && op != kUnary))) {
    reduce();
  }
  operators_.push_back(op);
}

void ExpressionBuilder::close() {
  while (operators_.back() != kOpen) {
    reduce();
  }
  operators_.pop_back();
  --depth_;
}

std::int32_t ExpressionBuilder::finish() {
  while (!operators_.empty()) {
    reduce();
  }
  return operands_.back();
}

}  // namespace tenon::layer
