// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tenon/compose/cache/index_cache.h"
#include "tenon/compose/prim_index.h"
#include "tenon/formats/text/reader.h"

/// For tests: prim indices of layers that are given as text.
namespace tenon::compose {

/// Braces on lines of their own, as text layers want them.
inline std::string spread(const std::string& text) {
  std::string result;
  int in_parentheses = 0;
  for (const char c : text) {
    in_parentheses += c == '(' ? 1 : c == ')' ? -1 : 0;
    const bool breaks = in_parentheses == 0 && (c == '{' || c == '}');
    result += !breaks ? std::string(1, c) : c == '{' ? "{\n" : "\n}\n";
  }
  return result;
}

/// Layers given as text, by name; "root" is the root layer, "session" the session layer. Asset
/// paths are names of layers, also with ./ in front.
class TestScene {
 public:
  explicit TestScene(const std::map<std::string, std::string>& texts, ComposeOptions options = {}) {
    for (const auto& [name, text] : texts) {
      Diagnostics diagnostics;
      auto layer = formats::read_text("#usda 1.0\n" + spread(text), name, diagnostics);
      EXPECT_TRUE(layer) << name << ": " << (layer ? "" : layer.error().to_string());
      layers_[name] =
          std::make_shared<const layer::Layer>(layer ? *std::move(layer) : layer::Layer(name));
    }
    const LayerOpener opener = [this](const std::string& path,
                                      const layer::Layer&) -> Result<layer::LayerPtr> {
      const auto found = layers_.find(path.rfind("./", 0) == 0 ? path.substr(2) : path);
      if (found == layers_.end()) {
        return Error(ErrorCode::NotFound, "no " + path);
      }
      return found->second;
    };
    const auto session = layers_.find("session");
    cache_ = std::make_unique<IndexCache>(layers_.at("root"),
                                          session == layers_.end() ? nullptr : session->second,
                                          opener, std::move(options));
  }
  explicit TestScene(const std::string& text) : TestScene({{"root", text}}) {}

  IndexCache& cache() { return *cache_; }
  const PrimIndex& at(const char* path) { return cache_->index(Path::from(path)); }

  // "layer path" of each spec, strongest first.
  std::string specs(const char* path) {
    std::string text;
    for (const Opinion& opinion : at(path).opinions()) {
      text += (text.empty() ? "" : ", ") + opinion.layer->identifier() + opinion.path.str();
    }
    return text;
  }
  std::string errors(const char* path) { return rules(at(path).extras().errors); }
  std::string stack_errors() { return rules(cache_->layer_stack()->errors); }
  std::string children(const char* path) { return words(at(path).child_names.list()); }
  std::string properties(const char* path) { return words(at(path).property_names.list()); }

 private:
  static std::string words(const std::vector<Token>& names) {
    std::string text;
    for (const Token name : names) {
      text += (text.empty() ? "" : " ") + name.str();
    }
    return text;
  }
  static std::string rules(const Diagnostics& diagnostics) {
    std::string text;
    for (const Diagnostic& found : diagnostics) {
      text += (text.empty() ? "" : " ") + found.rule.substr(std::string("compose.").size());
    }
    return text;
  }

  std::map<std::string, layer::LayerPtr> layers_;
  std::unique_ptr<IndexCache> cache_;
};

}  // namespace tenon::compose
