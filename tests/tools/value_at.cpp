// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Prints where an attribute's value comes from and what it is, for the scripts under tests/.
//
// usage: value_at LAYER [--held] QUESTION... [@LAYER QUESTION...]...
// A QUESTION is an ATTRIBUTE, an absolute property path, and its TIMEs, each a number or `default`;
// `@` goes on with another layer. One line per time: source, a tab, and the value as text layers
// print it (nothing where there is none).
// Exit: 0 printed; 2 wrong usage; 3 a layer could not be opened.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/base/text/text_number.h"
#include "tenon/formats/open_layer.h"
#include "tenon/formats/text/write/value_text.h"
#include "tenon/stage/stage.h"

namespace {

using namespace tenon;

const char* source_name(stage::ValueSource source) {
  switch (source) {
    case stage::ValueSource::None:
      return "none";
    case stage::ValueSource::Fallback:
      return "fallback";
    case stage::ValueSource::Default:
      return "default";
    case stage::ValueSource::TimeSamples:
      return "timeSamples";
    case stage::ValueSource::ValueClips:
      return "clips";
    case stage::ValueSource::Spline:
      return "spline";
  }
  return "";
}

void print(const stage::Attribute& attribute, stage::Time time) {
  const layer::Value value = attribute.get(time);
  const std::string text = value.empty() ? std::string() : formats::value_text(value);
  std::printf("%s\t%s\n", source_name(attribute.value_source(time)), text.c_str());
}

Result<stage::Stage> open_stage(const std::string& path, const stage::StageOptions& options) {
  const auto registry = std::make_shared<formats::LayerRegistry>();
  TENON_TRY(const layer::LayerPtr root, registry->open_root(path));
  return stage::Stage::open(
      root, nullptr,
      [registry](const std::string& asset, const layer::Layer& anchor) {
        return registry->open(asset, &anchor);
      },
      options);
}

int fail(const Error& error) {
  std::fprintf(stderr, "%s\n", error.to_string().c_str());
  return 3;
}

bool answer(const stage::Stage& stage, std::span<char*> words) {
  stage::Attribute attribute;
  for (const std::string word : words) {
    if (word.starts_with("/")) {
      const Path path = Path::from(word);
      attribute = stage.prim(path.parent()).attribute(path.name());
    } else if (word == "default") {
      print(attribute, stage::Time());
    } else if (const std::optional<double> time = parse_double(word)) {
      print(attribute, *time);
    } else {
      return false;
    }
  }
  return true;
}

/// The words of one layer after another; the exit status.
int answer_all(std::span<char*> words, const stage::StageOptions& options) {
  std::string path = words[0];
  words = words.subspan(1);
  while (true) {
    const Result<stage::Stage> stage = open_stage(path, options);
    if (!stage) {
      return fail(stage.error());
    }
    const auto next =
        std::find_if(words.begin(), words.end(), [](const char* word) { return *word == '@'; });
    const auto count = static_cast<std::size_t>(next - words.begin());
    if (!answer(*stage, words.first(count))) {
      return 2;
    }
    if (next == words.end()) {
      return 0;
    }
    path = *next + 1;
    words = words.subspan(count + 1);
  }
}

}  // namespace

int main(int count, char** arguments) {
  std::vector<char*> words(arguments + 1, arguments + count);
  stage::StageOptions options;
  if (words.size() > 1 && std::string(words[1]) == "--held") {
    options.interpolation = stage::Interpolation::Held;
    words.erase(words.begin() + 1);
  }
  if (words.size() < 2) {
    std::fprintf(stderr, "usage: value_at LAYER [--held] ATTRIBUTE TIME... [@LAYER ...]...\n");
    return 2;
  }
  return answer_all(words, options);
}
