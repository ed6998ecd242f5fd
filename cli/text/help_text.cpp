// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Help in two columns, filled greedily. A width counts characters, told by the bytes of UTF-8 that
// begin one. A name too long for its column gets a line of its own. On narrow terminals the second
// column moves to the middle, and its words keep kMinWords columns even beyond the width. In
// footers a line that begins with a blank is an example and stays one; the others are filled as
// paragraphs.
#include "cli/text/help_text.h"

#include <algorithm>

#include "tenon/base/text/comma_list.h"

namespace tenon::cli {
namespace {

constexpr std::size_t kNameColumn = 26;  // where the words about an option begin
constexpr std::size_t kMinWords = 20;    // columns that words get on the narrowest terminal

/// Columns of UTF-8 text, every character counted as one.
std::size_t columns(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u;
  }));
}

std::string row(const std::string& name, const std::string& about, std::size_t width) {
  const std::size_t column = std::min(kNameColumn, width / 2);
  std::string line = "  " + name;
  const std::size_t used = columns(line);
  line += used + 2 <= column ? std::string(column - used, ' ') : "\n" + std::string(column, ' ');
  const std::size_t words = std::max(width, column + kMinWords);
  return line + wrapped(std::string(column, ' ') + about, words, column).substr(column) + "\n";
}

std::string rows(const std::string& title, const std::vector<OptionInfo>& options, bool positional,
                 std::size_t width) {
  std::string text;
  for (const OptionInfo& option : options) {
    if (option.positional == positional) {
      text += row(option.signature(), option_help(option), width);
    }
  }
  return text.empty() ? text : "\n" + title + "\n" + text;
}

/// Whether an option of many verbs is listed behind those that the verb is for.
bool is_rare(const OptionInfo& option) {
  constexpr std::string_view kRare[] = {"--mask",        "--unloaded", "--load",
                                        "--mute-layer",  "--sandbox",  "--allow-read",
                                        "--search-path", "--max-work", "--reading"};
  return std::find(std::begin(kRare), std::end(kRare), option.longest_name()) != std::end(kRare);
}

std::string verb_rows(const std::string& title, const std::string& group,
                      const CommandInfo& command, std::size_t width) {
  std::string text;
  for (const CommandInfo& verb : command.commands) {
    text += verb.group == group ? row(verb.name, verb.about, width) : "";
  }
  return text.empty() ? text : "\n" + title + "\n" + text;
}

/// A line of a footer that stands as it is: an example and, behind two blanks, what it is for.
std::string example(std::string_view line, std::size_t width) {
  const std::size_t start = line.find_first_not_of(' ');
  const std::size_t gap = line.find("  ", start);
  if (columns(line) <= width) {
    return std::string(line);
  }
  if (gap == std::string_view::npos) {
    return wrapped(line, width, start + 4);
  }
  const std::size_t words = line.find_first_not_of(' ', gap);
  if (words <= kNameColumn && words + kMinWords <= width) {  // a row of a table
    const std::string all = std::string(words, ' ') + std::string(line.substr(words));
    return std::string(line.substr(0, words)) + wrapped(all, width, words).substr(words);
  }
  const std::string indent(start + 4, ' ');
  return wrapped(line.substr(0, gap), width, start + 4) + "\n" +
         wrapped(indent + std::string(line.substr(words)), width, start + 4);
}

/// Paragraphs are wrapped again; lines that begin with a blank or end with ':' stay lines.
std::string footer_text(const std::string& footer, std::size_t width) {
  std::string text;
  std::string paragraph;
  const auto end_paragraph = [&] {
    text += paragraph.empty() ? "" : wrapped(paragraph, width) + "\n";
    paragraph.clear();
  };
  for (std::size_t at = 0; at <= footer.size();) {
    const std::size_t end = std::min(footer.find('\n', at), footer.size());
    const std::string_view line = std::string_view(footer).substr(at, end - at);
    at = end + 1;
    if (line.empty() || line.front() == ' ') {
      end_paragraph();
      text += example(line, width) + "\n";
      continue;
    }
    paragraph += (paragraph.empty() ? "" : " ") + std::string(line);
    if (line.back() == ':') {
      end_paragraph();
    }
  }
  end_paragraph();
  return text;
}

}  // namespace

std::string wrapped(std::string_view text, std::size_t width, std::size_t indent) {
  std::string result(text.substr(0, std::min(text.find_first_not_of(' '), text.size())));
  std::size_t column = result.size();
  bool first = true;
  for (std::size_t at = result.size(); at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string_view word = text.substr(at, end - at);
    at = std::min(text.find_first_not_of(' ', end), text.size());
    if (!first && column + 1 + columns(word) > width) {
      result += "\n" + std::string(indent, ' ');
      column = indent;
    } else if (!first) {
      result += ' ';
      ++column;
    }
    result += word;
    column += columns(word);
    first = false;
  }
  return result;
}

std::string option_help(const OptionInfo& option) {
  std::string text = option.help;
  if (option.range) {
    text += " (" + option.range->text() + ")";
  }
  // Help that names every choice already needs no list of them.
  const bool named = std::all_of(option.choices.begin(), option.choices.end(),
                                 [&](const std::string& c) { return text.find(c) != text.npos; });
  if (!named) {
    const std::string choices = comma_list(option.choices);
    text += " (" + choices + ")";
  }
  return text;
}

std::string usage_line(const CommandInfo& command, const std::string& name) {
  std::string line = name;
  line += " [OPTIONS]";
  for (const OptionInfo& option : command.options) {
    if (option.positional) {
      line += " " + option.signature();
    }
  }
  return line + (command.commands.empty() ? "" : " VERB ...");
}

std::string help_text(const CommandInfo& command, const std::string& name,
                      const std::vector<OptionInfo>& shared, std::size_t width) {
  std::string text = wrapped(command.about, width) + "\n\n";
  text += wrapped("Usage: " + usage_line(command, name), width, 9) + "\n";
  text += rows("Arguments:", command.options, true, width);
  std::vector<OptionInfo> usual = command.options;
  const auto rare = std::stable_partition(
      usual.begin(), usual.end(), [](const OptionInfo& option) { return !is_rare(option); });
  text += rows("Options:", {usual.begin(), rare}, false, width);
  text += rows("Options for reading the asset:", {rare, usual.end()}, false, width);
  text += verb_rows("Verbs:", "", command, width);
  for (const std::string group : kVerbGroups) {
    text += verb_rows(group + ":", group, command, width);
  }
  text += rows("Options of every verb:", shared, false, width);
  return text + (command.footer.empty() ? "" : "\n" + footer_text(command.footer, width));
}

}  // namespace tenon::cli
