// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The parser keeps of each element only the place of its name in the text. The start tag and its
// attributes are found again from there by a scan that respects quotes, and a sorted list of line
// starts turns offsets into lines and columns. A tag is scanned for a few thousand bytes at most,
// and only a limited number of findings is placed, so a hostile text does not make the time grow
// with the square of its length.
#include "tenon/urdf/xml_reader.h"

#include <algorithm>
#include <cmath>

#include "tenon/base/file_finding.h"
#include "tenon/base/limits/limits.h"
#include "tenon/base/text/text_number.h"
#include "tenon/urdf/well_formed.h"

namespace tenon::urdf {
namespace {

/// The numbers of a text between `separators`, `count` + 1 at most; none where one is no number.
std::vector<double> numbers_in(std::string_view text, std::string_view separators,
                               std::size_t count) {
  std::vector<double> values;
  while (values.size() <= count) {
    const std::size_t begin = text.find_first_not_of(separators);
    if (begin == std::string_view::npos) {
      break;
    }
    const std::size_t end = std::min(text.find_first_of(separators, begin), text.size());
    const std::optional<double> value = parse_double(text.substr(begin, end - begin));
    if (!value) {
      return {};
    }
    values.push_back(*value);
    text = text.substr(end);
  }
  return values;
}

/// Commas that stand between numbers and are no decimal points: each next to a space, or one in
/// every gap.
bool separates(std::string_view text, std::size_t count) {
  constexpr std::string_view kSpace = " \t\r\n";
  std::size_t commas = 0;
  bool apart = true;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == ',') {
      ++commas;
      apart = apart && i > 0 && i + 1 < text.size() &&
              (kSpace.find(text[i - 1]) != std::string_view::npos ||
               kSpace.find(text[i + 1]) != std::string_view::npos);
    }
  }
  return commas > 0 && (apart || commas + 1 == count);
}

bool contains(std::initializer_list<std::string_view> list, std::string_view name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

}  // namespace

XmlReader::XmlReader(std::string_view text, std::string file, Diagnostics& diagnostics)
    : text_(text), file_(std::move(file)), diagnostics_(diagnostics) {
  line_starts_.push_back(0);
  for (std::size_t i = 0; i < text_.size(); ++i) {
    if (text_[i] == '\n') {
      line_starts_.push_back(i + 1);
    }
  }
}

Result<pugi::xml_node> XmlReader::parse() {
  const pugi::xml_parse_result parsed =
      document_.load_buffer(text_.data(), text_.size(), pugi::parse_default, pugi::encoding_utf8);
  if (!parsed) {
    return broken(static_cast<std::size_t>(std::max<std::ptrdiff_t>(parsed.offset, 0)),
                  parsed.description());
  }
  if (const std::optional<XmlFault> fault = well_formed_fault(text_)) {
    return broken(fault->offset, fault->message);
  }
  return document_.document_element();
}

Error XmlReader::broken(std::size_t offset, const std::string& why) const {
  const std::size_t line = line_at(offset);
  return Error(ErrorCode::Parse,
               text_.empty()
                   ? "the file is empty"
                   : "no robot description can be read from this, it is not valid XML: " + why)
      .in_file(file_)
      .at(static_cast<std::uint32_t>(line),
          static_cast<std::uint32_t>(offset - line_starts_[line - 1] + 1))
      .with_rule("urdf.xml")
      .with_fix(text_.empty() ? "write it again, or name another file" : "correct the XML there");
}

robot::Place XmlReader::place_of(pugi::xml_node element) const { return place_of(element, {}); }

std::size_t XmlReader::line_at(std::size_t offset) const {
  const auto next = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
  return static_cast<std::size_t>(next - line_starts_.begin());
}

/// From '<' to after '>', by the place of the element's name. Of a very long tag only the name, so
/// that many findings in one tag do not make the time grow with the square of it.
XmlReader::Range XmlReader::tag_of(std::size_t name) const {
  constexpr std::size_t kLongest = 4096;
  const std::size_t last = std::min(name + kLongest, text_.size());
  char quote = 0;
  std::size_t end = name;
  for (; end < last && (quote != 0 || text_[end] != '>'); ++end) {
    const char c = text_[end];
    if (quote != 0) {
      quote = c == quote ? '\0' : quote;
    } else if (c == '"' || c == '\'') {
      quote = c;
    }
  }
  return {name - 1, end < last ? end + 1 : std::min(text_.find_first_of(" \t\r\n>/", name), last)};
}

/// The attribute with its value; the tag when it is not there.
XmlReader::Range XmlReader::attribute_in(Range tag, std::string_view attribute) const {
  constexpr std::string_view kSpace = " \t\r\n";
  std::size_t at = text_.find_first_of(kSpace, tag.begin);
  while (at < tag.end) {
    const std::size_t begin = text_.find_first_not_of(kSpace, at);
    const std::size_t equals = text_.find('=', at);
    const std::size_t open = text_.find_first_of("\"'", equals);
    if (open >= tag.end) {
      break;
    }
    const std::size_t close = text_.find(text_[open], open + 1);
    const std::size_t name_end = text_.find_first_of(" \t\r\n=", begin);
    if (close < tag.end && text_.substr(begin, name_end - begin) == attribute) {
      return {begin, close + 1};
    }
    at = close == std::string_view::npos ? tag.end : close + 1;
  }
  return tag;
}

robot::Place XmlReader::place_of(pugi::xml_node element, std::string_view attribute) const {
  const std::ptrdiff_t name = element.offset_debug();
  if (name <= 0 || static_cast<std::size_t>(name) > text_.size()) {
    return {};
  }
  const Range tag = tag_of(static_cast<std::size_t>(name));
  const Range range = attribute.empty() ? tag : attribute_in(tag, attribute);
  const auto column = [&](std::size_t offset) {
    return static_cast<std::uint32_t>(offset - line_starts_[line_at(offset) - 1] + 1);
  };
  return {static_cast<std::uint32_t>(line_at(range.begin)), column(range.begin),
          static_cast<std::uint32_t>(line_at(range.end)), column(range.end)};
}

Error XmlReader::fault(pugi::xml_node element, const char* rule, const std::string& message,
                       std::string fix, std::string_view attribute) const {
  Diagnostic finding =
      file_finding(Severity::Error, rule, "<" + std::string(element.name()) + ">: " + message,
                   file_, 0, std::move(fix));
  return {ErrorCode::Parse, robot::at_place(std::move(finding), place_of(element, attribute))};
}

void XmlReader::warn(pugi::xml_node element, const char* rule, std::string message, std::string fix,
                     Severity severity, std::string_view attribute) {
  if (++findings_ > limits::kLayerFindings) {
    return;
  }
  message = findings_ == limits::kLayerFindings
                ? "further findings are not listed"
                : "<" + std::string(element.name()) + ">: " + std::move(message);
  diagnostics_.add(
      robot::at_place(file_finding(severity, rule, std::move(message), file_, 0, std::move(fix)),
                      place_of(element, attribute)));
}

void XmlReader::list_unknown(pugi::xml_node element,
                             std::initializer_list<std::string_view> attributes,
                             std::initializer_list<std::string_view> children) {
  for (const pugi::xml_attribute attribute : element.attributes()) {
    const std::string_view name = attribute.name();
    if (!contains(attributes, name) && !name.starts_with("xmlns")) {
      warn(element, "urdf.left-out",
           "the attribute " + std::string(name) + "=\"" + attribute.value() +
               "\" is unknown; it is skipped",
           "", Severity::Warning, name);
    }
  }
  for (const pugi::xml_node child : element.children()) {
    if (child.type() == pugi::node_element && !contains(children, child.name())) {
      warn(child, "urdf.left-out",
           "is unknown inside <" + std::string(element.name()) + ">; it is skipped", "");
    }
  }
}

Result<std::string> XmlReader::text(pugi::xml_node element, const char* attribute) const {
  std::string value = element.attribute(attribute).value();
  if (value.empty()) {
    return fault(element, "urdf.missing", std::string("needs the attribute ") + attribute,
                 std::string("write ") + attribute + "=\"...\"");
  }
  return value;
}

Result<std::vector<double>> XmlReader::numbers(pugi::xml_node element, const char* attribute,
                                               std::size_t count,
                                               std::vector<double> fallback) const {
  const pugi::xml_attribute found = element.attribute(attribute);
  if (!found && !fallback.empty()) {
    return fallback;
  }
  std::vector<double> values = numbers_in(found.value(), " \t\r\n", count);
  if (values.size() != count) {
    const std::string_view value = found.value();
    if (value.find("${") != value.npos || value.find("$(") != value.npos) {
      return fault(element, "urdf.xacro",
                   std::string(attribute) + "=\"" + found.value() +
                       "\" is an expression of xacro, which is not expanded",
                   "expand it first: xacro IN.xacro > OUT.urdf", attribute);
    }
    const std::string wanted = count == 1 ? "a number" : std::to_string(count) + " numbers";
    const bool comma = value.find(',') != std::string_view::npos;
    return fault(element, found ? "urdf.number" : "urdf.missing",
                 found ? std::string(attribute) + "=\"" + found.value() + "\" is not " + wanted
                       : std::string("needs the attribute ") + attribute,
                 std::string("write ") + attribute + "=\"...\" with " + wanted +
                     (comma ? ", separated by spaces" : ""),
                 found ? attribute : "");
  }
  return values;
}

Result<std::vector<double>> XmlReader::numbers_of(pugi::xml_node owner, pugi::xml_node element,
                                                  const char* attribute, std::size_t count,
                                                  std::vector<double> fallback) {
  const std::string_view written = element.attribute(attribute).value();
  if (separates(written, count)) {
    std::vector<double> values = numbers_in(written, " \t\r\n,", count);
    if (values.size() == count) {
      warn(element, "urdf.comma",
           std::string(attribute) + "=\"" + std::string(written) +
               "\" has commas between its numbers; they are skipped, while ROS's reader skips the "
               "whole <" +
               owner.name() + ">",
           "separate the numbers by spaces", Severity::Warning, attribute);
      return values;
    }
  }
  return numbers(element, attribute, count, std::move(fallback));
}

Result<double> XmlReader::number(pugi::xml_node element, const char* attribute,
                                 std::optional<double> fallback) const {
  TENON_TRY(const std::vector<double> values,
            numbers(element, attribute, 1,
                    fallback ? std::vector<double>{*fallback} : std::vector<double>()));
  return values[0];
}

Result<Pose> XmlReader::origin(pugi::xml_node element) {
  const pugi::xml_node origin = element.child("origin");
  Pose pose;
  if (!origin) {
    return pose;
  }
  list_unknown(origin, {"xyz", "rpy", "quat_xyzw"}, {});
  // A joint that it cannot read makes ROS's reader refuse the robot.
  const bool is_joint = std::string_view(element.name()) == "joint";
  const auto three = [&](const char* name) {
    return is_joint ? numbers(origin, name, 3, {0, 0, 0})
                    : numbers_of(element, origin, name, 3, {0, 0, 0});
  };
  TENON_TRY(const std::vector<double> xyz, three("xyz"));
  pose.position = {{xyz[0], xyz[1], xyz[2]}};
  if (origin.attribute("quat_xyzw")) {
    TENON_TRY(const std::vector<double> q, numbers(origin, "quat_xyzw", 4, {}));
    pose.orientation = normalized(Quatd{q[0], q[1], q[2], q[3]});
    return pose;
  }
  TENON_TRY(const std::vector<double> rpy, three("rpy"));
  pose.orientation = rotation_of_rpy(rpy[0], rpy[1], rpy[2]);
  return pose;
}

Quatd rotation_of_rpy(double roll, double pitch, double yaw) {
  const Quatd q = rotation_about({{0, 0, 1}}, yaw) * rotation_about({{0, 1, 0}}, pitch) *
                  rotation_about({{1, 0, 0}}, roll);
  return {q.x + 0.0, q.y + 0.0, q.z + 0.0, q.w + 0.0};  // no -0
}

}  // namespace tenon::urdf
