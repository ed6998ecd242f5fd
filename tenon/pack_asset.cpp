// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/pack_asset.h"

#include <utility>

#include "tenon/asset_policy.h"
#include "tenon/compose/expressions/variable_expression.h"
#include "tenon/layer/fields.h"
#include "tenon/stage_sources.h"

namespace tenon {
namespace {

/// Expressions with the variables of the asset's root layer, over those of the layer that holds
/// them, which count where the layer is referenced.
formats::ReadExpression expressions_of(const layer::Layer& root) {
  return [&root](const std::string& expression, const layer::Layer& layer) -> Result<std::string> {
    const auto variables_of = [](const layer::Layer& from) {
      const auto* variables =
          from.root().get<layer::Dictionary>(layer::fields::expressionVariables);
      return variables == nullptr ? layer::Dictionary() : *variables;
    };
    const compose::ExpressionResult result =
        compose::evaluate_text(expression, merge(variables_of(root), variables_of(layer)));
    if (!result.errors.empty()) {
      return Error(ErrorCode::Invalid, result.errors);
    }
    return result.text;
  };
}

}  // namespace

Result<PackedAsset> pack_asset(const std::string& path, const OpenOptions& options,
                               Diagnostics& diagnostics) {
  TENON_TRY(const layer::LayerPtr root, open_layer(path, options, diagnostics));
  bytes::ResolverOptions resolver = resolver_options(options);
  const std::string& file = root->identifier();
  resolver.search_paths.insert(resolver.search_paths.begin(), file.substr(0, file.rfind('/') + 1));
  PackedAsset packed;
  TENON_TRY(packed.package,
            formats::pack(bytes::AssetResolver(std::move(resolver)), policy_for(path, options),
                          *root, diagnostics, &packed.files, {}, expressions_of(*root)));
  return packed;
}

Result<std::string> pack_layer(layer::Layer layer, const std::string& path,
                               const OpenOptions& options, const formats::MadeFiles& made,
                               Diagnostics& diagnostics) {
  const std::string file = bytes::absolute_file_path(bytes::split_package_path(path).package);
  const std::string folder = file.substr(0, file.rfind('/') + 1);
  if (!layer.identifier().starts_with('/')) {
    layer.set_identifier(folder + "composed");  // no file: its paths are relative to the folder
  }
  bytes::ResolverOptions resolver = resolver_options(options);
  resolver.search_paths.insert(resolver.search_paths.begin(), folder);
  return formats::pack(bytes::AssetResolver(std::move(resolver)), policy_for(path, options), layer,
                       diagnostics, nullptr, made, expressions_of(layer));
}

}  // namespace tenon
