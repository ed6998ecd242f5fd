// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Takes layers through the other formats and back, for tests/conformance/run_round_trip.py.
//
// usage: tenon_round_trip DIRECTORY FILE...
// The N-th file that opens is written to DIRECTORY/N.usda and DIRECTORY/N.usdc. A line per file on
// standard output: "rejected", "equal", or what differs. Exit 0, also where something differs.
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>

#include <nlohmann/json.hpp>

#include "tenon/answers/dump/layer_json.h"
#include "tenon/bytes/file_bytes.h"
#include "tenon/formats/crate/writer.h"
#include "tenon/formats/open_layer.h"
#include "tenon/formats/text/write/writer.h"
#include "tenon/layer/type_names.h"

namespace {

using tenon::Result;
using tenon::layer::Layer;

Result<Layer> read(const std::string& bytes, const Layer& original) {
  tenon::Diagnostics ignored;
  return tenon::formats::read_layer(tenon::bytes::FileBytes::own(bytes), original.identifier(),
                                    ignored);
}

std::string json(const Layer& layer) {
  std::ostringstream out;
  tenon::answers::write_layer_json(out, layer);
  return out.str();
}

/// Without what text layers do not keep, as OpenUSD's do not: the order of properties and variants,
/// that a list of children is there but empty, old names of types, the name of no type.
void forget_what_text_does_not_keep(nlohmann::json& spec) {
  for (const char* list : {"propertyChildren", "variantChildren"}) {
    if (spec.contains(list)) {
      std::sort(spec[list].begin(), spec[list].end());
    }
  }
  if (spec.contains("primChildren") && spec["primChildren"].empty()) {
    spec.erase("primChildren");
  }
  if (spec.contains("typeName") && spec["typeName"] == "__AnyType__") {
    spec.erase("typeName");
  }
  if (spec.contains("typeName") && spec["typeName"].is_string()) {
    const tenon::Token name(spec["typeName"].get<std::string>());
    const tenon::layer::TypeName* type = tenon::layer::find_type_name(name);
    spec["typeName"] = type == nullptr ? name.str() : type->name.str();
  }
}

/// Numbers are compared as numbers: text gives a field the type of its schema, 1 becomes 1.0.
bool same_in_text(const std::string& a, const std::string& b) {
  using Json = nlohmann::json;
  Json both[] = {Json::parse(a, nullptr, false), Json::parse(b, nullptr, false)};
  if (both[0].is_discarded() || both[1].is_discarded()) {
    return a == b;  // text that is not UTF-8
  }
  for (Json& specs : both) {
    for (Json& spec : specs) {
      forget_what_text_does_not_keep(spec);
    }
  }
  return both[0] == both[1];
}

/// What differs between `layer` and the layer that `bytes` hold; empty when nothing does.
std::string difference(const Layer& layer, const std::string& bytes, const std::string& text,
                       const std::string& way) {
  const Result<Layer> again = read(bytes, layer);
  if (!again) {
    return way + " is not read again: " + again.error().message();
  }
  const std::string before = json(layer);
  const std::string after = json(*again);
  if (way == "binary" ? before != after : !same_in_text(before, after)) {
    return way + ": other fields";
  }
  return tenon::formats::write_text(*again) == text ? "" : way + ": other text";
}

std::string round_trip(const Layer& layer, const std::string& path) {
  const std::string text = tenon::formats::write_text(layer);
  const Result<std::string> crate = tenon::formats::write_crate(layer);
  if (!crate) {
    return "no binary layer: " + crate.error().message();
  }
  std::ofstream(path + ".usda", std::ios::binary) << text;
  std::ofstream(path + ".usdc", std::ios::binary) << *crate;
  std::string found = difference(layer, text, text, "text");
  found = found.empty() ? difference(layer, *crate, text, "binary") : found;
  const Result<Layer> from_text = read(text, layer);
  if (found.empty() && from_text) {
    const Result<std::string> both = tenon::formats::write_crate(*from_text);
    found = both ? difference(layer, *both, text, "text, then binary") : both.error().message();
  }
  return found;
}

}  // namespace

int main(int count, char** words) {
  if (count < 3) {
    std::fputs("usage: tenon_round_trip DIRECTORY FILE...\n", stderr);
    return 2;
  }
  for (int i = 2; i < count; ++i) {
    tenon::Diagnostics ignored;
    const Result<Layer> layer = tenon::formats::open_layer_file(words[i], ignored);
    const std::string path = std::string(words[1]) + "/" + std::to_string(i - 2);
    const std::string found = layer ? round_trip(*layer, path) : "rejected";
    std::printf("%s\n", found.empty() ? "equal" : found.c_str());
    std::fflush(stdout);
  }
  return 0;
}
