// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Prints traces of values, and the values that their winning opinions give alone, for the scripts
// under tests/.
//
// usage: trace_values LAYER QUESTION... [@LAYER QUESTION...]...
// A QUESTION is an ATTRIBUTE, an absolute property path, and its TIMEs, each a number or `default`;
// `@` goes on with another layer. One line of JSON per time: {"layer", "attribute", "time",
// "defined", "value", "traced", "alone", "source", "opinions": [{"file", "path", "what", "role",
// "set", "clip"}]}. "alone" is the value on the same stage without any other opinion about the
// attribute: those that do not count are taken out of the layers, and all others that the trace may
// not know. Exit: 0 printed; 2 wrong usage; 3 a layer could not be opened.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tenon/base/text/text_number.h"
#include "tenon/formats/open_layer.h"
#include "tenon/formats/text/write/value_text.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"
#include "tenon/stage/stage.h"
#include "tenon/stage/values/value_trace.h"

namespace {

using namespace tenon;
using Json = nlohmann::ordered_json;
using formats::LayerRegistry;
using stage::OpinionRole;
using stage::TracedOpinion;
using stage::ValueSource;

constexpr const char* kRoles[] = {"wins", "combined", "loses", "declares"};
constexpr const char* kWhat[] = {"declaration", "fallback",   "default",
                                 "timeSamples", "valueClips", "spline"};

/// A stage and where its layers come from.
struct Scene {
  std::string path;
  std::shared_ptr<LayerRegistry> registry;
  stage::Stage stage;
};

Result<Scene> open_scene(const std::string& path, std::shared_ptr<LayerRegistry> registry) {
  TENON_TRY(const layer::LayerPtr root, registry->open_root(path));
  stage::StageOptions options;
  options.resolve_asset = [registry](const std::string& asset, const layer::Layer& anchor) {
    return registry->resolver().resolve(asset, anchor.identifier()).value_or(std::string());
  };
  const auto opener = [registry](const std::string& asset, const layer::Layer& anchor) {
    return registry->open(asset, &anchor);
  };
  TENON_TRY(stage::Stage stage, stage::Stage::open(root, nullptr, opener, std::move(options)));
  return Scene{path, registry, std::move(stage)};
}

bool counts(const TracedOpinion& opinion) {
  return opinion.role == OpinionRole::Wins || opinion.role == OpinionRole::Combined;
}

/// Leaves of the values that a layer gives an attribute those of the opinions that count.
void keep_what_counts(const stage::ValueTrace& trace, Token attribute, layer::Layer& layer) {
  std::vector<Path> paths;
  for (const layer::Layer::Entry& entry : layer.entries()) {
    paths.push_back(entry.path);
  }
  for (const Path path : paths) {
    const auto kept = [&](ValueSource kind) {
      return std::any_of(trace.opinions.begin(), trace.opinions.end(), [&](const auto& opinion) {
        return counts(opinion) && opinion.kind == kind && opinion.source.path == path &&
               opinion.source.layer->identifier() == layer.identifier();
      });
    };
    layer::Spec& spec = *layer.find(path);
    if (path.is_property() && path.name() == attribute) {
      for (const auto& [kind, field] :
           {std::pair(ValueSource::Default, layer::fields::default_value),
            std::pair(ValueSource::TimeSamples, layer::fields::timeSamples),
            std::pair(ValueSource::Spline, layer::fields::spline)}) {
        if (!kept(kind)) {
          spec.erase(field);
        }
      }
    } else if (!path.is_property() && !kept(ValueSource::ValueClips)) {
      const bool same_site =
          std::any_of(trace.opinions.begin(), trace.opinions.end(), [&](const auto& opinion) {
            return counts(opinion) && opinion.clip && opinion.source.path == path;
          });
      if (!same_site) {
        spec.erase(layer::fields::clips);
      }
    }
  }
}

/// The layers that clips and manifests are read from, which stay as they are.
bool is_of_clips(const std::string& identifier) {
  const std::string name = identifier.substr(identifier.rfind('/') + 1);
  return name.starts_with("clip") || name.starts_with("t.") || name.starts_with("manifest");
}

Result<layer::Value> value_alone(const Scene& scene, Path attribute,
                                 const stage::ValueTrace& trace) {
  auto registry = std::make_shared<LayerRegistry>();
  for (const std::string& identifier : scene.registry->opened()) {
    TENON_TRY(const layer::LayerPtr layer, scene.registry->open(identifier, nullptr));
    auto edited = std::make_shared<layer::Layer>(*layer);
    if (!is_of_clips(identifier)) {
      keep_what_counts(trace, attribute.name(), *edited);
    }
    registry->insert(edited);
  }
  TENON_TRY(const Scene alone, open_scene(scene.path, registry));
  return alone.stage.prim(attribute.parent()).attribute(attribute.name()).get(trace.time);
}

Json text_of(const layer::Value& value) {
  return value.empty() ? Json(nullptr) : Json(formats::value_text(value));
}

Json row_of(const TracedOpinion& opinion) {
  const layer::Layer* layer = opinion.source.layer;
  Json row = {{"file", layer == nullptr ? Json(nullptr) : Json(layer->identifier())},
              {"path", layer == nullptr ? Json(nullptr) : Json(opinion.source.path.str())},
              {"what", kWhat[static_cast<std::size_t>(opinion.kind)]},
              {"role", kRoles[static_cast<std::size_t>(opinion.role)]}};
  if (opinion.clip) {
    row["set"] = opinion.clip->set;
    row["clip"] = opinion.clip->layer.empty() ? Json(nullptr) : Json(opinion.clip->layer);
  }
  return row;
}

bool answer(const Scene& scene, Path attribute, const std::string& word) {
  const std::optional<double> time = parse_double(word);
  if (!time && word != "default") {
    return false;
  }
  const stage::Attribute asked = scene.stage.prim(attribute.parent()).attribute(attribute.name());
  const stage::ValueTrace trace = asked.trace(time ? stage::Time(*time) : stage::Time());
  const Result<layer::Value> alone = value_alone(scene, attribute, trace);
  Json line = {{"layer", scene.path},
               {"attribute", attribute.str()},
               {"time", time ? Json(*time) : Json(nullptr)},
               {"defined", asked.is_defined()},
               {"value", text_of(asked.get(trace.time))},
               {"traced", text_of(trace.value)},
               {"alone", alone ? text_of(*alone) : Json(alone.error().to_string())},
               {"source", kWhat[static_cast<std::size_t>(asked.value_source(trace.time))]},
               {"opinions", Json::array()}};
  for (const TracedOpinion& opinion : trace.opinions) {
    line["opinions"].push_back(row_of(opinion));
  }
  std::printf("%s\n", line.dump().c_str());
  return true;
}

int run(std::span<char*> words) {
  std::optional<Scene> scene;
  Path attribute;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string word = words[i];
    if (i == 0 || word.starts_with("@")) {
      auto opened = open_scene(word.substr(i == 0 ? 0 : 1), std::make_shared<LayerRegistry>());
      if (!opened) {
        std::fprintf(stderr, "%s\n", opened.error().to_string().c_str());
        return 3;
      }
      scene.emplace(*std::move(opened));
    } else if (word.starts_with("/")) {
      attribute = Path::from(word);
    } else if (!answer(*scene, attribute, word)) {
      return 2;
    }
  }
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 2) {
    std::fprintf(stderr, "usage: trace_values LAYER ATTRIBUTE TIME... [@LAYER ...]...\n");
    return 2;
  }
  return run({arguments + 1, arguments + count});
}
