// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0

// Input: several text layers (layers_of_input.h). They compose to a stage that can be read in whole
// and flattened to a layer that reads again. What is built ahead, and shared between siblings that
// are alike, is what is built when asked for, each by itself.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/layers_of_input.h"
#include "fuzz/read_whole_stage.h"
#include "tenon/compose/dump_index.h"
#include "tenon/compose/prim_index.h"
#include "tenon/formats/save_layer.h"
#include "tenon/formats/text/reader.h"
#include "tenon/stage/flatten/flatten.h"

namespace {

using tenon::Path;
using tenon::compose::IndexCache;
using tenon::compose::PrimIndex;

constexpr std::size_t kMaxPrims = 300;

/// The first prims in depth-first order. `ahead`: what is below those to come is built on two
/// threads before every so many.
std::string account_of(IndexCache& cache, bool ahead) {
  const auto name_of = [](const tenon::layer::Layer& layer) { return layer.identifier(); };
  std::string text;
  std::vector<const PrimIndex*> pending{&cache.index(Path::absolute_root())};
  for (std::size_t count = 0; !pending.empty() && count < kMaxPrims; ++count) {
    if (ahead && (count & (count - 1)) == 0) {
      cache.build_below(pending, [](const PrimIndex&) { return true; }, kMaxPrims);
    }
    const PrimIndex& index = *pending.back();
    pending.pop_back();
    text += index.path.str() + "\n" + dump_nodes(index, name_of);
    for (const tenon::Diagnostic& error : index.extras().errors) {
      text += error.to_string() + "\n";
    }
    for (const tenon::Token name : index.child_names) {
      pending.push_back(&cache.child_index(index, name));
    }
  }
  for (const tenon::compose::MissingArc& arc : cache.missing_arcs()) {
    text += arc.layer + arc.prim.str() + arc.path + "\n";
  }
  return text;
}

void check_ahead(const tenon::fuzz::LayersOfInput& layers) {
  tenon::compose::ComposeOptions options;
  options.max_nodes = tenon::fuzz::LayersOfInput::kMaxNodes;
  IndexCache built_ahead(layers.root(), nullptr, layers.opener(), options);
  options.shares_twins = false;
  IndexCache plain(layers.root(), nullptr, layers.opener(), options);
  const std::string expected = account_of(plain, false);
  const std::string found = account_of(built_ahead, true);
  if (found != expected) {
    std::fprintf(stderr, "%s\n--- ahead\n%s\n", expected.c_str(), found.c_str());
    std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const tenon::fuzz::LayersOfInput layers(
      std::string_view(reinterpret_cast<const char*>(data), size));
  if (layers.root() == nullptr) {
    return 0;
  }
  check_ahead(layers);
  const auto stage = layers.open_stage();
  if (!stage) {
    return 0;
  }
  tenon::fuzz::read_whole_stage(*stage, 500);
  // What has no text is refused; all other text reads back.
  const auto text = tenon::formats::encode_layer(tenon::stage::flatten(*stage),
                                                 tenon::formats::LayerFormat::Text);
  tenon::Diagnostics diagnostics;
  if (text) {
    const auto again = tenon::formats::read_text(*text, "flat.usda", diagnostics);
    if (!again) {
      std::fprintf(stderr, "%s\n%s\n", text->c_str(), again.error().to_string().c_str());
      std::abort();
    }
  }
  return 0;
}
