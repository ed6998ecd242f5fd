// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <pugixml.hpp>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/math/transform.h"
#include "tenon/robot/robot_model.h"

/// Internal to this folder and tenon/sdf.
namespace tenon::urdf {

/// An XML document that knows its lines and reads attributes with faults that name them.
class XmlReader {
 public:
  XmlReader(std::string_view text, std::string file, Diagnostics& diagnostics);

  /// Parses; the root element.
  Result<pugi::xml_node> parse();

  const std::string& file() const { return file_; }
  /// Of the start tag of an element.
  robot::Place place_of(pugi::xml_node element) const;

  /// At the start tag of the element, or at one attribute of it.
  Error fault(pugi::xml_node element, const char* rule, const std::string& message, std::string fix,
              std::string_view attribute = {}) const;
  void warn(pugi::xml_node element, const char* rule, std::string message, std::string fix,
            Severity severity = Severity::Warning, std::string_view attribute = {});

  /// Lists attributes and child elements of `element` that are in neither list.
  void list_unknown(pugi::xml_node element, std::initializer_list<std::string_view> attributes,
                    std::initializer_list<std::string_view> children);

  /// Text of an attribute that must be there and not be empty.
  Result<std::string> text(pugi::xml_node element, const char* attribute) const;
  /// All numbers of an attribute; exactly `count` of them. `fallback` without the attribute; an
  /// empty fallback makes it required.
  Result<std::vector<double>> numbers(pugi::xml_node element, const char* attribute,
                                      std::size_t count, std::vector<double> fallback) const;
  /// The same, where commas between the numbers are reported and skipped: ROS's reader, urdfdom,
  /// loads such a file without the element that `owner` is, its visual, collision or inertial.
  Result<std::vector<double>> numbers_of(pugi::xml_node owner, pugi::xml_node element,
                                         const char* attribute, std::size_t count,
                                         std::vector<double> fallback);
  Result<double> number(pugi::xml_node element, const char* attribute,
                        std::optional<double> fallback) const;
  /// The pose that an <origin> child gives; the identity without one.
  Result<Pose> origin(pugi::xml_node element);

 private:
  /// Bytes from `begin` up to `end`.
  struct Range {
    std::size_t begin = 0;
    std::size_t end = 0;
  };
  Range tag_of(std::size_t name) const;
  Range attribute_in(Range tag, std::string_view attribute) const;
  /// Of an attribute of the element, or of its start tag.
  robot::Place place_of(pugi::xml_node element, std::string_view attribute) const;
  std::size_t line_at(std::size_t offset) const;
  Error broken(std::size_t offset, const std::string& why) const;

  std::string_view text_;
  std::string file_;
  Diagnostics& diagnostics_;
  pugi::xml_document document_;
  std::vector<std::size_t> line_starts_;
  std::size_t findings_ = 0;
};

/// Rotation by roll about x, then pitch about y, then yaw about z, all fixed axes [rad].
Quatd rotation_of_rpy(double roll, double pitch, double yaw);

}  // namespace tenon::urdf
