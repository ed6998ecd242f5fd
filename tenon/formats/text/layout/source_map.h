// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "tenon/base/path.h"

/// The places of a layer's statements in its text; the reader fills it when asked to.
namespace tenon::formats::text {

/// Bytes from `begin` up to `end`.
struct SourceRange {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// What a property statement says after the name.
enum class PropertyPart : std::uint8_t {
  Declaration,  ///< nothing, or the default value or explicit targets, and metadata
  Samples,
  Other,  ///< connections, splines, list edits of targets
};

struct PropertyStatement {
  PropertyPart part = PropertyPart::Declaration;
  SourceRange range;
  std::size_t name_end = 0;
  SourceRange value;  ///< empty when there is none; of samples from '{' to after '}'
};

struct SampleEntry {
  double time = 0;
  SourceRange range;  ///< time and value, without the ','
  SourceRange value;
};

/// The parentheses of a layer, prim, variant or property; both are 0 where there are none.
struct MetadataBlock {
  SourceRange range;                    ///< from '(' to after ')'
  std::vector<SourceRange> statements;  ///< without what separates them
};

/// The braces of a prim, variant set or variant.
struct SourceBlock {
  SourceRange range;  ///< from the first word to after '}'
  std::size_t name_begin = 0;
  std::size_t name_end = 0;  ///< after the quoted name
  SourceRange body;          ///< from '{' to after '}'
};

struct SourceMap {
  std::unordered_map<Path, SourceBlock> blocks;
  std::unordered_map<Path, MetadataBlock> metadata;
  std::unordered_map<Path, std::vector<PropertyStatement>> properties;
  std::unordered_map<Path, std::vector<SampleEntry>> samples;
  std::unordered_map<Path, std::vector<SourceRange>> orders;  ///< `reorder` statements
  std::size_t header_end = 0;  ///< of the first line, without its line feed
};

}  // namespace tenon::formats::text
