// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The scripts are made of the table that the parser fills, so they follow the options by
// themselves. Each offers, for a verb, its own options with those of the commands below it and of
// the program; values come from the closed choices of an option, else the shell completes files. In
// bash and zsh the verb is the first word that is neither an option nor the value of one of the
// program's options, in fish any word that is the name of a verb.
#include "cli/text/completion.h"

#include <functional>
#include <utility>
#include <vector>

#include "cli/text/help_text.h"

namespace tenon::cli {
namespace {

/// Text between single quotes of a shell.
std::string shell_quoted(std::string_view text) {
  std::string result = "'";
  for (const char c : text) {
    result += c == '\'' ? "'\\''" : std::string(1, c);
  }
  return result + "'";
}

std::string joined(const std::vector<std::string>& words, const char* between) {
  std::string text;
  for (const std::string& word : words) {
    text += (text.empty() ? "" : between) + word;
  }
  return text;
}

std::vector<std::string> names_of_verbs(const CommandInfo& program) {
  std::vector<std::string> names;
  for (const CommandInfo& verb : program.commands) {
    names.push_back(verb.name);
  }
  return names;
}

/// The options of a verb, those of the commands below it and of the program.
std::vector<OptionInfo> options_of(const CommandInfo& program, const CommandInfo& verb) {
  std::vector<OptionInfo> all = verb.options;
  for (const CommandInfo& below : verb.commands) {
    all.insert(all.end(), below.options.begin(), below.options.end());
  }
  all.insert(all.end(), program.options.begin(), program.options.end());
  std::erase_if(all, [](const OptionInfo& option) { return option.positional; });
  return all;
}

/// Words that may stand by themselves: verbs below this one, and what it takes by its place.
std::vector<std::string> plain_words(const CommandInfo& verb) {
  std::vector<std::string> words = names_of_verbs(verb);
  for (const OptionInfo& option : verb.options) {
    if (option.positional) {
      words.insert(words.end(), option.choices.begin(), option.choices.end());
    }
  }
  return words;
}

std::vector<std::string> with_names(std::vector<std::string> words,
                                    const std::vector<OptionInfo>& options) {
  for (const OptionInfo& option : options) {
    words.insert(words.end(), option.names.begin(), option.names.end());
  }
  return words;
}

std::string bash_reply(const std::vector<std::string>& words) {
  return "COMPREPLY=($(compgen -W " + shell_quoted(joined(words, " ")) + " -- \"$word\"))";
}

/// The values that options have behind a verb, or with "" in front of one.
std::string bash_choices(const std::string& verb, const std::vector<OptionInfo>& options) {
  std::string text;
  for (const OptionInfo& option : options) {
    if (!option.choices.empty()) {
      for (const std::string& name : option.names) {
        text += "    " + verb + "," + name + ") " + bash_reply(option.choices) + "; return ;;\n";
      }
    }
  }
  return text;
}

/// A loop for bash and zsh that puts the verb into `verb`: the words that are complete are those
/// of the array `words` from index `first` to before index `end`.
std::string verb_loop(const CommandInfo& program, const std::string& words, const char* first,
                      const std::string& end) {
  std::string with_value;
  for (const OptionInfo& option : program.options) {
    for (const std::string& name : option.names) {
      with_value += option.value.empty() ? "" : (with_value.empty() ? "" : "|") + name;
    }
  }
  std::string text = "  for ((i = " + std::string(first) + "; i < " + end + "; ++i)); do\n" +
                     "    case ${" + words + "[i]} in\n";
  text += with_value.empty() ? "" : "      " + with_value + ") ((++i)) ;;\n";
  return text + "      -*) ;;\n" + "      *) verb=${" + words + "[i]}; break ;;\n" +
         "    esac\n  done\n";
}

std::string bash_script(const CommandInfo& program) {
  std::string text =
      "# Completion of tenon for bash, made by: tenon completion bash\n"
      "_tenon() {\n"
      "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} verb= i\n";
  text += verb_loop(program, "COMP_WORDS", "1", "COMP_CWORD") + "  case $verb,$before in\n";
  text += bash_choices("", program.options);
  for (const CommandInfo& verb : program.commands) {
    text += bash_choices(verb.name, options_of(program, verb));
  }
  text += "  esac\n  case $verb in\n";
  text += "    '') " + bash_reply(with_names(names_of_verbs(program), program.options)) +
          "; return ;;\n";
  for (const CommandInfo& verb : program.commands) {
    text += "    " + verb.name + ") " +
            bash_reply(with_names(plain_words(verb), options_of(program, verb))) + " ;;\n";
  }
  return text +
         "  esac\n"
         "}\n"
         "complete -o bashdefault -o default -F _tenon tenon\n";
}

/// Words about an option in a specification of zsh's _arguments.
std::string zsh_escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    result +=
        c == ']' || c == '[' || c == ':' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  }
  return result;
}

std::string zsh_option(const OptionInfo& option) {
  std::string text;
  const std::string value = option.value.empty() ? ""
                            : option.choices.empty()
                                ? ":" + option.value + ":_files"
                                : ":" + option.value + ":(" + joined(option.choices, " ") + ")";
  for (const std::string& name : option.names) {
    text += " \\\n        " + shell_quoted((option.list ? "*" : "") + name + "[" +
                                           zsh_escaped(option_help(option)) + "]" + value);
  }
  return text;
}

std::string zsh_script(const CommandInfo& program) {
  std::string text =
      "#compdef tenon\n"
      "# Completion of tenon for zsh, made by: tenon completion zsh\n"
      "_tenon() {\n"
      "  local -a verbs=(\n";
  for (const CommandInfo& verb : program.commands) {
    text += "    " + shell_quoted(verb.name + ":" + zsh_escaped(verb.about)) + "\n";
  }
  text += "  )\n  local verb= i\n" + verb_loop(program, "words", "2", "CURRENT");
  text +=
      "  case $verb in\n"
      "    '')\n      _describe verb verbs\n      _arguments";
  for (const OptionInfo& option : program.options) {
    text += zsh_option(option);
  }
  text += " ;;\n";
  for (const CommandInfo& verb : program.commands) {
    text += "    " + verb.name + ")\n      _arguments";
    for (const OptionInfo& option : options_of(program, verb)) {
      text += zsh_option(option);
    }
    const std::vector<std::string> words = plain_words(verb);
    text += " \\\n        " +
            shell_quoted(words.empty() ? "*:file:_files" : "*:word:(" + joined(words, " ") + ")") +
            " ;;\n";
  }
  return text + "  esac\n}\n_tenon \"$@\"\n";
}

std::string fish_option(const OptionInfo& option, const std::string& condition) {
  std::string text = "complete -c tenon" + condition;
  for (const std::string& name : option.names) {
    text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  if (!option.choices.empty()) {
    text += " -x -a " + shell_quoted(joined(option.choices, " "));
  } else if (!option.value.empty() && !option.optional_value) {
    text += " -r";
  }
  return text + " -d " + shell_quoted(option_help(option)) + "\n";
}

std::string fish_script(const CommandInfo& program) {
  std::string text = "# Completion of tenon for fish, made by: tenon completion fish\n";
  const std::string none = " -n " + shell_quoted("not __fish_seen_subcommand_from " +
                                                 joined(names_of_verbs(program), " "));
  for (const CommandInfo& verb : program.commands) {
    text += "complete -c tenon -f" + none + " -a " + shell_quoted(verb.name) + " -d " +
            shell_quoted(verb.about) + "\n";
  }
  for (const OptionInfo& option : program.options) {
    text += fish_option(option, "");
  }
  for (const CommandInfo& verb : program.commands) {
    const std::string condition = " -n " + shell_quoted("__fish_seen_subcommand_from " + verb.name);
    if (const std::vector<std::string> words = plain_words(verb); !words.empty()) {
      text += "complete -c tenon -f" + condition + " -a " + shell_quoted(joined(words, " ")) + "\n";
    }
    for (const OptionInfo& option : options_of({}, verb)) {
      text += fish_option(option, condition);
    }
  }
  return text;
}

}  // namespace

std::optional<std::string> completion_script(const CommandInfo& program, std::string_view shell) {
  if (shell == "bash") {
    return bash_script(program);
  }
  if (shell == "zsh") {
    return zsh_script(program);
  }
  return shell == "fish" ? std::optional(fish_script(program)) : std::nullopt;
}

}  // namespace tenon::cli
