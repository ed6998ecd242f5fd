// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <pugixml.hpp>

#include "tenon/base/result.h"

/// Internal to this folder.
namespace tenon {

/// A model in MuJoCo's format, whose elements are found by name and whose attributes can be set;
/// what is not set stays as it is written.
class ModelText {
 public:
  /// Error where the text is no XML.
  static Result<ModelText> read(const std::string& text);
  ModelText(ModelText&&) noexcept = default;
  ModelText& operator=(ModelText&&) noexcept = default;

  /// "body", "joint" and "geom" of the world, "actuator" whatever its element is called; none where
  /// no element, or several, have that name.
  pugi::xml_node named(std::string_view kind, const std::string& name) const;
  bool is_spring(pugi::xml_node actuator) const;
  /// The only actuator of a joint that is a spring and a damper about it; none: another number.
  pugi::xml_node spring_of(const std::string& joint) const;
  /// An element of the first level, made where there is none.
  pugi::xml_node section(const char* tag);

  /// The attribute of the element, of its class, or of a class around that; empty: of none.
  std::string value(pugi::xml_node node, const char* attribute) const;
  std::vector<double> numbers(pugi::xml_node node, const char* attribute) const;
  static void set(pugi::xml_node node, const char* attribute, const std::string& value);
  /// Sets the first numbers of an attribute; those that follow stay. `unset` are those that count
  /// where none has it.
  void set_numbers(pugi::xml_node node, const char* attribute, const std::vector<double>& numbers,
                   const std::vector<double>& unset = {}) const;

  std::string str() const;

 private:
  ModelText() = default;
  void index();

  std::unique_ptr<pugi::xml_document> document_;
  std::map<std::pair<std::string, std::string>, std::vector<pugi::xml_node>> named_;
  std::map<std::string, pugi::xml_node> classes_;  ///< <default> elements by class
};

}  // namespace tenon
