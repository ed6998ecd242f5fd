// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/compose/cache/index_cache.h"
#include "tenon/formats/open_layer.h"

/// What the programs that dump composed scenes have in common. Options of composition:
/// [--no-payloads] [--loaded PRIM]... [--unloaded PRIM]... [--rule PRIM
/// AllRule|OnlyRule|NoneRule]...
/// [--muted LAYER]... [--fallback SET VARIANT]... [--max-work UNITS] [--no-twins]
namespace tenon::tests {

/// False when `words` from `i` on are no option of composition; else `i` is at its last word.
inline bool read_compose_option(const std::vector<std::string>& words, std::size_t& i,
                                compose::ComposeOptions& options) {
  const std::string& word = words[i];
  const std::size_t left = words.size() - i - 1;
  if (word == "--no-payloads") {
    options.load_payloads = false;
  } else if (word == "--no-twins") {
    options.shares_twins = false;
  } else if (word == "--rule" && left >= 2) {
    const std::string& rule = words[i + 2];
    (rule == "AllRule"    ? options.loaded
     : rule == "OnlyRule" ? options.loaded_alone
                          : options.unloaded)
        .insert(Path::from(words[i + 1]));
    i += 2;
  } else if (word == "--loaded" && left >= 1) {
    options.loaded.insert(Path::from(words[++i]));
  } else if (word == "--unloaded" && left >= 1) {
    options.unloaded.insert(Path::from(words[++i]));
  } else if (word == "--muted" && left >= 1) {
    options.muted.insert(words[++i]);
  } else if (word == "--fallback" && left >= 2) {
    options.variant_fallbacks[words[i + 1]].push_back(words[i + 2]);
    i += 2;
  } else if (word == "--max-work" && left >= 1) {
    options.set_max_work(std::strtoull(words[++i].c_str(), nullptr, 10));
  } else {
    return false;
  }
  return true;
}

inline std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> words;
  std::size_t start = 0;
  for (std::size_t end = 0; end != std::string::npos; start = end + 1) {
    end = line.find('\t', start);
    words.push_back(line.substr(start, end - start));
  }
  return words;
}

/// Says what went wrong; the exit code of a program that cannot go on.
inline int fail(const Error& error) {
  std::fprintf(stderr, "%s\n", error.to_string().c_str());
  return 3;
}

/// What a stage is composed from; no session layer where none is named.
struct RootLayers {
  layer::LayerPtr root;
  layer::LayerPtr session;
};

inline Result<RootLayers> open_roots(formats::LayerRegistry& registry, const std::string& root,
                                     const std::string& session) {
  RootLayers layers;
  TENON_TRY(layers.root, registry.open_root(root));
  if (!session.empty()) {
    TENON_TRY(layers.session, registry.open(session, nullptr));
  }
  return layers;
}

/// Runs `words`, or with the one word --batch each line of standard input, a list of words
/// separated by tabs; what they print is then followed by a line "@@@ EXIT".
template <class Run>
int run_or_batch(const std::vector<std::string>& words, const Run& run) {
  if (words.size() != 1 || words.front() != "--batch") {
    return run(words);
  }
  for (std::string line; std::getline(std::cin, line);) {
    const int status = run(split(line));
    std::printf("@@@ %d\n", status);
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace tenon::tests
