// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/bytes/asset_resolver.h"
#include "tenon/layer/layer.h"

namespace tenon::formats {

/// A package (.usdz) with the layer in front and everything that it needs: all layers that it and
/// they name in sublayers, references, payloads and clips (templates included), and all files that
/// asset values name (`<UDIM>` patterns: every tile that is there). Files below the layer's folder
/// keep their place; others come into numbered folders, and the paths to them are rewritten. Files
/// that need no change go in byte by byte; packages that are named go in whole.
/// Diagnostics: "package.missing" for what cannot be found, which stays as it was named.
/// Errors: those of reading the layers, of write_crate and of bytes::write_zip.
Result<std::string> pack(const bytes::AssetResolver& resolver, const layer::Layer& root,
                         Diagnostics& diagnostics);

}  // namespace tenon::formats
