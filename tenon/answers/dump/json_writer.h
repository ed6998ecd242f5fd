// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace tenon::answers {

/// JSON text with one item per line, indented by one blank per level, numbers as the shortest text
/// that reads back ("1.0", "1e-05"): the form that Python's json module prints with indent=1.
class JsonWriter {
 public:
  explicit JsonWriter(std::ostream& out) : out_(out) {}
  JsonWriter(const JsonWriter&) = delete;
  JsonWriter& operator=(const JsonWriter&) = delete;
  /// Hands on what is still held back.
  ~JsonWriter() { flush(); }

  void begin_object() { begin('{'); }
  void end_object() { end('}'); }
  void begin_array() { begin('['); }
  void end_array() { end(']'); }
  void key(std::string_view name);
  /// All of `items`, each written by `write(item)`.
  template <class Items, class Write>
  void array(const Items& items, Write write) {
    begin_array();
    for (const auto& item : items) {
      write(item);
    }
    end_array();
  }

  void string(std::string_view text);
  void boolean(bool value) { raw(value ? "true" : "false"); }
  void null() { raw("null"); }
  /// Not finite: the strings "nan", "inf" and "-inf".
  void number(double value);
  /// A number that is text already: valid JSON, any width.
  void number_text(std::string_view text) { raw(text); }
  /// Beyond 2^53 a string, so that no reader rounds it.
  void integer(std::int64_t value);
  void unsigned_integer(std::uint64_t value);

 private:
  void begin(char bracket);
  void end(char bracket);
  void raw(std::string_view text);
  void flush();
  void before_item();
  void new_line();

  std::ostream& out_;
  std::string text_;             // not yet in out_
  std::vector<bool> has_items_;  // per open bracket
  bool after_key_ = false;
};

/// Text in quotes with JSON escapes; everything beyond ASCII stays as it is.
std::string json_quoted(std::string_view text);
/// "1.0", "1e-05", "1e+16"; finite values only.
std::string json_number(double value);

}  // namespace tenon::answers
