// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/text/man_page.h"

#include <algorithm>
#include <string_view>

#include "cli/text/help_text.h"
#include "cli/text/settings_text.h"

namespace tenon::cli {
namespace {

/// Text that roff prints as it is.
std::string roff(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if ((c == '.' || c == '\'') && (result.empty() || result.back() == '\n')) {
      result += "\\&";  // else it would begin a request
    }
    result += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
  }
  return result;
}

std::string options_text(const std::vector<OptionInfo>& options) {
  std::string text;
  for (const OptionInfo& option : options) {
    text += ".TP\n.B " + roff(option.signature()) + "\n" + roff(option_help(option)) + "\n";
  }
  return text;
}

/// Footers hold examples in columns, which stay as they are written.
std::string footer_text(const std::string& footer) {
  return footer.empty() ? "" : ".PP\n.nf\n" + roff(footer) + "\n.fi\n";
}

std::string verb_text(const CommandInfo& verb, const std::string& name) {
  std::string text = ".SS " + roff(name) + "\n" + roff(verb.about) + ".\n.PP\n.B " +
                     roff(usage_line(verb, name)) + "\n" + options_text(verb.options);
  for (const CommandInfo& below : verb.commands) {
    text += ".PP\n.B " + roff(usage_line(below, name + " " + below.name)) + "\n.br\n" +
            roff(below.about) + ".\n" + options_text(below.options);
  }
  return text + footer_text(verb.footer);
}

std::string settings_section() {
  std::string text = ".SH SETTINGS\n" + roff(settings_about()) + "\n";
  for (const settings::Key& key : settings::keys()) {
    text += ".TP\n.B " + roff(key.name) + "\n" + roff(settings_key_text(key)) + "\n" +
            footer_text(std::string(key.example));
  }
  return text;
}

}  // namespace

std::string man_page(const CommandInfo& program, const std::string& version) {
  std::string text = ".TH TENON 1 \"\" \"tenon " + roff(version) + "\"\n.SH NAME\n" +
                     "tenon \\- convert, check, fix, tune and simulate robot USD\n" +
                     ".SH SYNOPSIS\n.B tenon\n.I VERB\n[\\fIOPTIONS\\fR] [\\fIARGUMENTS\\fR]\n" +
                     ".SH OPTIONS OF EVERY VERB\n" + options_text(program.options) + ".SH VERBS\n";
  for (const CommandInfo& verb : program.commands) {
    text += verb_text(verb, "tenon " + verb.name);
  }
  return text + settings_section() + ".SH EXAMPLES AND EXIT CODES\n" + footer_text(program.footer);
}

}  // namespace tenon::cli
