// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "tenon/base/token.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/spec/field_list.h"
#include "tenon/layer/type_names.h"

namespace tenon::formats::text {

/// The type of an attribute as its statement gives it.
struct OwnType {
  const layer::TypeName* type = nullptr;  ///< null: unknown
  bool is_array = false;
};

/// What the words in front of an attribute's name and that name say.
struct AttributeHead {
  bool is_custom = false;
  bool is_uniform = false;
  OwnType own;
  Token type_name;  ///< as written
  Token name;
  std::size_t name_end = 0;  ///< from the first byte of the statement
};

/// A whole attribute statement with the end of its line, and the fields that reading it gave.
struct KnownLine {
  std::string_view text;
  std::size_t value_begin = 0;  ///< from the first byte of the statement
  layer::FieldList fields;      ///< empty until the line has come a second time
};

struct KnownAttribute {
  std::string_view text;  ///< up to and with the '='; empty where nothing is known
  AttributeHead head;
  layer::FieldList declared;  ///< what the head says, as fields
  KnownLine line;             ///< the last one with this head, where it may be taken over
  std::uint32_t next = 0;     ///< the one that followed the last time
};

/// The beginnings of attribute statements that were read, up to the '=', and the last line with
/// each. Prims of one kind repeat the same statements: equal bytes mean the same, so that a
/// statement that begins with known ones needs no second look at its words, and one that is equal
/// to the end of its line none at its value either. An entry is forgotten when another head takes
/// its slot; an unknown statement is read as usual.
class KnownAttributes {
 public:
  /// The texts that are given out and asked for are parts of one text that outlives this.
  KnownAttribute* find(std::string_view rest);
  /// The attribute whose head is `text`, which ends with its first '='; null where it is too long.
  KnownAttribute* note(std::string_view text, const AttributeHead& head,
                       const layer::FieldList& declared);

  /// The fields of the statement that `rest` begins with, when it is that line; null otherwise.
  static const layer::FieldList* repeated(const KnownAttribute& known, std::string_view rest);
  /// The statement at the beginning of `rest`, which made its spec, ended after `length` bytes with
  /// these fields. Its value must mean the same wherever the line stands. False for a line that is
  /// not kept: it goes on behind the statement, or is too long.
  static bool note_line(KnownAttribute& known, std::string_view rest, std::size_t length,
                        std::size_t value_begin, const layer::FieldList& fields);

 private:
  static constexpr std::size_t kLongestHead = 128;
  static constexpr std::size_t kLongestLine = 256;

  static constexpr std::size_t kSlots = 1024;

  KnownAttribute& follow(std::uint32_t known);

  std::vector<KnownAttribute> known_;
  std::vector<std::uint32_t> slots_;  // the number in known_, from 1 on
  std::uint32_t last_ = 0;            // the one that was found or noted last
};

}  // namespace tenon::formats::text
