// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/answers/json.h"

#include <algorithm>
#include <string>
#include <unordered_map>
#include <vector>

#include "tenon/base/text/quoted_text.h"

namespace tenon::answers {
namespace {

/// Builds the value. Json itself looks for each key among all of its object, which takes a square
/// of their number.
class Builder : public nlohmann::json_sax<Json> {
 public:
  bool null() override { return put(nullptr); }
  bool boolean(bool value) override { return put(value); }
  bool number_integer(number_integer_t value) override { return put(value); }
  bool number_unsigned(number_unsigned_t value) override { return put(value); }
  bool number_float(number_float_t value, const string_t&) override { return put(value); }
  bool string(string_t& value) override { return put(std::move(value)); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(Json::object()); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    Open& at = open_.back();
    auto& members = at.value->get_ref<Json::object_t&>();
    const auto [known, is_new] = at.places.emplace(name, members.size());
    if (is_new) {
      members.emplace_back(name, nullptr);
    } else if (twice_.empty()) {
      twice_ = "the key " + quoted_text(name.substr(0, 100)) + " is there twice in one object";
    }
    at.place = known->second;
    return true;
  }
  bool parse_error(std::size_t position, const std::string&,
                   const nlohmann::detail::exception& reason) override {
    constexpr int kNumberOverflow = 406;
    position_ = position;
    overflows_ = reason.id == kNumberOverflow;
    return false;
  }

  Json take() { return std::move(root_); }
  const std::string& twice() const { return twice_; }
  std::size_t position() const { return position_; }
  bool overflows() const { return overflows_; }

 private:
  struct Open {
    Json* value;
    std::size_t place = 0;  // of the member that comes next, in an object
    std::unordered_map<std::string, std::size_t> places = {};
  };

  Json* add(Json value) {
    if (open_.empty()) {
      root_ = std::move(value);
      return &root_;
    }
    Open& at = open_.back();
    if (at.value->is_array()) {
      at.value->push_back(std::move(value));
      return &at.value->back();
    }
    auto& members = at.value->get_ref<Json::object_t&>();
    Json& member = (members.begin() + static_cast<std::ptrdiff_t>(at.place))->second;
    member = std::move(value);
    return &member;
  }
  bool put(Json value) {
    add(std::move(value));
    return true;
  }
  bool open(Json empty) {
    open_.push_back({add(std::move(empty))});
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }

  Json root_;
  std::vector<Open> open_;
  std::string twice_;
  std::size_t position_ = 0;
  bool overflows_ = false;
};

}  // namespace

Json parsed(std::string_view text) {
  Builder builder;
  return Json::sax_parse(text, &builder) ? builder.take() : Json(Json::value_t::discarded);
}

Result<Json> parsed_file(std::string_view text,
                         const std::function<Error(const std::string&)>& bad) {
  Builder builder;
  if (!Json::sax_parse(text, &builder)) {
    const std::string_view before =
        text.substr(0, std::min(std::max<std::size_t>(builder.position(), 1) - 1, text.size()));
    const auto line = std::count(before.begin(), before.end(), '\n') + 1;
    const std::size_t column = before.size() - (before.rfind('\n') + 1) + 1;
    const bool is_empty = text.find_first_not_of(" \t\r\n") == std::string_view::npos;
    return bad(is_empty                       ? "it is empty"
               : builder.overflows()          ? "a number is too large here"
               : before.size() == text.size() ? "its JSON ends too early"
                                              : "it is no JSON here")
        .at(static_cast<std::uint32_t>(line), static_cast<std::uint32_t>(column));
  }
  if (!builder.twice().empty()) {
    return bad(builder.twice());
  }
  return builder.take();
}

std::string printed(const Json& json, bool only_ascii, int indent) {
  return json.dump(indent, ' ', only_ascii, Json::error_handler_t::replace) + "\n";
}

std::string on_one_line(const Json& json, bool only_ascii) {
  return json.dump(-1, ' ', only_ascii, Json::error_handler_t::replace);
}

}  // namespace tenon::answers
