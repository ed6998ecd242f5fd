// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <ostream>
#include <string>
#include <string_view>

#include "tenon/answers/dump/json_sink.h"

namespace tenon::answers {

/// Text in quotes with JSON escapes; everything beyond ASCII stays as it is.
std::string json_quoted(std::string_view text);
/// "1.0", "1e-05", "1e+16"; finite values only.
std::string json_number(double value);

/// JSON text with one item per line, indented by one blank per level, numbers as the shortest text
/// that reads back ("1.0", "1e-05"): the form that Python's json module prints with indent=1.
class JsonWriter {
 public:
  explicit JsonWriter(std::ostream& out);

  void begin_object() { text_.begin_object(); }
  void end_object() { text_.end_object(); }
  void begin_array() { text_.begin_array(); }
  void end_array() { text_.end_array(); }
  void key(std::string_view name) { text_.key_text(json_quoted(name)); }
  /// All of `items`, each written by `write(item)`.
  template <class Items, class Write>
  void array(const Items& items, Write write) {
    begin_array();
    for (const auto& item : items) {
      write(item);
    }
    end_array();
  }

  void string(std::string_view text) { text_.put_text(json_quoted(text)); }
  void boolean(bool value) { text_.put(value); }
  void null() { text_.put(nullptr); }
  /// Not finite: the strings "nan", "inf" and "-inf".
  void number(double value);
  /// A number that is text already: valid JSON, any width.
  void number_text(std::string_view text) { text_.put_text(text); }
  /// Beyond 2^53 a string, so that no reader rounds it.
  void integer(std::int64_t value);
  void unsigned_integer(std::uint64_t value);

 private:
  JsonTextSink text_;
};

}  // namespace tenon::answers
