// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Operators over atoms, as path expressions and their predicates have them. An operator is its
/// precedence: a smaller number binds tighter; 0 is an atom and 1 the one unary operator.
namespace tenon::layer {

inline constexpr std::uint8_t kAtom = 0;
inline constexpr std::uint8_t kUnary = 1;
inline constexpr std::int32_t kNoNode = -1;

struct ExpressionNode {
  std::uint8_t op = kAtom;
  std::int32_t left = kNoNode;   ///< the one operand of the unary operator; of atoms their number
  std::int32_t right = kNoNode;  ///< of binary operators
  bool operator==(const ExpressionNode&) const = default;
};

/// Infix text of the tree below `root`: parentheses only where they are needed. `operators` are
/// the texts of the operators 1, 2, ...
std::string expression_text(std::span<const ExpressionNode> nodes, std::int32_t root,
                            std::span<const std::string_view> operators,
                            const std::function<void(std::string&, std::int32_t)>& append_atom);

/// Turns operands and operators as they are read into nodes, by precedence; operators of equal
/// precedence group to the left.
class ExpressionBuilder {
 public:
  /// Makes the node of an operator over one or two operands; returns its number.
  using Make = std::function<std::int32_t(std::uint8_t op, std::int32_t left, std::int32_t right)>;
  explicit ExpressionBuilder(Make make) : make_(std::move(make)) {}

  void operand(std::int32_t node) { operands_.push_back(node); }
  void operation(std::uint8_t op);
  void open() {
    operators_.push_back(kOpen);
    ++depth_;
  }
  /// Inside a group.
  bool is_open() const { return depth_ > 0; }
  void close();
  std::int32_t finish();

 private:
  static constexpr std::uint8_t kOpen = 255;
  void reduce();

  Make make_;
  std::size_t depth_ = 0;
  std::vector<std::int32_t> operands_;
  std::vector<std::uint8_t> operators_;
};

}  // namespace tenon::layer
