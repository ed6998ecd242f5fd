// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "tenon/layer/value.h"

/// Changes to the array of a weaker opinion, element by element: `edit [append 1; erase [0]]`.
/// Rules and encoding: OpenUSD 26.11.
namespace tenon::layer {

/// What one instruction does. Indices below zero count from the end of the array as it is then; an
/// instruction whose index is outside of it does nothing.
enum class ArrayEditOp : std::uint8_t {
  Write,        ///< first: literal, second: index
  WriteCopy,    ///< first: index of the source, second: index
  Insert,       ///< first: literal, second: index or kArrayEnd
  InsertCopy,   ///< first: index of the source, second: index or kArrayEnd
  Erase,        ///< first: index
  MinSize,      ///< first: size; elements added are zero or empty
  MinSizeFill,  ///< first: size, second: literal
  Resize,       ///< first: size
  ResizeFill,   ///< first: size, second: literal
  MaxSize,      ///< first: size
};
inline constexpr std::size_t kArrayEditOps = 10;

/// Where an insertion appends.
inline constexpr std::int64_t kArrayEnd = INT64_MIN;

/// True for operations with a second argument.
constexpr bool has_second_argument(ArrayEditOp op) {
  return op != ArrayEditOp::Erase && op != ArrayEditOp::MinSize && op != ArrayEditOp::Resize &&
         op != ArrayEditOp::MaxSize;
}
/// The argument that is the number of a literal: 0, 1, or 2 where there is none.
constexpr int literal_argument(ArrayEditOp op) {
  return op == ArrayEditOp::Write || op == ArrayEditOp::Insert             ? 0
         : op == ArrayEditOp::MinSizeFill || op == ArrayEditOp::ResizeFill ? 1
                                                                           : 2;
}

struct ArrayEditStep {
  ArrayEditOp op = ArrayEditOp::Write;
  std::int64_t first = 0;
  std::int64_t second = 0;
};

/// The edit as binary layers store it. Without instructions it changes nothing.
struct ArrayEdit {
  /// An array of the edited type: the elements that instructions name by number.
  Value literals;
  /// Runs of one operation: its code in the highest 8 bits and how often it follows in the others,
  /// then the arguments.
  Array<std::int64_t> instructions;

  bool operator==(const ArrayEdit&) const = default;

  /// Every run is whole, of a known operation, with sizes not below zero and literals that exist;
  /// for_each_step asks for this.
  bool is_well_formed() const;
};

/// A word in front of a run of instructions.
struct ArrayEditRun {
  static constexpr int kCountBits = 56;
  std::uint64_t code;
  std::uint64_t count;
  explicit ArrayEditRun(std::int64_t word)
      : code(static_cast<std::uint64_t>(word) >> kCountBits),
        count(static_cast<std::uint64_t>(word) & ((1ull << kCountBits) - 1)) {}
};

/// Calls `visit(const ArrayEditStep&)` for each instruction in order.
template <class Visit>
void for_each_step(const ArrayEdit& edit, Visit visit) {
  const std::span<const std::int64_t> words = edit.instructions.span();
  for (std::size_t at = 0; at < words.size();) {
    const ArrayEditRun run(words[at]);
    const auto op = static_cast<ArrayEditOp>(run.code);
    const bool two = has_second_argument(op);
    ++at;
    for (std::uint64_t i = 0; i < run.count; ++i, at += two ? 2 : 1) {
      visit(ArrayEditStep{op, words[at], two ? words[at + 1] : 0});
    }
  }
}

/// Collects instructions.
class ArrayEditBuilder {
 public:
  void add(const ArrayEditStep& step);
  /// The edit of arrays like `literals`; the builder is empty afterwards.
  ArrayEdit finish(Value literals);

 private:
  std::vector<std::int64_t> instructions_;
  std::size_t run_ = 0;  // where the last run starts
};

/// The array `weaker`, of the edited type or empty for none, after `edits`, strongest first. None
/// where they add more than limits::kArrayEditGrowth elements or `weaker` is of another type.
std::optional<Value> apply_array_edits(std::span<const ArrayEdit* const> edits,
                                       const Value& weaker);

/// The value as an array of its type, made of `elements`, which are single values of `type`.
Value make_array(ValueType type, std::span<const Value> elements);

}  // namespace tenon::layer
