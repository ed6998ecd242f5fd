// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Statements are separated by ends of line or ';'. A literal is allowed where no index is required,
// an index in [ ] where an element of the array itself is meant.
#include "tenon/formats/text/array_edit_reader.h"

#include <charconv>

#include "tenon/formats/text/literals.h"
#include "tenon/formats/text/value_reader.h"
#include "tenon/layer/field_values.h"

namespace tenon::formats::text {
namespace {

using layer::ArrayEditOp;
using layer::ArrayEditStep;
using layer::Value;

class ArrayEditReader {
 public:
  ArrayEditReader(Cursor& cursor, layer::ValueType element) : cursor_(cursor), element_(element) {}

  bool read(Value& value) {
    cursor_.accept_word("edit");
    cursor_.skip_inline();
    if (!cursor_.accept('[')) {
      return cursor_.fail_expected("'[' after `edit`");
    }
    if (!read_statements(cursor_, ']', "of the edit", [&] { return read_statement(); })) {
      return false;
    }
    value = Value(builder_.finish(layer::make_array(element_, literals_)));
    return true;
  }

 private:
  bool read_statement() {
    if (cursor_.accept_word("write")) {
      return read_placed(ArrayEditOp::Write, ArrayEditOp::WriteCopy, "to");
    }
    if (cursor_.accept_word("insert")) {
      return read_placed(ArrayEditOp::Insert, ArrayEditOp::InsertCopy, "at");
    }
    if (cursor_.accept_word("prepend")) {
      return read_end(0);
    }
    if (cursor_.accept_word("append")) {
      return read_end(layer::kArrayEnd);
    }
    if (cursor_.accept_word("erase")) {
      cursor_.skip_inline();
      ArrayEditStep step{ArrayEditOp::Erase, 0, 0};
      return read_index(step.first) && add(step);
    }
    if (cursor_.accept_word("minsize")) {
      return read_size(ArrayEditOp::MinSize, ArrayEditOp::MinSizeFill);
    }
    if (cursor_.accept_word("resize")) {
      return read_size(ArrayEditOp::Resize, ArrayEditOp::ResizeFill);
    }
    if (cursor_.accept_word("maxsize")) {
      return read_size(ArrayEditOp::MaxSize, ArrayEditOp::MaxSize);
    }
    return cursor_.fail_expected(
        "`write`, `insert`, `prepend`, `append`, `erase`, `minsize`, `resize` or `maxsize`");
  }

  bool add(const ArrayEditStep& step) {
    builder_.add(step);
    return true;
  }

  /// `write 1 to [2]`, `insert [0] at [2]`
  bool read_placed(ArrayEditOp literal, ArrayEditOp copy, std::string_view word) {
    ArrayEditStep step;
    if (!read_element(literal, copy, step)) {
      return false;
    }
    cursor_.skip_inline();
    if (!cursor_.accept_word(word)) {
      return cursor_.fail_expected("`" + std::string(word) + "` and an index");
    }
    cursor_.skip_inline();
    return read_index(step.second) && add(step);
  }

  /// `append 1`, `prepend [2]`
  bool read_end(std::int64_t index) {
    ArrayEditStep step;
    step.second = index;
    return read_element(ArrayEditOp::Insert, ArrayEditOp::InsertCopy, step) && add(step);
  }

  /// The first argument of a step, which becomes `literal` or `copy`.
  bool read_element(ArrayEditOp literal, ArrayEditOp copy, ArrayEditStep& step) {
    cursor_.skip_inline();
    if (cursor_.peek() == '[') {
      step.op = copy;
      return read_index(step.first);
    }
    step.op = literal;
    return read_literal(step.first);
  }

  bool read_literal(std::int64_t& number) {
    number = static_cast<std::int64_t>(literals_.size());
    return read_value(cursor_, element_, false, literals_.emplace_back());
  }

  /// `minsize 3`, `resize 3 fill 0`. OpenUSD skips a size below zero that has a fill.
  bool read_size(ArrayEditOp plain, ArrayEditOp filled) {
    cursor_.skip_inline();
    const std::size_t start = cursor_.offset();
    ArrayEditStep step{plain, 0, 0};
    if (!read_integer(step.first)) {
      return false;
    }
    cursor_.skip_inline();
    if (plain != filled && cursor_.accept_word("fill")) {
      step.op = filled;
      cursor_.skip_inline();
      return read_literal(step.second) && (step.first < 0 || add(step));
    }
    return step.first < 0 ? cursor_.fail_at(start, ErrorCode::Parse, "text.value",
                                            "the size of an array is not below zero")
                          : add(step);
  }

  bool read_index(std::int64_t& index) {
    if (!cursor_.accept('[')) {
      return cursor_.fail_expected("an index such as [0]");
    }
    cursor_.skip_inline();
    if (!read_integer(index)) {
      return false;
    }
    cursor_.skip_inline();
    return cursor_.expect(']', "after the index");
  }

  bool read_integer(std::int64_t& number) {
    const std::string_view rest = cursor_.rest();
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
    if (error == std::errc::invalid_argument) {
      return cursor_.fail_expected("a whole number");
    }
    if (error != std::errc()) {
      return cursor_.fail_at(cursor_.offset(), ErrorCode::Parse, "text.value",
                             "this number does not fit into 64 bits");
    }
    cursor_.advance(static_cast<std::size_t>(end - rest.data()));
    return true;
  }

  Cursor& cursor_;
  layer::ValueType element_;
  layer::ArrayEditBuilder builder_;
  std::vector<Value> literals_;
};

}  // namespace

bool at_array_edit(const Cursor& cursor) {
  return cursor.peek() == 'e' && cursor.peek_identifier() == "edit";
}

bool read_array_edit(Cursor& cursor, layer::ValueType element, Value& value) {
  return ArrayEditReader(cursor, element).read(value);
}

}  // namespace tenon::formats::text
