// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// complexity FAMILY COUNT FOLDER: makes inputs of one family and size and measures the steps of
// reading and writing them; bench/complexity.py asks for many sizes.
//
//   prims       COUNT prims with two attributes each, in groups of 1,000
//   sublayers   COUNT layers with an opinion each about the same ten prims
//   references  a chain of COUNT layers, each with a prim that references the next and an opinion
//               about one attribute
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "bench/layer_builder.h"
#include "bench/open_phases.h"
#include "tenon/formats/crate/writer.h"
#include "tenon/formats/save_layer.h"
#include "tenon/formats/text/reader.h"
#include "tenon/formats/text/write/writer.h"
#include "tenon/open_stage.h"

namespace tenon::bench {
namespace {

namespace fields = layer::fields;

std::string numbered(const char* stem, std::size_t number) { return stem + std::to_string(number); }

void write_file(const std::string& path, const std::string& contents) {
  std::ofstream file(path, std::ios::binary);
  if (!file.write(contents.data(), static_cast<std::streamsize>(contents.size()))) {
    fail("cannot write " + path);
  }
}

std::string to_text(LayerBuilder& builder) { return formats::write_text(builder.finish()); }

layer::Layer make_prims(std::size_t count) {
  constexpr std::size_t kGroup = 1000;
  LayerBuilder builder("prims");
  Path group;
  for (std::size_t i = 0; i < count; ++i) {
    if (i % kGroup == 0) {
      group = builder.prim(Path::absolute_root(), numbered("group_", i / kGroup), "Scope");
    }
    const Path prim = builder.prim(group, numbered("prim_", i), "Sphere");
    const double x = static_cast<double>(i) * 0.001;
    builder.attribute(prim, "radius", "double", x);
    builder.attribute(prim, "xformOp:translate", "double3", Vec3d{{x, 1.5, 0}});
  }
  return builder.finish();
}

void measure_prims(Report& report, std::size_t count, const std::string& folder) {
  const std::string text_file = folder + "/prims.usda";
  const std::string crate_file = folder + "/prims.usdc";
  {
    const layer::Layer made = make_prims(count);
    write_file(text_file, report.time("write_text", [&] { return formats::write_text(made); }));
    const auto crate = report.time("write_crate", [&] { return formats::write_crate(made); });
    write_file(crate_file, crate ? *crate : std::string());
  }
  Diagnostics diagnostics;
  for (const auto& [phase, file] :
       {std::pair<const char*, std::string>{"read_text", text_file}, {"read_crate", crate_file}}) {
    value_or_fail(report.time(phase, [&] { return open_layer(file, diagnostics); }));
  }
  const stage::Stage stage = time_open(report, crate_file);
  report.count("bytes", static_cast<double>(std::filesystem::file_size(text_file)));
}

void measure_sublayers(Report& report, std::size_t count, const std::string& folder) {
  constexpr std::size_t kPrims = 10;
  LayerBuilder root("root");
  std::vector<std::string> paths;
  for (std::size_t i = 0; i < count; ++i) {
    paths.push_back(numbered("./layer_", i) + ".usda");
    LayerBuilder layer("layer");
    for (std::size_t k = 0; k < kPrims; ++k) {
      const Path prim = layer.prim(Path::absolute_root(), numbered("prim_", k), "Sphere");
      layer.attribute(prim, "radius", "double", static_cast<double>(i + 1));
    }
    write_file(folder + "/" + paths.back(), to_text(layer));
  }
  root.spec(Path::absolute_root()).set(fields::subLayers, paths);
  write_file(folder + "/root.usda", to_text(root));
  const stage::Stage stage = time_open(report, folder + "/root.usda");
  time_attributes(report, time_traverse(report, stage));
}

void measure_references(Report& report, std::size_t count, const std::string& folder) {
  for (std::size_t i = 0; i < count; ++i) {
    LayerBuilder layer("layer");
    const Path prim = layer.prim(Path::absolute_root(), "World", "Sphere");
    layer.spec(Path::absolute_root()).set(fields::defaultPrim, Token("World"));
    layer.attribute(prim, "radius", "double", static_cast<double>(i + 1));
    if (i + 1 < count) {
      layer::Reference next;
      next.asset_path = numbered("./link_", i + 1) + ".usda";
      layer.spec(prim).set(fields::references,
                           layer::ListOp<layer::Reference>::make_prepended({next}));
    }
    write_file(folder + "/" + numbered("link_", i) + ".usda", to_text(layer));
  }
  const stage::Stage stage = time_open(report, folder + "/link_0.usda");
  time_attributes(report, time_traverse(report, stage));
}

}  // namespace
}  // namespace tenon::bench

int main(int count, char** values) {
  using namespace tenon::bench;
  const std::string family = count == 4 ? values[1] : "";
  const auto measure = family == "prims"        ? measure_prims
                       : family == "sublayers"  ? measure_sublayers
                       : family == "references" ? measure_references
                                                : nullptr;
  if (measure == nullptr) {
    fail("usage: complexity prims|sublayers|references COUNT FOLDER");
  }
  Report report("complexity_" + family);
  measure(report, std::strtoull(values[2], nullptr, 10), values[3]);
  report.print();
  return 0;
}
