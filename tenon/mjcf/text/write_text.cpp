// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Models name things by the paths of prims, with the coordinate after a dot ("/r/j.rotY"), as paths
// are unique. Descriptions have the names of prims. The names are changed in the text, where all
// that refers to a thing has the same words as its name; MuJoCo's text has no other quotes and no
// bare ">". A path that two kinds of things share (a body that is its own collider) has one new
// name in both. The part after the dot is omitted where there is only one such thing.
//
// Any attribute of numbers may be rewritten, but not a name that reads as a number.
#include "tenon/mjcf/text/write_text.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "tenon/base/text/source_number.h"
#include "tenon/base/text/text_number.h"
#include "tenon/base/text/xml_text.h"
#include "tenon/mjcf/text/walk_text.h"

namespace tenon::mjcf {
namespace {

constexpr std::string_view kFreeJoint = ".free";

// No bare ">", so that elements end where one stands.
std::string escaped_name(std::string_view text) { return xml_text(text, "&<>\""); }

/// The kinds of things that have names of their own: by the element, but all actuators, all sensors
/// and so on are of one kind.
std::string_view kind_of(std::string_view section, std::string_view tag) {
  if (section == "worldbody" || section == "asset" || section == "deformable") {
    return tag == "freejoint" ? "joint" : tag;
  }
  return section;
}

class NameTable {
 public:
  NameTable(const std::string& text, const NameOf& name_of) : name_of_(name_of) {
    walk_text(text, [&](auto section, auto tag, auto attribute, auto value) {
      if (attribute == "name") {
        take(kind_of(section, tag), std::string(value));
      }
      return value;
    });
    for (const std::string& old : order_) {
      rename(old);
    }
  }

  bool is_name(std::string_view word) const { return kinds_.contains(word); }
  /// nullptr: it keeps its name.
  const std::string* find(std::string_view old) const {
    const auto found = renamed_.find(old);
    return found == renamed_.end() ? nullptr : &found->second;
  }

 private:
  void take(std::string_view kind, std::string name) {
    auto& kinds = kinds_[name];
    kinds.emplace_back(kind);
    if (!name.starts_with('/')) {
      taken_.emplace(kind, name);
      return;
    }
    ++parts_[{std::string(kind), name.substr(0, name.find('.'))}];
    if (kinds.size() == 1) {
      order_.push_back(std::move(name));
    }
  }

  void rename(const std::string& old) {
    const auto& kinds = kinds_.find(old)->second;
    const std::size_t dot = std::min(old.find('.'), old.size());
    std::string wanted = name_of_(std::string_view(old).substr(0, dot));
    const bool several = std::any_of(kinds.begin(), kinds.end(), [&](const std::string& kind) {
      return parts_[{kind, old.substr(0, dot)}] > 1;
    });
    if (several || old.ends_with(kFreeJoint)) {
      std::string rest = old.substr(dot);
      std::replace(rest.begin(), rest.end(), '.', '_');
      wanted += rest;
    }
    std::string name = wanted;
    const auto is_taken = [&](const std::string& kind) {
      return taken_.contains({kind, escaped_name(name)}) || (kind == "body" && name == "world");
    };
    std::size_t& last = last_[{wanted, kinds}];
    while (std::any_of(kinds.begin(), kinds.end(), is_taken)) {
      name = wanted + "_" + std::to_string(++last);
    }
    for (const std::string& kind : kinds) {
      taken_.emplace(kind, escaped_name(name));
    }
    renamed_.emplace(old, escaped_name(name));
  }

  const NameOf& name_of_;
  std::map<std::string, std::vector<std::string>, std::less<>> kinds_;  // by name
  std::map<std::pair<std::string, std::string>, int> parts_;            // by kind and prim
  std::vector<std::string> order_;
  std::set<std::pair<std::string, std::string>> taken_;  // kind and name
  // The number behind a name that things of these kinds want.
  std::map<std::pair<std::string, std::vector<std::string>>, std::size_t> last_;
  std::map<std::string, std::string, std::less<>> renamed_;
};

/// nullopt: not all of it are numbers.
std::optional<std::vector<double>> numbers_of(std::string_view text) {
  std::vector<double> result;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const auto number = parse_double(text.substr(at, end - at));
    if (!number) {
      return std::nullopt;
    }
    result.push_back(*number);
    at = std::min(text.find_first_not_of(' ', end), text.size());
  }
  return result.empty() ? std::nullopt : std::optional(std::move(result));
}

std::string joined(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) {
    out += (out.empty() ? "" : " ") + word;
  }
  return out;
}

/// MuJoCo's defaults of what its text leaves away at the end of these lists.
std::span<const double> whole_list(std::string_view attribute) {
  static constexpr std::array<double, 2> kSolref = {0.02, 1};
  static constexpr std::array<double, 5> kSolimp = {0.9, 0.95, 0.001, 0.5, 2};
  if (attribute.starts_with("solref")) {
    return kSolref;
  }
  return attribute.starts_with("solimp") ? std::span<const double>(kSolimp)
                                         : std::span<const double>();
}

/// Compilers refuse moments of which one is larger than the others together, be it by a last bit.
bool obeys_triangle(const std::vector<std::string>& moments) {
  std::array<double, 3> value{};
  for (std::size_t i = 0; i < value.size(); ++i) {
    value[i] = parse_double(moments[i]).value_or(0);
  }
  return value[0] + value[1] >= value[2] && value[0] + value[2] >= value[1] &&
         value[1] + value[2] >= value[0];
}

std::string number_text(std::string_view attribute, std::vector<double> numbers) {
  const std::span<const double> whole = whole_list(attribute);
  for (std::size_t i = numbers.size(); i < whole.size(); ++i) {
    numbers.push_back(whole[i]);
  }
  for (const std::string_view place : {"pos", "quat", "axis"}) {
    if (attribute == place) {
      drop_noise(numbers);
    }
  }
  std::vector<std::string> words;
  for (const double number : numbers) {
    words.push_back(source_number(number));
  }
  if (attribute == "diaginertia" && words.size() == 3 && !obeys_triangle(words)) {
    std::transform(numbers.begin(), numbers.end(), words.begin(),
                   [](double number) { return layer_text(number); });
  }
  return joined(words);
}

}  // namespace

std::string finished_text(const std::string& text, const NameOf& name_of) {
  const NameTable names(text, name_of);
  return walk_text(text, [&](auto, auto, auto attribute, auto value) -> std::string {
    if (const std::string* name = names.find(value)) {
      return *name;
    }
    auto numbers = names.is_name(value) ? std::nullopt : numbers_of(value);
    return numbers ? number_text(attribute, std::move(*numbers)) : std::string(value);
  });
}

}  // namespace tenon::mjcf
