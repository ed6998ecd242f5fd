// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Where reading stops is seldom where a closing bracket is wrong: one that stands too early closes
// something else, and only the rest of the text shows it. So ways to repair the text are tried, and
// each is judged by reading what it leaves. The search is breadth first: from a text that cannot be
// read it goes on to those without a bracket that may be at fault there, which are the one at the
// fault, those right before it, and early ones that closed a prim of the layer. What is advised has
// been read, so it works when it is followed.
#include "tenon/formats/text/brackets/stray_brackets.h"

#include <algorithm>
#include <deque>
#include <optional>
#include <set>
#include <tuple>

#include "tenon/base/path.h"
#include "tenon/base/result.h"
#include "tenon/formats/text/fault_recovery.h"
#include "tenon/formats/text/layer_reader.h"

namespace tenon::formats::text {
namespace {

using Offsets = std::vector<std::size_t>;  // ascending

constexpr std::size_t kLargestText = std::size_t{1} << 20;  // bytes
constexpr std::size_t kMostBytes = std::size_t{16} << 20;   // read in all
constexpr std::size_t kMostReadings = 200;
constexpr std::size_t kMostRemoved = 6;
constexpr std::size_t kLongestRun = 4;  // brackets before a fault that are looked at together

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
bool is_closing(char c) { return c == '}' || c == ')' || c == ']'; }

std::string without(std::string_view text, const Offsets& removed) {
  std::string rest(text);
  for (const std::size_t offset : removed) {
    rest[offset] = ' ';
  }
  return rest;
}

bool has_surplus(const std::vector<Bracket>& brackets) {
  const auto count = [&](char sign) {
    return std::count_if(brackets.begin(), brackets.end(),
                         [&](const Bracket& bracket) { return bracket.sign == sign; });
  };
  return count('}') > count('{') || count(')') > count('(') || count(']') > count('[');
}

/// Paths </A/B> in the text that name no prim of the layer; those behind an asset path are of other
/// layers.
std::size_t dangling_paths(std::string_view text, const layer::Layer& layer) {
  std::size_t count = 0;
  for (std::size_t at = text.find("</"); at != std::string_view::npos;
       at = text.find("</", at + 1)) {
    const std::size_t end = text.find_first_of(">.{\n", at);
    if (end == std::string_view::npos || (at > 0 && text[at - 1] == '@')) {
      continue;
    }
    const Result<Path> path = Path::parse(text.substr(at + 1, end - at - 1));
    count += path && !layer.has(*path) ? 1 : 0;
  }
  return count;
}

/// What reading a text gives: a fault, or how many paths lead nowhere.
struct Reading {
  std::optional<std::size_t> fault;
  std::size_t dangling = 0;
};

Reading read(std::string_view text) {
  Diagnostics ignored;
  LayerReader reader(text, {}, ignored, nullptr);
  if (!reader.read_from_front()) {
    return {reader.fault(), 0};
  }
  const auto layer = reader.finish();
  return {std::nullopt, layer ? dangling_paths(text, *layer) : 0};
}

/// In how many places brackets are taken away: such with nothing but blanks between them are one.
std::size_t places(std::string_view text, const Offsets& removed) {
  std::size_t count = removed.empty() ? 0 : 1;
  const std::string rest = without(text, removed);
  for (std::size_t i = 1; i < removed.size(); ++i) {
    const auto from = rest.begin() + static_cast<std::ptrdiff_t>(removed[i - 1]);
    const auto to = rest.begin() + static_cast<std::ptrdiff_t>(removed[i]);
    count += std::all_of(from, to, is_blank) ? 0 : 1;
  }
  return count;
}

/// Closing brackets right before `fault`, the nearest first.
Offsets run_before(std::string_view text, std::size_t fault) {
  Offsets run;
  for (std::size_t at = fault; at > 0 && run.size() < kLongestRun;) {
    const char c = text[--at];
    if (is_closing(c)) {
      run.push_back(at);
    } else if (!is_blank(c)) {
      break;
    }
  }
  return run;
}

/// The '}' before `fault` that closed prims of the layer: the first one and the last two.
Offsets closed_roots(std::string_view text, std::size_t fault) {
  Offsets closed;
  std::size_t depth = 0;
  for (const Bracket& bracket : brackets_of(text)) {
    if (bracket.offset >= fault) {
      break;
    }
    if (bracket.sign == '{') {
      ++depth;
    } else if (bracket.sign == '}' && depth > 0) {
      --depth;
      if (depth == 0) {
        closed.push_back(bracket.offset);
      }
    }
  }
  if (closed.size() > 3) {
    closed.erase(closed.begin() + 1, closed.end() - 2);
  }
  return closed;
}

/// Sets of brackets that may be what is wrong at `fault`.
std::vector<Offsets> suspects(std::string_view text, std::size_t fault) {
  std::vector<Offsets> found;
  if (fault < text.size() && is_closing(text[fault])) {
    found.push_back({fault});
  }
  const Offsets run = run_before(text, fault);
  for (std::size_t count = 1; count <= run.size(); ++count) {
    found.emplace_back(run.begin(), run.begin() + static_cast<std::ptrdiff_t>(count));
  }
  for (const std::size_t offset : closed_roots(text, fault)) {
    found.push_back({offset});
  }
  return found;
}

using Cost = std::tuple<std::size_t, std::size_t, std::size_t>;  // dangling, places, brackets

std::string line_list(const std::vector<std::string>& lines) {
  std::string list = lines.size() == 1 ? "line " : "lines ";
  for (std::size_t i = 0; i < lines.size(); ++i) {
    list += (i == 0 ? "" : i + 1 == lines.size() ? " and " : ", ") + lines[i];
  }
  return list;
}

}  // namespace

std::vector<std::size_t> stray_brackets(std::string_view text) {
  if (text.size() > kLargestText || !has_surplus(brackets_of(text))) {
    return {};
  }
  const std::size_t readings =
      std::min(kMostReadings, kMostBytes / std::max<std::size_t>(text.size(), 1));
  std::deque<Offsets> open{{}};
  std::set<Offsets> known{{}};
  std::optional<Cost> least;
  Offsets best;
  for (std::size_t i = 0; i < readings && !open.empty(); ++i) {
    const Offsets removed = std::move(open.front());
    open.pop_front();
    const std::string rest = without(text, removed);
    const Reading reading = read(rest);
    if (!reading.fault) {
      const Cost cost{reading.dangling, places(text, removed), removed.size()};
      if (!least || cost < *least || (cost == *least && removed > best)) {
        least = cost;
        best = removed;
      }
      continue;
    }
    for (const Offsets& more : suspects(rest, *reading.fault)) {
      Offsets next = removed;
      next.insert(next.end(), more.begin(), more.end());
      std::sort(next.begin(), next.end());
      if (next.size() <= kMostRemoved && known.insert(next).second) {
        open.push_back(std::move(next));
      }
    }
  }
  return best;
}

std::string removal_advice(std::string_view text, const std::vector<std::size_t>& offsets) {
  std::string advice;
  for (const char sign : {'}', ')', ']'}) {
    std::vector<std::string> lines;
    for (const std::size_t offset : offsets) {
      if (text[offset] != sign) {
        continue;
      }
      const std::size_t begin = text.substr(0, offset).find_last_of('\n') + 1;
      const std::size_t end = std::min(text.find('\n', offset), text.size());
      const std::string_view line = text.substr(begin, end - begin);
      const auto number =
          std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(begin), '\n');
      const bool is_alone = std::count(line.begin(), line.end(), sign) == 1;
      lines.push_back(std::to_string(number + 1) +
                      (is_alone ? "" : ":" + std::to_string(offset - begin + 1)));
    }
    if (!lines.empty()) {
      advice += (advice.empty() ? "remove the '" : " and the '") + std::string(1, sign) + "' at " +
                line_list(lines);
    }
  }
  return advice;
}

}  // namespace tenon::formats::text
