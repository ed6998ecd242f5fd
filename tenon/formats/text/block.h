// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/formats/text/layer_state.h"

namespace tenon::formats::text {

/// An open `{`, or the layer itself.
struct Block {
  enum class Kind : unsigned char { Layer, Prim, VariantSet, Variant };
  Kind kind = Kind::Layer;
  Path path;
  std::size_t start = 0;          ///< offset of its statement
  std::vector<Token> children{};  ///< prims; of a variant set its variants
  std::vector<Token> properties{};
  std::vector<Token> variant_sets{};  ///< all of them, once one has been opened
};

/// `def Type "Name"`.
struct PrimHead {
  std::string type_name{};
  std::string name{};
  std::size_t name_start = 0;
  std::size_t name_end = 0;
};

/// The block for messages.
std::string block_name(const Block& block);

/// With the cursor at the specifier.
bool read_prim_head(Cursor& cursor, std::string_view specifier_word, PrimHead& head);

/// The name of a variant or variant set, with the cursor at its quotes; errors are about the byte
/// at `start`.
bool read_variant_name(Cursor& cursor, std::size_t start, std::string& name);

/// A set without variants is written `{}`; OpenUSD takes no blanks inside.
bool check_first_variant(Cursor& cursor);

/// The metadata in parentheses between a head and its '{', where there are any. `made`: the spec
/// when it has none yet, else null.
bool read_block_metadata(LayerState& state, Path path, layer::SpecKind kind, layer::Spec* made);

/// Takes the '{' of the block at `path`, whose statement is at `start`.
bool open_brace(Cursor& cursor, Path path, std::size_t start);

/// Puts the names that were gathered in a block into its spec.
void store_children(LayerState& state, Block& block);

}  // namespace tenon::formats::text
