// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Prints where an attribute's value comes from and what it is, for the scripts under tests/.
//
// usage: value_at LAYER [--held] ATTRIBUTE TIME... [ATTRIBUTE TIME...]...
// An ATTRIBUTE is an absolute property path, a TIME a number or `default`. One line per time:
// source, a tab, and the value as text layers print it (nothing where there is none).
// Exit: 0 printed; 2 wrong usage; 3 the layer could not be opened.
#include <cstdio>
#include <string>

#include "tenon/base/text_number.h"
#include "tenon/formats/open_layer.h"
#include "tenon/formats/text/value_text.h"
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

bool answer(const stage::Stage& stage, int count, char** words) {
  stage::Attribute attribute;
  for (int i = 0; i < count; ++i) {
    const std::string word = words[i];
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

int fail(const Error& error) {
  std::fprintf(stderr, "%s\n", error.to_string().c_str());
  return 3;
}

}  // namespace

int main(int count, char** words) {
  stage::StageOptions options;
  int first = 2;
  if (count > 2 && std::string(words[2]) == "--held") {
    options.interpolation = stage::Interpolation::Held;
    first = 3;
  }
  if (count < first + 1) {
    std::fprintf(stderr, "usage: value_at LAYER [--held] ATTRIBUTE TIME...\n");
    return 2;
  }
  formats::LayerRegistry registry;
  const Result<layer::LayerPtr> root = registry.open_root(words[1]);
  if (!root) {
    return fail(root.error());
  }
  const auto stage = stage::Stage::open(
      *root, nullptr,
      [&](const std::string& path, const layer::Layer& anchor) {
        return registry.open(path, &anchor);
      },
      options);
  if (!stage) {
    return fail(stage.error());
  }
  return answer(*stage, count - first, words + first) ? 0 : 2;
}
