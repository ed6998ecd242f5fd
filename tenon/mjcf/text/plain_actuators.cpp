// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A servo on a position has the gain k and the bias (0, -k, -d), one on a velocity k and
// (0, 0, -k). What an element does not say comes from its class: a gain that is not written is one
// only where no class writes another.
#include "tenon/mjcf/text/plain_actuators.h"

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include "tenon/base/text/text_number.h"

namespace tenon::mjcf {
namespace {

constexpr std::string_view kGeneral = "<general";

struct Attributes {
  std::vector<std::pair<std::string_view, std::string_view>> all;  // in order

  std::optional<std::string_view> find(std::string_view name) const {
    const auto at =
        std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.first == name; });
    return at == all.end() ? std::nullopt : std::optional(at->second);
  }
};

Attributes attributes_of(std::string_view element) {
  Attributes found;
  for (std::size_t at = element.find('='); at != std::string_view::npos;) {
    const std::size_t name = element.rfind(' ', at) + 1;
    const std::size_t end = element.find('"', at + 2);
    if (end == std::string_view::npos) {
      break;
    }
    found.all.emplace_back(element.substr(name, at - name), element.substr(at + 2, end - at - 2));
    at = element.find('=', end);
  }
  return found;
}

std::vector<double> numbers_in(std::string_view text) {
  std::vector<double> numbers;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    numbers.push_back(parse_double(text.substr(0, end)).value_or(0));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return numbers;
}

/// The element and the gains that say the same as gain and bias.
struct Servo {
  std::string_view element;
  std::string gains;
};

std::optional<Servo> servo_of(const Attributes& attributes, bool has_class_gains) {
  const auto input = attributes.find("input");
  if (!input || attributes.find("dyntype") || attributes.find("gaintype") ||
      attributes.find("biastype") != "affine") {
    return std::nullopt;
  }
  const auto gain = attributes.find("gainprm");
  std::vector<double> bias = numbers_in(attributes.find("biasprm").value_or(""));
  bias.resize(std::max<std::size_t>(bias.size(), 3));
  if ((!gain && has_class_gains) || bias.size() > 3 || bias[0] != 0) {
    return std::nullopt;
  }
  const std::vector<double> factors = gain ? numbers_in(*gain) : std::vector<double>{1};
  if (factors.size() != 1) {
    return std::nullopt;
  }
  const double k = factors[0];
  if (*input == "pos" && bias[1] == -k) {
    const std::string damping = bias[2] == 0 ? "" : " kv=\"" + layer_text(-bias[2]) + "\"";
    return Servo{"<position", " kp=\"" + layer_text(k) + "\"" + damping};
  }
  if (*input == "vel" && bias[1] == 0 && bias[2] == -k) {
    return Servo{"<velocity", " kv=\"" + layer_text(k) + "\""};
  }
  return std::nullopt;
}

std::string plain_element(std::string_view element, bool has_class_gains) {
  const Attributes attributes = attributes_of(element);
  const std::optional<Servo> servo = servo_of(attributes, has_class_gains);
  if (!servo) {
    return std::string(element);
  }
  std::string out(servo->element);
  for (const auto& [name, value] : attributes.all) {
    if (name != "input" && name != "biastype" && name != "gainprm" && name != "biasprm") {
      out += " " + std::string(name) + "=\"" + std::string(value) + "\"";
    }
  }
  return out + servo->gains + "/>";
}

bool has_gains(std::string_view classes) {
  for (std::size_t at = classes.find(kGeneral); at != std::string_view::npos;
       at = classes.find(kGeneral, at + 1)) {
    if (classes.substr(at, classes.find('>', at) - at).find("gainprm") != std::string_view::npos) {
      return true;
    }
  }
  return false;
}

}  // namespace

std::string plain_actuators(std::string_view text) {
  const bool has_class_gains = has_gains(text.substr(0, text.find("<worldbody")));
  std::string out;
  std::size_t at = 0;
  for (std::size_t open = text.find(kGeneral); open != std::string_view::npos;
       open = text.find(kGeneral, at)) {
    const std::size_t close = text.find('>', open);
    if (close == std::string_view::npos) {
      break;
    }
    out += text.substr(at, open - at);
    const std::string_view element = text.substr(open, close + 1 - open);
    out += element.ends_with("/>") ? plain_element(element, has_class_gains) : std::string(element);
    at = close + 1;
  }
  return out + std::string(text.substr(at));
}

}  // namespace tenon::mjcf
