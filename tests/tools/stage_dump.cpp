// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Prints the dump of a composed stage (tenon/answers/dump/stage_dump.h) with the stacks of all
// specs, on one line, for tests/differential.
//
// usage: stage_dump LAYER [--session LAYER] [--mask PRIM]... [OPTION OF COMPOSITION]...
//        stage_dump --batch
// Options of composition and --batch: see tests/tools/compose_options.h.
// Exit: 0 printed; 2 wrong usage; 3 a layer could not be opened.
#include "tenon/answers/dump/stage_dump.h"

#include <algorithm>
#include <cstdio>
#include <sstream>
#include <string>

#include "tenon/formats/open_layer.h"
#include "tests/tools/compose_options.h"

namespace {

using namespace tenon;
using tests::fail;
using tests::open_roots;
using tests::RootLayers;

struct Arguments {
  std::string root;
  std::string session;
  stage::StageOptions options;
};

bool read_arguments(const std::vector<std::string>& words, Arguments& arguments) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word == "--session" && i + 1 < words.size()) {
      arguments.session = words[++i];
    } else if (word == "--mask" && i + 1 < words.size()) {
      arguments.options.mask.insert(Path::from(words[++i]));
    } else if (tests::read_compose_option(words, i, arguments.options.compose)) {
      continue;
    } else if (arguments.root.empty() && word.rfind("--", 0) != 0) {
      arguments.root = word;
    } else {
      return false;
    }
  }
  return !arguments.root.empty();
}

int dump(Arguments arguments) {
  formats::LayerRegistry registry;
  const Result<RootLayers> roots = open_roots(registry, arguments.root, arguments.session);
  if (!roots) {
    return fail(roots.error());
  }
  arguments.options.resolve_asset = [&](const std::string& asset, const layer::Layer& anchor) {
    return registry.resolver().resolve(asset, anchor.identifier()).value_or(std::string());
  };
  const auto opener = [&](const std::string& path, const layer::Layer& anchor) {
    return registry.open(path, &anchor);
  };
  const auto stage =
      stage::Stage::open(roots->root, roots->session, opener, std::move(arguments.options));
  if (!stage) {
    return fail(stage.error());
  }
  answers::DumpOptions options;
  options.stacks = true;
  std::ostringstream out;
  answers::write_stage_dump(*stage, options, out);
  std::string text = out.str();
  std::replace(text.begin(), text.end(), '\n', ' ');
  std::printf("%s\n", text.c_str());
  return 0;
}

int run(const std::vector<std::string>& words) {
  Arguments arguments;
  if (!read_arguments(words, arguments)) {
    std::fprintf(stderr, "usage: see the head of tests/tools/stage_dump.cpp\n");
    return 2;
  }
  return dump(std::move(arguments));
}

}  // namespace

int main(int count, char** words) { return tests::run_or_batch({words + 1, words + count}, run); }
