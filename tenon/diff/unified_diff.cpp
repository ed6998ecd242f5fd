// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Myers' greedy search ("An O(ND) Difference Algorithm and Its Variations", 1986) over lines. The
// common beginning and end of two texts are removed first, so that few lines are searched.
#include "tenon/diff/unified_diff.h"

#include <algorithm>
#include <string_view>
#include <vector>

namespace tenon::diff {
namespace {

using Lines = std::vector<std::string_view>;
constexpr std::size_t kAround = 3;
constexpr std::ptrdiff_t kMaxEdits = 2000;  ///< beyond, everything between is replaced

Lines lines_of(const std::string& text) {
  Lines lines;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1);
    lines.push_back(std::string_view(text).substr(at, end + 1 - at));
    at = end + 1;
  }
  return lines;
}

/// One line of the comparison.
struct Step {
  char mark = ' ';  ///< ' ', '-' or '+'
  std::string_view line;
};

/// Steps backwards through the furthest-reaching points of each number of edits.
std::vector<Step> trace_back(const Lines& a, const Lines& b,
                             const std::vector<std::vector<std::ptrdiff_t>>& history,
                             std::ptrdiff_t middle) {
  std::vector<Step> steps;
  auto x = static_cast<std::ptrdiff_t>(a.size());
  auto y = static_cast<std::ptrdiff_t>(b.size());
  for (auto d = static_cast<std::ptrdiff_t>(history.size()) - 1; d >= 0; --d) {
    const auto& reach = history[static_cast<std::size_t>(d)];
    const auto at = [&](std::ptrdiff_t k) { return reach[static_cast<std::size_t>(middle + k)]; };
    const std::ptrdiff_t k = x - y;
    const bool down = k == -d || (k != d && at(k - 1) < at(k + 1));
    const std::ptrdiff_t from_x = d == 0 ? 0 : (down ? at(k + 1) : at(k - 1));
    const std::ptrdiff_t from_y = d == 0 ? 0 : from_x - (down ? k + 1 : k - 1);
    while (x > from_x && y > from_y) {
      steps.push_back({' ', a[static_cast<std::size_t>(--x)]});
      --y;
    }
    if (d > 0) {
      steps.push_back(down ? Step{'+', b[static_cast<std::size_t>(--y)]}
                           : Step{'-', a[static_cast<std::size_t>(--x)]});
    }
  }
  std::reverse(steps.begin(), steps.end());
  return steps;
}

std::vector<Step> replaced(const Lines& a, const Lines& b) {
  std::vector<Step> steps;
  for (const std::string_view line : a) {
    steps.push_back({'-', line});
  }
  for (const std::string_view line : b) {
    steps.push_back({'+', line});
  }
  return steps;
}

std::vector<Step> compare_middle(const Lines& a, const Lines& b) {
  const auto n = static_cast<std::ptrdiff_t>(a.size());
  const auto m = static_cast<std::ptrdiff_t>(b.size());
  const std::ptrdiff_t most = std::min(n + m, kMaxEdits);
  const std::ptrdiff_t middle = most + 1;
  std::vector<std::ptrdiff_t> reach(static_cast<std::size_t>(2 * middle + 1), 0);
  const auto at = [&](std::ptrdiff_t k) -> std::ptrdiff_t& {
    return reach[static_cast<std::size_t>(middle + k)];
  };
  std::vector<std::vector<std::ptrdiff_t>> history;
  for (std::ptrdiff_t d = 0; d <= most; ++d) {
    history.push_back(reach);
    for (std::ptrdiff_t k = -d; k <= d; k += 2) {
      std::ptrdiff_t x = k == -d || (k != d && at(k - 1) < at(k + 1)) ? at(k + 1) : at(k - 1) + 1;
      while (x < n && x - k < m &&
             a[static_cast<std::size_t>(x)] == b[static_cast<std::size_t>(x - k)]) {
        ++x;
      }
      at(k) = x;
      if (x >= n && x - k >= m) {
        return trace_back(a, b, history, middle);
      }
    }
  }
  return replaced(a, b);
}

std::vector<Step> compare(const Lines& a, const Lines& b) {
  std::size_t head = 0;
  while (head < a.size() && head < b.size() && a[head] == b[head]) {
    ++head;
  }
  std::size_t tail = 0;
  while (tail < a.size() - head && tail < b.size() - head &&
         a[a.size() - 1 - tail] == b[b.size() - 1 - tail]) {
    ++tail;
  }
  const auto part = [&](const Lines& lines) {
    return Lines(lines.begin() + static_cast<std::ptrdiff_t>(head),
                 lines.end() - static_cast<std::ptrdiff_t>(tail));
  };
  std::vector<Step> steps;
  for (std::size_t i = 0; i < head; ++i) {
    steps.push_back({' ', a[i]});
  }
  const std::vector<Step> middle = compare_middle(part(a), part(b));
  steps.insert(steps.end(), middle.begin(), middle.end());
  for (std::size_t i = a.size() - tail; i < a.size(); ++i) {
    steps.push_back({' ', a[i]});
  }
  return steps;
}

/// "12,3" or "12" for a range; a range of no lines names the line before it.
std::string range_text(std::size_t first, std::size_t count) {
  return std::to_string(count == 0 ? first : first + 1) +
         (count == 1 ? "" : "," + std::to_string(count));
}

void append_hunk(const std::vector<Step>& steps, std::size_t begin, std::size_t end,
                 std::string& out) {
  std::size_t old_first = 0;
  std::size_t new_first = 0;
  for (std::size_t i = 0; i < begin; ++i) {
    old_first += steps[i].mark != '+' ? 1 : 0;
    new_first += steps[i].mark != '-' ? 1 : 0;
  }
  std::size_t old_count = 0;
  std::size_t new_count = 0;
  std::string body;
  for (std::size_t i = begin; i < end; ++i) {
    old_count += steps[i].mark != '+' ? 1 : 0;
    new_count += steps[i].mark != '-' ? 1 : 0;
    body += steps[i].mark;
    body += steps[i].line;
    if (!steps[i].line.ends_with('\n')) {
      body += "\n\\ No newline at end of file\n";
    }
  }
  out += "@@ -" + range_text(old_first, old_count) + " +" + range_text(new_first, new_count) +
         " @@\n" + body;
}

}  // namespace

std::string unified_diff(const std::string& name, const std::string& before,
                         const std::string& after) {
  if (before == after) {
    return {};
  }
  const std::vector<Step> steps = compare(lines_of(before), lines_of(after));
  std::string out = "--- a/" + name + "\n+++ b/" + name + "\n";
  std::size_t i = 0;
  while (i < steps.size()) {
    if (steps[i].mark == ' ') {
      ++i;
      continue;
    }
    const std::size_t begin = i < kAround ? 0 : i - kAround;
    std::size_t last = i;
    for (std::size_t j = i; j < steps.size() && j <= last + 2 * kAround; ++j) {
      last = steps[j].mark == ' ' ? last : j;
    }
    const std::size_t end = std::min(last + 1 + kAround, steps.size());
    append_hunk(steps, begin, end, out);
    i = end;
  }
  return out;
}

}  // namespace tenon::diff
