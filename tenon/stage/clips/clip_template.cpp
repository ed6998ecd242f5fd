// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Clips named by a pattern: each group of '#' in `name.###.ext` becomes a time, a second group
// behind it the decimals. Missing files are skipped.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "tenon/base/limits/limits.h"
#include "tenon/base/limits/work_limits.h"
#include "tenon/base/text/text_number.h"
#include "tenon/stage/clips/clip_definition.h"

namespace tenon::stage {
namespace {

constexpr std::string_view kArguments = ":SDF_FORMAT_ARGS:";
// Times advance in steps of 1/10000, so that fractional strides do not drift.
constexpr double kSteps = 10000;
constexpr std::size_t kMaxDigits = 64;

struct Pattern {
  std::string folder;              // with its slash
  std::vector<std::string> words;  // of the file name, between dots
  std::string arguments;           // behind the file name
  std::size_t integer_word = 0;
  std::size_t integer_digits = 0;
  std::size_t decimal_digits = 0;  // 0: no decimals
};

std::vector<std::string> split_at_dots(std::string_view text) {
  std::vector<std::string> words;
  while (!text.empty()) {
    const std::size_t dot = text.find('.');
    if (dot != 0) {
      words.emplace_back(text.substr(0, dot));
    }
    text = dot == std::string_view::npos ? std::string_view() : text.substr(dot + 1);
  }
  return words;
}

Result<Pattern> read_pattern(const std::string& asset_path) {
  Pattern pattern;
  std::string path = asset_path;
  const std::size_t arguments = path.find(kArguments);
  if (arguments != std::string::npos) {
    pattern.arguments = path.substr(arguments);
    path.resize(arguments);
  }
  const std::size_t slash = path.rfind('/');
  const std::size_t name = slash == std::string::npos ? 0 : slash + 1;
  pattern.folder = path.substr(0, name);
  pattern.words = split_at_dots(std::string_view(path).substr(name));
  std::vector<std::size_t> groups;
  for (std::size_t i = 0; i < pattern.words.size(); ++i) {
    if (pattern.words[i].find_first_not_of('#') == std::string::npos) {
      groups.push_back(i);
    }
  }
  if (groups.empty() || groups.size() > 2 || (groups.size() == 2 && groups[1] != groups[0] + 1)) {
    return Error(ErrorCode::Invalid, "the template `" + asset_path + "` has no place for a time")
        .with_fix("write it as path/name.###.usd or path/name.###.###.usd");
  }
  pattern.integer_word = groups.front();
  pattern.integer_digits = pattern.words[groups.front()].size();
  pattern.decimal_digits = groups.size() == 2 ? pattern.words[groups.back()].size() : 0;
  if (pattern.integer_digits > kMaxDigits || pattern.decimal_digits > kMaxDigits) {
    return Error(ErrorCode::Limit, "the template asks for more than 64 digits");
  }
  return pattern;
}

std::string printed(const char* format, std::size_t digits, double time) {
  std::array<char, 512> text{};
  std::snprintf(text.data(), text.size(), format, static_cast<int>(digits), time);
  return text.data();
}

// "002" of 2.75 and three digits: the part before the point, filled up with zeros.
std::string integer_digits(double time, std::size_t digits) {
  const double whole = std::trunc(time) + 0.0;
  return printed("%0*.0f", digits, whole == 0 ? 0.0 : whole);
}

std::string decimals(double time, std::size_t digits) {
  const std::string text = printed("%.*f", digits, time);
  return text.substr(text.find('.') + 1);
}

std::string file_of(Pattern& pattern, double time) {
  pattern.words[pattern.integer_word] = integer_digits(time, pattern.integer_digits);
  if (pattern.decimal_digits > 0) {
    pattern.words[pattern.integer_word + 1] = decimals(time, pattern.decimal_digits);
  }
  std::string path = pattern.folder;
  for (std::size_t i = 0; i < pattern.words.size(); ++i) {
    path += (i == 0 ? "" : ".") + pattern.words[i];
  }
  return path;
}

/// A step leads to another time wherever it starts between the ends.
bool advances(const ClipTemplate& pattern) {
  const double largest = std::max(std::abs(pattern.start), std::abs(pattern.end)) * kSteps;
  return largest + pattern.stride * kSteps != largest &&
         largest - pattern.stride * kSteps != largest;
}

Result<void> check(const ClipTemplate& pattern) {
  const double offset = pattern.active_offset.value_or(0);
  if (!(pattern.stride > 0)) {
    return Error(ErrorCode::Invalid, "templateStride must be greater than 0");
  }
  if (!(std::abs(offset) <= pattern.stride)) {
    return Error(ErrorCode::Invalid, "templateActiveOffset must not exceed templateStride");
  }
  if (!(pattern.start <= pattern.end)) {
    return Error(ErrorCode::Invalid, "templateStartTime must not be greater than templateEndTime");
  }
  if (!(std::abs(pattern.start) < 1e15 && std::abs(pattern.end) < 1e15) ||
      !((pattern.end - pattern.start) / pattern.stride < limits::kTemplateClips)) {
    return Error(ErrorCode::Limit, "the template asks for more than " +
                                       std::to_string(limits::kTemplateClips) +
                                       " clips (kTemplateClips)");
  }
  if (pattern.start < pattern.end && !advances(pattern)) {
    return Error(ErrorCode::Limit, "templateStride " + shortest(pattern.stride) +
                                       " is too small to tell times near " + shortest(pattern.end) +
                                       " apart");
  }
  return {};
}

/// More steps than a checked template makes, however its times are rounded.
std::size_t max_steps(const ClipTemplate& pattern) {
  return pattern.start == pattern.end
             ? 1
             : 2 * static_cast<std::size_t>((pattern.end - pattern.start) / pattern.stride) + 2;
}

}  // namespace

Result<void> expand_template(const ClipTemplate& clip_template, const ClipFiles& files,
                             ClipDefinition& definition) {
  TENON_CHECK(check(clip_template));
  TENON_TRY(Pattern pattern, read_pattern(clip_template.asset_path));
  std::size_t left = max_steps(clip_template);
  if (left > *files.left) {
    return Error(ErrorCode::Limit, "the templates of this stage ask for more than " +
                                       std::to_string(limits::kTemplateFiles) +
                                       " files (kTemplateFiles)");
  }
  *files.left -= left;
  definition.asset_paths.emplace();
  definition.active.emplace();
  definition.times.emplace();
  const auto add_time = [&](double time) { definition.times->push_back({time, time}); };
  const double margin = std::abs(clip_template.active_offset.value_or(0)) * kSteps;
  if (clip_template.active_offset) {
    add_time((clip_template.start * kSteps - margin) / kSteps);
  }
  for (double step = clip_template.start * kSteps; step <= clip_template.end * kSteps && left > 0;
       step += clip_template.stride * kSteps, --left) {
    const double time = step / kSteps;
    const std::string file = file_of(pattern, time);
    if (!files.exists(file, *definition.layer)) {
      continue;
    }
    const auto index = static_cast<double>(definition.asset_paths->size());
    definition.asset_paths->push_back({file + pattern.arguments, {}, {}});
    add_time(time);
    const double start = clip_template.active_offset
                             ? (step + *clip_template.active_offset * kSteps) / kSteps
                             : time;
    definition.active->push_back({start, index});
  }
  if (clip_template.active_offset) {
    add_time((clip_template.end * kSteps + margin) / kSteps);
  }
  return {};
}

}  // namespace tenon::stage
