// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Text is made in a buffer of one piece, which is handed on when it is full. What stands before an
// item (comma, end of line, blanks) is made once for each depth. Strings of plain ASCII are copied,
// others, and all numbers but zero, are written by the library for JSON, so that the bytes are its.
#include "tenon/answers/dump/json_sink.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace tenon::answers {
namespace {

constexpr std::size_t kHeldBack = std::size_t{1} << 16;  ///< bytes of a piece

/// Printed as it is.
constexpr std::array<bool, 256> kPlain = [] {
  std::array<bool, 256> plain{};
  for (std::size_t c = 0x20; c < 0x7F; ++c) {
    plain[c] = c != '"' && c != '\\';
  }
  return plain;
}();

bool is_plain(char c) { return kPlain[static_cast<unsigned char>(c)]; }

}  // namespace

void JsonValueSink::put(Json value) {
  if (open_.empty()) {
    whole_ = std::move(value);
  } else if (Json& last = open_.back().second; last.is_array()) {
    last.push_back(std::move(value));
  } else {
    append_member(last, std::exchange(key_, {}), std::move(value));
  }
}

void JsonValueSink::open(Json empty) {
  open_.emplace_back(std::exchange(key_, {}), std::move(empty));
}

void JsonValueSink::close() {
  auto [key, value] = std::move(open_.back());
  open_.pop_back();
  key_ = std::move(key);
  put(std::move(value));
}

JsonTextSink::JsonTextSink(int indent, bool only_ascii, Take take)
    : indent_(indent), only_ascii_(only_ascii), take_(std::move(take)), text_(kHeldBack) {
  set_depth();
}

JsonTextSink::~JsonTextSink() { hand_on(); }

void JsonTextSink::hand_on() {
  if (used_ != 0) {
    take_({text_.data(), std::exchange(used_, 0)});
  }
}

void JsonTextSink::append(std::string_view text) {
  if (text.size() > text_.size() - used_) {
    hand_on();
    if (text.size() > text_.size()) {
      take_(text);
      return;
    }
  }
  std::copy(text.begin(), text.end(), text_.data() + used_);
  used_ += text.size();
}

/// The text before an item of the innermost bracket.
void JsonTextSink::set_depth() {
  const std::size_t blanks =
      indent_ < 0 ? 0 : has_items_.size() * static_cast<std::size_t>(indent_);
  lines_.assign((indent_ < 0 ? 1 : 2) + blanks, ' ');
  lines_[0] = ',';
  if (indent_ >= 0) {
    lines_[1] = '\n';
  }
}

void JsonTextSink::begin(char bracket) {
  before_item();
  append({&bracket, 1});
  has_items_.push_back(0);
  set_depth();
}

void JsonTextSink::end(char bracket) {
  const bool items = has_items_.back() != 0;
  has_items_.pop_back();
  set_depth();
  if (items) {
    append(std::string_view(lines_).substr(1));
  }
  append({&bracket, 1});
}

void JsonTextSink::key(std::string_view name) {
  before_item();
  append_quoted(name);
  end_key();
}

void JsonTextSink::key_text(std::string_view quoted) {
  before_item();
  append(quoted);
  end_key();
}

void JsonTextSink::end_key() {
  append(indent_ < 0 ? ":" : ": ");
  after_key_ = true;
}

void JsonTextSink::put(double value) {
  if (value == 0 && !std::signbit(value)) {
    put_text("0.0");
    return;
  }
  std::array<char, 64> digits;
  // The library's own, so that a number has one form in all answers.
  const char* end = nlohmann::detail::to_chars(digits.data(), digits.data() + digits.size(), value);
  put_text({digits.data(), static_cast<std::size_t>(end - digits.data())});
}

void JsonTextSink::put(std::int64_t value) {
  std::array<char, 24> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  put_text({digits.data(), static_cast<std::size_t>(end - digits.data())});
}

void JsonTextSink::put(std::uint64_t value) {
  std::array<char, 24> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  put_text({digits.data(), static_cast<std::size_t>(end - digits.data())});
}

void JsonTextSink::put(std::string_view text) {
  before_item();
  append_quoted(text);
}

void JsonTextSink::put(const Json& value) {
  if (value.is_object()) {
    begin_object();
    for (const auto& [name, member] : value.items()) {
      key(name);
      put(member);
    }
    end_object();
  } else if (value.is_array()) {
    begin_array();
    for (const Json& one : value) {
      put(one);
    }
    end_array();
  } else {
    put_text(on_one_line(value, only_ascii_));
  }
}

void JsonTextSink::put_text(std::string_view text) {
  before_item();
  append(text);
}

void JsonTextSink::append_quoted(std::string_view text) {
  if (text.size() + 2 > text_.size() - used_) {
    hand_on();
  }
  if (text.size() + 2 <= text_.size()) {
    char* at = text_.data() + used_;
    *at++ = '"';
    const auto end = std::find_if_not(text.begin(), text.end(), is_plain);
    if (end == text.end()) {
      at = std::copy(text.begin(), end, at);
      *at = '"';
      used_ += text.size() + 2;
      return;
    }
  }
  append(on_one_line(Json(text), only_ascii_));
}

void JsonTextSink::before_item() {
  if (after_key_) {
    after_key_ = false;
  } else if (!has_items_.empty()) {
    append(std::string_view(lines_).substr(has_items_.back() != 0 ? 0 : 1));
    has_items_.back() = 1;
  }
}

}  // namespace tenon::answers
