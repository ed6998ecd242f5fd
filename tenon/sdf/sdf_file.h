// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <pugixml.hpp>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/bytes/file_bytes.h"
#include "tenon/math/transform.h"
#include "tenon/robot/robot_model.h"
#include "tenon/urdf/xml_reader.h"

/// Internal to this folder.
namespace tenon::sdf {

/// A <pose> as it is written; the identity without one.
struct WrittenPose {
  Pose pose;
  std::string relative_to;  ///< empty: what the element's kind has by default
  bool is_there = false;
};

/// One file of a description: its elements, which hold their values as text, and the faults in it.
/// Messages name the file and the line.
class SdfFile {
 public:
  /// `bytes` is kept where it is not null; else `text` outlives this. `is_main`: the file that was
  /// asked for, not one that it includes.
  SdfFile(std::string_view text, std::shared_ptr<const bytes::FileBytes> bytes, std::string path,
          bool is_main, Diagnostics& diagnostics);

  /// Errors: Parse for what is no XML, Unsupported for another root than <sdf>.
  Result<void> parse();

  const std::string& path() const { return xml_.file(); }
  const std::string& folder() const { return folder_; }
  pugi::xml_node root() const { return root_; }
  /// 7 for version 1.7; the newest where the file does not say.
  unsigned minor_version() const { return minor_version_; }
  /// Zeros in other files than the main one, as places of a model are places in that.
  robot::Place place_of(pugi::xml_node element) const;

  Error fault(pugi::xml_node element, const char* rule, const std::string& message,
              std::string fix) const;
  void warn(pugi::xml_node element, const char* rule, std::string message, std::string fix,
            Severity severity = Severity::Warning);
  /// Names each child of `element` that is in neither list: an error of the file for unknown ones,
  /// an info for `others`, which are settings of simulators.
  void list_skipped(pugi::xml_node element, std::initializer_list<std::string_view> taken,
                    std::initializer_list<std::string_view> others);

  /// The text of an element without the spaces around it.
  static std::string text_of(pugi::xml_node element);
  /// Of the child `name` of an element; `fallback` without one. Errors (Parse): not that.
  Result<double> number(pugi::xml_node element, const char* name, double fallback) const;
  Result<std::vector<double>> numbers(pugi::xml_node element, const char* name,
                                      std::vector<double> fallback) const;
  Result<bool> flag(pugi::xml_node element, const char* name, bool fallback) const;
  /// Two numbers in the text of an element.
  Result<std::vector<double>> pair_in(pugi::xml_node element) const {
    return numbers_in(element, 2);
  }
  /// Three or four numbers.
  Result<std::vector<double>> color_in(pugi::xml_node element) const;
  Result<WrittenPose> pose(pugi::xml_node element) const;
  /// An attribute that must be there.
  Result<std::string> attribute(pugi::xml_node element, const char* name) const;

 private:
  /// All numbers in the text of an element; exactly `count` of them.
  Result<std::vector<double>> numbers_in(pugi::xml_node element, std::size_t count) const;
  /// Of the text of a <pose>.
  Result<Pose> read_pose(pugi::xml_node child) const;
  void read_version();

  std::shared_ptr<const bytes::FileBytes> bytes_;
  urdf::XmlReader xml_;
  std::string folder_;
  bool is_main_;
  pugi::xml_node root_;
  unsigned minor_version_;
};

}  // namespace tenon::sdf
