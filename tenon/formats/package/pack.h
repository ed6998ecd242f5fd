// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/bytes/asset_resolver.h"
#include "tenon/bytes/read_policy.h"
#include "tenon/layer/layer.h"

namespace tenon::formats {

/// A file that went into a package.
struct PackedFile {
  std::string name;        ///< in the package
  std::string source;      ///< identifier of where it comes from; empty for a layer made in memory
  std::size_t size = 0;    ///< bytes
  bool rewritten = false;  ///< asset paths in it changed
  bool outside = false;    ///< it lies outside of the root layer's folder, and got a place
};

/// Files that are in no place yet, by the absolute path that layers name them by.
using MadeFiles = std::map<std::string, std::string>;

/// The value of a variable expression of a layer (`"${NAME}.png"`, backquotes included); empty for
/// nothing. Errors: what is wrong with it.
using ReadExpression =
    std::function<Result<std::string>(const std::string& expression, const layer::Layer& layer)>;

/// A package (.usdz) with the layer in front and everything that it needs: all layers that it and
/// they name in sublayers, references, payloads and clips (templates included), and all files that
/// asset values name (`<UDIM>` patterns: every tile that is there). Files below the layer's folder
/// keep their place; others come into numbered folders, and the paths to them are rewritten. Files
/// that need no change go in byte by byte; packages that are named go in whole.
/// Diagnostics: "package.missing" for what cannot be found, which stays as it was named;
/// "package.expression" for a variable expression that names no file, or one whose place in the
/// package it does not lead to: expressions are followed and never rewritten;
/// "package.outside" (info) for files from outside of the layer's folder; "package.file-type" for
/// files of a type that the specification of packages does not name.
/// `files`, where given, receives what went in, in the order of the package. What `made` holds goes
/// in as it is, without a look at the file system.
/// What lies outside of `policy`'s folders, and what is no layer where one is named or else nothing
/// that a scene shows or plays, stays out and stays as it was named, with an error: "read.outside",
/// "read.wrong-kind", "read.unreadable" (docs/reading.md).
/// Errors: those of reading the layers, of write_crate and of bytes::write_zip.
Result<std::string> pack(const bytes::AssetResolver& resolver, const bytes::ReadPolicy& policy,
                         const layer::Layer& root, Diagnostics& diagnostics,
                         std::vector<PackedFile>* files = nullptr, const MadeFiles& made = {},
                         const ReadExpression& read_expression = {});

}  // namespace tenon::formats
