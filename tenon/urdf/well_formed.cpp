// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// One scan of a text that has been parsed, so each construct has its end. Other readers of robot
// descriptions refuse what is found here; authors of such files should learn it from this one.
#include "tenon/urdf/well_formed.h"

#include <algorithm>
#include <vector>

namespace tenon::urdf {
namespace {

constexpr std::string_view kXmlSpace = " \t\r\n";

class WellFormedScan {
 public:
  explicit WellFormedScan(std::string_view text) : text_(text) {}

  std::optional<XmlFault> run() {
    at_ = text_.starts_with("\xEF\xBB\xBF") ? 3 : 0;
    begin_ = at_;
    while (!fault_ && at_ < text_.size()) {
      const std::size_t open = std::min(text_.find('<', at_), text_.size());
      scan_text(at_, open);
      at_ = open;
      if (at_ < text_.size()) {
        scan_markup();
      }
    }
    return std::move(fault_);
  }

 private:
  void report(std::size_t offset, std::string message) {
    if (!fault_) {
      fault_ = XmlFault{offset, std::move(message)};
    }
  }

  bool is_at(std::string_view word) const { return text_.substr(at_).starts_with(word); }

  /// Moves behind the next `end`; where that begins.
  std::size_t skip_to(std::string_view end, std::size_t from) {
    const std::size_t found = std::min(text_.find(end, from), text_.size());
    at_ = std::min(found + end.size(), text_.size());
    return found;
  }

  void scan_text(std::size_t begin, std::size_t end) {
    const std::string_view part = text_.substr(begin, end - begin);
    if (depth_ == 0) {
      if (const std::size_t word = part.find_first_not_of(kXmlSpace); word != part.npos) {
        report(begin + word, "text outside of the root element");
      }
      return;
    }
    if (const std::size_t stray = part.find("]]>"); stray != part.npos) {
      report(begin + stray, "\"]]>\" in text");
    }
    scan_entities(begin, part);
  }

  /// Which entities a document type declares is not looked up.
  void scan_entities(std::size_t begin, std::string_view part) {
    for (std::size_t at = part.find('&'); at != part.npos && !has_type_;
         at = part.find('&', at + 1)) {
      const std::size_t end = part.find(';', at);
      const std::string_view name =
          end == part.npos ? std::string_view() : part.substr(at + 1, end - at - 1);
      const bool known = name == "lt" || name == "gt" || name == "amp" || name == "quot" ||
                         name == "apos" || (name.size() > 1 && name.front() == '#');
      if (!known) {
        report(begin + at, "\"&\" begins no entity of XML; write &amp; for the letter");
      }
    }
  }

  void scan_markup() {
    if (is_at("<!--")) {
      scan_comment();
    } else if (is_at("<![CDATA[")) {
      skip_to("]]>", at_);
    } else if (is_at("<?")) {
      if (is_at("<?xml ") && at_ != begin_) {
        report(at_, "the XML declaration does not come first");
      }
      skip_to("?>", at_);
    } else if (is_at("<!")) {
      skip_document_type();
    } else if (is_at("</")) {
      depth_ -= depth_ > 0 ? 1 : 0;
      skip_to(">", at_);
    } else {
      scan_tag();
    }
  }

  void scan_comment() {
    const std::size_t begin = at_ + 4;
    const std::size_t end = skip_to("-->", begin);
    const std::string_view part = text_.substr(std::min(begin, end), end - std::min(begin, end));
    if (const std::size_t dashes = part.find("--"); dashes != part.npos) {
      report(begin + dashes, "\"--\" in a comment");
    }
  }

  /// Its own declarations are in brackets.
  void skip_document_type() {
    has_type_ = true;
    const std::size_t stop = text_.find_first_of("[>", at_);
    if (stop != text_.npos && text_[stop] == '[') {
      skip_to("]", stop);
    }
    skip_to(">", at_);
  }

  void scan_tag() {
    if (depth_ == 0 && has_root_) {
      report(at_, "there is a second root element");
    }
    has_root_ = true;
    ++depth_;
    names_.clear();
    at_ = std::min(text_.find_first_of(" \t\r\n/>", at_), text_.size());
    while (!fault_) {
      at_ = std::min(text_.find_first_not_of(kXmlSpace, at_), text_.size());
      if (at_ == text_.size() || text_[at_] == '>') {
        break;
      }
      if (text_[at_] == '/') {
        --depth_;
        ++at_;
      } else {
        scan_attribute();
      }
    }
    at_ = std::min(at_ + 1, text_.size());
  }

  void scan_attribute() {
    // Of a tag with thousands of attributes the first are compared, so that time stays bounded.
    constexpr std::size_t kCompared = 64;
    const std::size_t begin = at_;
    const std::string_view name =
        text_.substr(begin, text_.find_first_of(" \t\r\n=", begin) - begin);
    const std::size_t open = text_.find_first_of("\"'", begin);
    const std::size_t close = open == text_.npos ? open : text_.find(text_[open], open + 1);
    if (close == text_.npos) {
      at_ = text_.size();
      return;
    }
    if (std::find(names_.begin(), names_.end(), name) != names_.end()) {
      report(begin, "the attribute " + std::string(name) + " is given twice");
    } else if (names_.size() < kCompared) {
      names_.push_back(name);
    }
    const std::string_view value = text_.substr(open + 1, close - open - 1);
    if (const std::size_t less = value.find('<'); less != value.npos) {
      report(open + 1 + less, "\"<\" in a value; write &lt;");
    }
    scan_entities(open + 1, value);
    at_ = close + 1;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t begin_ = 0;
  std::size_t depth_ = 0;
  bool has_root_ = false;
  bool has_type_ = false;
  std::vector<std::string_view> names_;  // of the attributes of a tag
  std::optional<XmlFault> fault_;
};

}  // namespace

std::optional<XmlFault> well_formed_fault(std::string_view text) {
  return WellFormedScan(text).run();
}

}  // namespace tenon::urdf
