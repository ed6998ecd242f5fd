// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#if TENON_WITH_VIEW
#include "cli/python/ask_identify.h"

#include <cstdio>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/python/python_program.h"
#include "tenon/base/text/text_number.h"

namespace tenon::cli {
namespace {

using live::IdentifyStage;
using live::IdentifyWish;

/// The command line of the verb.
std::vector<std::string> words_of(const IdentifyWish& wish, const std::string& commands) {
  std::vector<std::string> words = {"--json", "--progress"};
  const auto give = [&](const char* option, const std::string& value) {
    if (!value.empty()) {
      words.push_back(std::string(option) + "=" + value);
    }
  };
  const auto all = [&](const char* option, const std::vector<std::string>& values) {
    for (const std::string& value : values) {
      give(option, value);
    }
  };
  const auto number = [&](const char* option, double value) {
    give(option, value > 0 ? shortest(value) : "");
  };
  give("--engine", wish.engine);
  give("--physics", wish.variant);
  all("--identify", wish.parameters);
  all("--prior", wish.priors);
  number("--dt", wish.time_step);
  number("--window", wish.window);
  if (wish.stage == IdentifyStage::SelfTest) {
    words.emplace_back("--self-test");
  } else {
    all("--held-out", wish.held_out);
    all("--map", wish.names);
    all("--sign", wish.signs);
    give("--units", wish.units);
    give("--commands", commands);
    number("--training", wish.training);
    if (wish.allow_gaps) {
      words.emplace_back("--allow-gaps");
    }
  }
  if (wish.stage == IdentifyStage::Check) {
    words.emplace_back("--check");
  }
  if (wish.stage == IdentifyStage::Solve) {
    give("--write", wish.layer);
    words.emplace_back("--dry-run");
    give("--starts", std::to_string(wish.starts));
    if (wish.hold) {
      words.emplace_back("--hold");
    }
  }
  words.emplace_back("--");
  words.push_back(wish.asset);
  words.insert(words.end(), wish.logs.begin(), wish.logs.end());
  return words;
}

constexpr std::string_view kProgress = "progress: ";

/// "round 2 of 4: ...": how much of the rounds is done.
double part_done(const std::string& line) {
  double round = 0;
  double rounds = 0;
  if (std::sscanf(line.c_str(), "round %lf of %lf", &round, &rounds) != 2 || rounds <= 0) {
    return 0;
  }
  return (round - 1) / rounds;
}

}  // namespace

Result<live::IdentifyEnd> ask_identify(const IdentifyWish& wish, const std::string& commands,
                                       live::Work& work) {
  work.at(0, "reading");
  const auto told = [&](const std::string& line) {
    if (line.starts_with(kProgress)) {
      const std::string text = line.substr(kProgress.size());
      work.at(part_done(text), text);
    }
  };
  TENON_TRY(PythonAnswer answer,
            ask_python_program("tenon_usd.identify.identify_command", words_of(wish, commands),
                               told, [&] { return work.is_ended(); }));
  return live::IdentifyEnd{answer.code, std::move(answer.output), std::move(answer.complaint)};
}

}  // namespace tenon::cli
#endif
