// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage_sources.h"

#include "tenon/base/assignment.h"
#include "tenon/session_opinions.h"

namespace tenon {

compose::LayerOpener StageSources::opener() const {
  return [registry = registry](const std::string& asset, const layer::Layer& anchor) {
    return registry->open(asset, &anchor);
  };
}

bytes::ResolverOptions resolver_options(const OpenOptions& options) {
  bytes::ResolverOptions result{options.search_paths, options.sandbox_roots, options.files};
  if (!result.roots.empty()) {
    result.roots.insert(result.roots.end(), options.allowed_reads.begin(),
                        options.allowed_reads.end());
  }
  return result;
}

Result<Path> parse_prim_path(const std::string& text, const std::string& what) {
  TENON_TRY(const Path path, Path::parse(text));
  if (!path.is_absolute() || !path.is_prim_or_root()) {
    return Error(ErrorCode::Invalid, what + " `" + text + "` is not the path of a prim")
        .with_fix("write it from the root, as in /World/Robot");
  }
  return path;
}

Result<compose::ComposeOptions> compose_options(const OpenOptions& options,
                                                const layer::Layer& root) {
  compose::ComposeOptions result;
  result.load_payloads = options.load_payloads && options.load.empty();
  result.variant_fallbacks = options.variant_fallbacks;
  result.set_max_work(options.max_work);
  for (const std::string& text : options.load) {
    TENON_TRY(const Path path, parse_prim_path(text, "the path to load"));
    result.loaded.insert(path);
  }
  const std::string& file = root.identifier();
  const std::string folder = file.substr(0, file.rfind('/') + 1);
  for (const std::string& name : options.muted) {
    result.muted.insert({name, bytes::absolute_file_path(name)});
    if (!name.starts_with('/')) {
      result.muted.insert(bytes::absolute_file_path(folder + name));
    }
  }
  return result;
}

Result<StageSources> open_sources(const std::string& path, const OpenOptions& options) {
  StageSources sources;
  sources.registry =
      std::make_shared<formats::LayerRegistry>(bytes::AssetResolver(resolver_options(options)));
  TENON_TRY(sources.root, sources.registry->open_root(path));
  if (!options.session_path.empty()) {
    TENON_TRY(sources.session, sources.registry->open(options.session_path, nullptr));
  }
  const bool has_default_prim = !sources.root->default_prim().empty();
  if (!options.physics_variant.empty() && (has_default_prim || !options.physics_below)) {
    TENON_TRY(sources.session,
              with_variant(sources.session, *sources.root, "Physics", options.physics_variant));
  }
  for (const std::string& text : options.physics_of) {
    TENON_TRY(const auto wanted, split_assignment(text));
    TENON_TRY(const Path prim, parse_prim_path(wanted.first, "the prim of the variant"));
    sources.session = with_variant(sources.session, prim, "Physics", wanted.second);
  }
  for (const OpenOptions::Selection& wanted : options.selections) {
    TENON_TRY(const Path prim, parse_prim_path(wanted.prim, "the prim of the variant"));
    sources.session = with_variant(sources.session, prim, wanted.set, wanted.variant);
  }
  return sources;
}

}  // namespace tenon
