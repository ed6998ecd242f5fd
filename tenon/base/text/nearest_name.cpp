// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/text/nearest_name.h"

#include <algorithm>
#include <cctype>

namespace tenon {
namespace {

bool same_but_capitals(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) ==
           std::tolower(static_cast<unsigned char>(y));
  });
}

std::size_t length_difference(std::string_view a, std::string_view b) {
  return std::max(a.size(), b.size()) - std::min(a.size(), b.size());
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1);  // two rows up
  std::vector<std::size_t> above(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) {
    above[j] = j;
  }
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t exchange = above[j - 1] + (a[i - 1] == b[j - 1] ? 0u : 1u);
      row[j] = std::min({exchange, above[j] + 1, row[j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], before[j - 2] + 1);
      }
    }
    std::swap(before, above);
    std::swap(above, row);
  }
  return above[b.size()];
}

std::string_view nearest_name(std::string_view name, const std::vector<std::string_view>& names) {
  constexpr std::size_t kLongest = 200;
  std::string_view best;
  if (name.size() > kLongest) {
    return best;
  }
  std::size_t best_distance = name.size() < 6 ? 2 : 3;  // one more than may be
  for (const std::string_view candidate : names) {
    if (candidate == name) {
      return {};
    }
    const std::size_t d = same_but_capitals(name, candidate) ? 0
                          : length_difference(name, candidate) > best_distance
                              ? best_distance + 1
                              : edit_distance(name, candidate);
    if (d < best_distance || (d == best_distance && !best.empty() && candidate < best)) {
      best = candidate;
      best_distance = d;
    }
  }
  return best;
}

std::string_view NearestNames::find(Token name) {
  constexpr std::size_t kMax = 1000;
  const auto known = found_.find(name);
  if (known != found_.end()) {
    return known->second;
  }
  if (found_.size() >= kMax) {
    return {};
  }
  if (make_names_) {
    names_ = make_names_();
    make_names_ = nullptr;
  }
  return found_.emplace(name, nearest_name(name.view(), names_)).first->second;
}

}  // namespace tenon
