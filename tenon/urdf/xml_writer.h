// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "tenon/base/text/xml_text.h"

namespace tenon::urdf {

/// Elements of XML in order, each on a line of its own, indented by depth.
class XmlWriter {
 public:
  using AttributeList = std::vector<std::pair<const char*, std::string>>;

  /// Elements for the inside of a document, indented by `depth` steps more.
  static XmlWriter part(std::size_t depth) {
    XmlWriter writer;
    writer.text_.clear();
    writer.depth_ = depth;
    return writer;
  }

  void open(const char* name, const AttributeList& attributes = {}) {
    start(name, attributes);
    text_ += ">\n";
    ++depth_;
  }
  void empty(const char* name, const AttributeList& attributes) {
    start(name, attributes);
    text_ += "/>\n";
  }
  /// An element that holds text alone.
  void leaf(const char* name, const std::string& text, const AttributeList& attributes = {}) {
    start(name, attributes);
    text_ += ">" + xml_text(text) + "</" + name + ">\n";
  }
  void close(const char* name) {
    --depth_;
    text_ += std::string(2 * depth_, ' ') + "</" + name + ">\n";
  }
  std::string take() { return std::move(text_); }

 private:
  void start(const char* name, const AttributeList& attributes) {
    text_ += std::string(2 * depth_, ' ') + "<" + name;
    for (const auto& [key, value] : attributes) {
      text_ += std::string(" ") + key + "=\"" + xml_text(value) + "\"";
    }
  }
  std::string text_ = "<?xml version=\"1.0\"?>\n";
  std::size_t depth_ = 0;
};

}  // namespace tenon::urdf
