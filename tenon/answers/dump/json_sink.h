// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tenon/answers/json.h"

/// Where JSON goes while it is made: into a value, or into text that is handed on in pieces, so
/// that a long answer is never held whole. Both take the same calls: a key before each member of an
/// object, and keys of one object that differ. Internal to tenon/answers.
namespace tenon::answers {

class JsonValueSink {
 public:
  void begin_object() { open(Json::object()); }
  void begin_array() { open(Json::array()); }
  void end_object() { close(); }
  void end_array() { close(); }
  void key(std::string_view name) { key_ = name; }
  void put(Json value);

  /// The value, once everything is closed.
  Json take() { return std::move(whole_); }

 private:
  void open(Json empty);
  void close();

  Json whole_;
  std::vector<std::pair<std::string, Json>> open_;  ///< with their keys
  std::string key_;
};

/// The text of `printed` (indent 2) or `on_one_line` (indent -1), byte by byte the same, without
/// the last end of line.
class JsonTextSink {
 public:
  using Take = std::function<void(std::string_view piece)>;

  JsonTextSink(int indent, bool only_ascii, Take take);
  JsonTextSink(const JsonTextSink&) = delete;
  JsonTextSink& operator=(const JsonTextSink&) = delete;
  /// Hands on what is still held back.
  ~JsonTextSink();

  void begin_object() { begin('{'); }
  void begin_array() { begin('['); }
  void end_object() { end('}'); }
  void end_array() { end(']'); }
  void key(std::string_view name);
  void put(bool value) { put_text(value ? "true" : "false"); }
  void put(std::nullptr_t) { put_text("null"); }
  void put(double value);  ///< finite
  void put(std::int64_t value);
  void put(std::uint64_t value);
  void put(std::string_view text);
  void put(const char* text) { put(std::string_view(text)); }
  void put(const std::string& text) { put(std::string_view(text)); }
  void put(const Json& value);
  /// Text that is JSON already, as it stands.
  void put_text(std::string_view json);
  void key_text(std::string_view quoted);

 private:
  void begin(char bracket);
  void end(char bracket);
  void end_key();
  void append_quoted(std::string_view text);
  void before_item();
  void set_depth();
  void append(std::string_view text);
  void hand_on();

  int indent_;
  bool only_ascii_;
  Take take_;
  std::string lines_;       // what stands before an item: a comma, an end of line, blanks
  std::vector<char> text_;  // not yet handed on: the first `used_`
  std::size_t used_ = 0;
  std::vector<char> has_items_;  // per open bracket
  bool after_key_ = false;
};

}  // namespace tenon::answers
