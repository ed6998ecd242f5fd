// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/text/diagnostic_lines.h"

#include <map>

#include "cli/text/terminal_text.h"
#include "tenon/base/text/grouped_digits.h"
#include "tenon/base/text/shown_path.h"

namespace tenon::cli {
namespace {

const char* color_of(Severity severity) {
  switch (severity) {
    case Severity::Error:
      return "\033[31m";
    case Severity::Warning:
      return "\033[33m";
    case Severity::Info:
      break;
  }
  return "\033[36m";
}

std::string colored(std::string line, Severity severity) {
  const std::string word = std::string(severity_name(severity)) + ":";
  const std::size_t at = line.find(word);
  if (at != std::string::npos) {
    line.replace(at, word.size(), color_of(severity) + word + "\033[0m");
  }
  return line;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Where the number ends that begins at `at`, with sign, point and exponent; `at` for none.
std::size_t end_of_number(const std::string& text, std::size_t at) {
  std::size_t end = at + (text[at] == '-' ? 1 : 0);
  if (end == text.size() || !is_digit(text[end])) {
    return at;
  }
  for (; end < text.size(); ++end) {
    const bool has_more = end + 1 < text.size();
    const bool is_point = text[end] == '.' && has_more && is_digit(text[end + 1]);
    const bool is_exponent =
        text[end] == 'e' && has_more && (text[end + 1] == '-' || text[end + 1] == '+');
    end += is_exponent ? 1 : 0;
    if (!is_digit(text[end]) && !is_point && !is_exponent) {
      break;
    }
  }
  return end;
}

/// A message without its names and numbers: what is in quotes, in <>, and numbers.
std::string kind_of(const Diagnostic& d) {
  std::string kind = std::string(severity_name(d.severity)) + d.rule + ' ';
  char closing = 0;
  for (std::size_t i = 0; i < d.message.size(); ++i) {
    const char c = d.message[i];
    if (closing != 0) {
      closing = c == closing ? '\0' : closing;
    } else if (c == '"' || c == '`' || c == '@' || c == '<') {
      closing = c == '<' ? '>' : c;
    } else if (const std::size_t end = end_of_number(d.message, i); end > i) {
      i = end - 1;
    } else {
      kind += c;
    }
  }
  return kind;
}

std::string words_of(const Remark& remark) {
  const Diagnostic& d = *remark.finding;
  std::string words = std::string(severity_name(d.severity)) + d.rule + '\n';
  // A message that names its own prim says the same of each.
  const std::size_t named = d.prim.empty() ? std::string::npos : d.message.find(d.prim);
  words += named == std::string::npos
               ? d.message
               : d.message.substr(0, named) + d.message.substr(named + d.prim.size());
  return words + '\n' + remark.behind;
}

/// How many findings one line represents; 0: it is omitted.
std::vector<std::size_t> weights(const std::vector<Remark>& findings) {
  std::map<std::string, std::vector<std::size_t>> same;
  for (std::size_t i = 0; i < findings.size(); ++i) {
    same[words_of(findings[i])].push_back(i);
  }
  std::vector<std::size_t> result(findings.size(), 1);
  for (const auto& [words, members] : same) {
    if (members.size() > kShownAlike) {
      for (const std::size_t i : members) {
        result[i] = 0;
      }
      result[members.front()] = members.size();
    }
  }
  std::map<std::string, std::vector<std::size_t>> kinds;
  for (std::size_t i = 0; i < findings.size(); ++i) {
    if (result[i] != 0) {
      kinds[kind_of(*findings[i].finding)].push_back(i);
    }
  }
  for (const auto& [kind, members] : kinds) {
    for (std::size_t i = kShownOfAKind; i < members.size(); ++i) {
      result[members[kShownOfAKind - 1]] += result[members[i]];
      result[members[i]] = 0;
    }
  }
  return result;
}

}  // namespace

std::vector<std::string> diagnostic_lines(const std::vector<Remark>& findings, bool color,
                                          bool all) {
  const std::vector<std::size_t> stands_for =
      all ? std::vector<std::size_t>(findings.size(), 1) : weights(findings);
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < findings.size(); ++i) {
    if (stands_for[i] == 0) {
      continue;
    }
    std::string line =
        diagnostic_line(*findings[i].finding, color) + terminal_text(findings[i].behind, false);
    if (stands_for[i] > 1) {
      line += " (and " + grouped_digits(stands_for[i] - 1) + " more like it; -v lists all)";
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

std::string diagnostic_line(Diagnostic diagnostic, bool color) {
  diagnostic.file = shown_path(diagnostic.file);
  const std::string line = terminal_text(diagnostic.to_string(), false);
  return color ? colored(line, diagnostic.severity) : line;
}

}  // namespace tenon::cli
