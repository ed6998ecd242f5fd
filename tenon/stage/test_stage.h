// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "tenon/formats/text/reader.h"
#include "tenon/stage/stage.h"

/// For tests: stages of layers that are given as text.
namespace tenon::stage {

/// Texts of layers by name, without their first line; "root" is the root layer. They may be written
/// on few lines: braces get lines of their own, and in a text of one line `;` ends one.
using Texts = std::map<std::string, std::string>;

inline std::string on_lines(const std::string& text) {
  std::string result = "#usda 1.0\n";
  const bool is_one_line = text.find('\n') == std::string::npos;
  char quote = 0;  // the one that ends the string that is being read
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quote != 0 || c == '"' || c == '\'') {
      quote = quote == 0 ? c : c == quote ? '\0' : quote;
      result += c;
      continue;
    }
    if (c == '}' && result[result.find_last_not_of(' ')] != '\n') {
      result += '\n';
    }
    result += c == ';' && is_one_line ? '\n' : c;
    if ((c == '{' || c == '}') && text.substr(i + 1, 1) != "\n") {
      result += '\n';
    }
  }
  return result + "\n";
}

/// Assets are looked for among the layers.
inline Stage open_text(const Texts& texts, StageOptions options = {}) {
  std::map<std::string, layer::LayerPtr> layers;
  for (const auto& [name, text] : texts) {
    Diagnostics diagnostics;
    auto layer = formats::read_text(on_lines(text), name, diagnostics);
    EXPECT_TRUE(layer) << (layer ? name : layer.error().to_string());
    layers[name] =
        std::make_shared<const layer::Layer>(layer ? *std::move(layer) : layer::Layer(name));
  }
  const auto open = [layers](const std::string& path, const layer::Layer&) {
    const auto it = layers.find(path);
    return it != layers.end() ? Result<layer::LayerPtr>(it->second)
                              : Error(ErrorCode::NotFound, "no " + path);
  };
  options.resolve_asset = [layers](const std::string& path, const layer::Layer&) {
    return layers.contains(path) ? path : std::string();
  };
  auto stage = Stage::open(layers.at("root"), nullptr, open, std::move(options));
  EXPECT_TRUE(stage);
  return *std::move(stage);
}

/// Of one layer.
inline Stage open_text(const std::string& text, StageOptions options = {}) {
  return open_text(Texts{{"root", text}}, std::move(options));
}

inline Prim at(const Stage& stage, const char* path) { return stage.prim(Path::from(path)); }

}  // namespace tenon::stage
