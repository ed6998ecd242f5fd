// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Values of SDF are texts of elements, not attributes. A value that is missing has the default of
// the format; one that is there and cannot be read ends the reading, as in URDF.
#include "tenon/sdf/sdf_file.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "tenon/base/text/text_number.h"
#include "tenon/bytes/files.h"

namespace tenon::sdf {
namespace {

constexpr unsigned kNewest = 11;  // version 1.11
constexpr std::string_view kSpaces = " \t\r\n";

bool is_in(std::initializer_list<std::string_view> list, std::string_view name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

}  // namespace

SdfFile::SdfFile(std::string_view text, std::shared_ptr<const bytes::FileBytes> bytes,
                 std::string path, bool is_main, Diagnostics& diagnostics)
    : bytes_(std::move(bytes)),
      xml_(text, std::move(path), diagnostics),
      folder_(std::filesystem::path(bytes::absolute_file_path(xml_.file()))
                  .parent_path()
                  .generic_string()),
      is_main_(is_main),
      minor_version_(kNewest) {}

Result<void> SdfFile::parse() {
  auto root = xml_.parse();
  if (!root) {
    return std::move(root).error().with_rule("sdf.xml");
  }
  root_ = *root;
  const std::string name = root_.name();
  if (name != "sdf" && name != "gazebo") {  // Gazebo's own name before 1.3
    const robot::Place at = xml_.place_of(root_);
    return Error(ErrorCode::Unsupported, "the root element is <" + name + ">, not <sdf>")
        .in_file(path())
        .at(at.line, at.column)
        .until(at.end_line, at.end_column)
        .with_rule("sdf.root")
        .with_fix(name == "robot" ? "convert the URDF on its own" : "give an SDF model");
  }
  read_version();
  return {};
}

void SdfFile::read_version() {
  const std::string written = root_.attribute("version").value();
  const std::size_t point = written.find('.');
  const auto minor =
      point == std::string::npos ? std::nullopt : parse_uint64(written.substr(point + 1));
  if (written.substr(0, point) != "1" || !minor || *minor > 1000) {
    warn(root_, "sdf.version",
         written.empty() ? "has no version; it is read as 1.11"
                         : "has the version \"" + written + "\"; it is read as 1.11",
         "write version=\"1.11\", or what the file was written for");
    return;
  }
  minor_version_ = static_cast<unsigned>(*minor);
  if (minor_version_ > kNewest) {
    warn(root_, "sdf.version", "has the version " + written + ", which is newer than 1.11",
         "look at what is listed as skipped", Severity::Info);
  }
}

robot::Place SdfFile::place_of(pugi::xml_node element) const {
  return is_main_ ? xml_.place_of(element) : robot::Place{};
}

Error SdfFile::fault(pugi::xml_node element, const char* rule, const std::string& message,
                     std::string fix) const {
  return xml_.fault(element, rule, message, std::move(fix));
}

void SdfFile::warn(pugi::xml_node element, const char* rule, std::string message, std::string fix,
                   Severity severity) {
  xml_.warn(element, rule, std::move(message), std::move(fix), severity);
}

void SdfFile::list_skipped(pugi::xml_node element, std::initializer_list<std::string_view> taken,
                           std::initializer_list<std::string_view> others) {
  const std::string inside = " inside <" + std::string(element.name()) + ">";
  for (const pugi::xml_node child : element.children()) {
    const std::string_view name = child.name();
    if (child.type() != pugi::node_element || is_in(taken, name)) {
      continue;
    }
    if (name.find(':') != name.npos) {
      warn(child, "sdf.extension", "is a setting of another program; it is skipped", "");
    } else if (is_in(others, name)) {
      warn(child, "sdf.left-out", "is a setting of simulators, which is skipped" + inside, "",
           Severity::Info);
    } else {
      warn(child, "sdf.left-out", "is unknown" + inside + "; it is skipped", "");
    }
  }
}

std::string SdfFile::text_of(pugi::xml_node element) {
  std::string text = element.text().get();
  constexpr std::string_view kNoBreakSpace = "\xC2\xA0";
  for (std::size_t at = text.find(kNoBreakSpace); at != text.npos;
       at = text.find(kNoBreakSpace, at)) {
    text.replace(at, kNoBreakSpace.size(), "  ");
  }
  const std::size_t begin = text.find_first_not_of(kSpaces);
  return begin == std::string::npos
             ? std::string()
             : text.substr(begin, text.find_last_not_of(kSpaces) + 1 - begin);
}

Result<std::vector<double>> SdfFile::numbers_in(pugi::xml_node element, std::size_t count) const {
  const std::string text = text_of(element);
  std::string_view rest = text;
  std::vector<double> values;
  while (!rest.empty() && values.size() <= count) {
    const std::size_t end = std::min(rest.find_first_of(kSpaces), rest.size());
    const std::optional<double> value = parse_double(rest.substr(0, end));
    if (!value) {
      values.clear();
      break;
    }
    values.push_back(*value);
    rest.remove_prefix(std::min(rest.find_first_not_of(kSpaces, end), rest.size()));
  }
  if (values.size() != count) {
    const std::string wanted = count == 1 ? "a number" : std::to_string(count) + " numbers";
    return fault(
        element, "sdf.number", "\"" + text + "\" is not " + wanted,
        "write " + wanted + " between <" + element.name() + "> and </" + element.name() + ">");
  }
  return values;
}

Result<std::vector<double>> SdfFile::numbers(pugi::xml_node element, const char* name,
                                             std::vector<double> fallback) const {
  const pugi::xml_node child = element.child(name);
  if (!child) {
    return fallback;
  }
  return numbers_in(child, fallback.size());
}

Result<double> SdfFile::number(pugi::xml_node element, const char* name, double fallback) const {
  TENON_TRY(const std::vector<double> values, numbers(element, name, {fallback}));
  return values[0];
}

Result<bool> SdfFile::flag(pugi::xml_node element, const char* name, bool fallback) const {
  const pugi::xml_node child = element.child(name);
  if (!child) {
    return fallback;
  }
  const std::string text = text_of(child);
  if (text == "true" || text == "1" || text == "True" || text == "TRUE") {
    return true;
  }
  if (text == "false" || text == "0" || text == "False" || text == "FALSE") {
    return false;
  }
  return fault(child, "sdf.flag", "\"" + text + "\" is neither true nor false",
               "write true or false");
}

Result<std::vector<double>> SdfFile::color_in(pugi::xml_node element) const {
  auto three = numbers_in(element, 3);
  return three ? std::move(three) : numbers_in(element, 4);
}

Result<WrittenPose> SdfFile::pose(pugi::xml_node element) const {
  const pugi::xml_node child = element.child("pose");
  WrittenPose written;
  if (!child) {
    return written;
  }
  written.is_there = true;
  written.relative_to = child.attribute("relative_to").value();
  if (written.relative_to.empty()) {
    written.relative_to = child.attribute("frame").value();  // its name in version 1.6
  }
  if (text_of(child).empty()) {
    return written;
  }
  TENON_TRY(written.pose, read_pose(child));
  if (!is_finite(written.pose)) {
    return fault(child, "sdf.pose", "\"" + text_of(child) + "\" is no place",
                 "give finite numbers, and a quaternion that is not 0");
  }
  return written;
}

Result<Pose> SdfFile::read_pose(pugi::xml_node child) const {
  const std::string format = child.attribute("rotation_format").value();
  if (format == "quat_xyzw") {
    TENON_TRY(const std::vector<double> v, numbers_in(child, 7));
    return Pose{{{v[0], v[1], v[2]}}, normalized(Quatd{v[3], v[4], v[5], v[6]})};
  }
  if (!format.empty() && format != "euler_rpy") {
    return fault(child, "sdf.pose", "the rotation format \"" + format + "\" is not known",
                 "write rotation_format=\"euler_rpy\" or \"quat_xyzw\"");
  }
  TENON_TRY(const std::vector<double> v, numbers_in(child, 6));
  const double unit = child.attribute("degrees").as_bool() ? 1 / kDegreesPerRadian : 1;
  return Pose{{{v[0], v[1], v[2]}}, urdf::rotation_of_rpy(v[3] * unit, v[4] * unit, v[5] * unit)};
}

Result<std::string> SdfFile::attribute(pugi::xml_node element, const char* name) const {
  std::string value = element.attribute(name).value();
  if (value.empty()) {
    return fault(element, "sdf.missing", std::string("needs the attribute ") + name,
                 std::string("write ") + name + "=\"...\"");
  }
  return value;
}

}  // namespace tenon::sdf
