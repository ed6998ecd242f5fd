// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
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

/// Reads the blocks of a layer: prims, variant sets and variants. They are kept on a stack of our
/// own, so that deep nesting costs no call stack.
class LayerReader {
 public:
  LayerReader(std::string_view text, std::string identifier, Diagnostics& diagnostics,
              SourceMap* sources);

  /// All statements, or those before the one at `stop`; false after an error.
  bool read_from_front(std::size_t stop = std::string_view::npos);

  /// Goes on behind faults where that is safe. The layer is refused all the same: with the first
  /// of them, which has the others with it.
  void find_all_faults() { state_.finds_all_faults = true; }
  bool has_faults() const { return !state_.faults.empty(); }

  /// The first part ended where it was to stop, between two statements.
  bool stopped() const { return stopped_; }

  /// The statements from `offset` on, as far as they are wanted, as if those before had been read.
  void read_from(std::size_t offset, const std::atomic<bool>& wanted);

  /// Takes over what `rest` read from here on. False, with nothing changed, when that may not be
  /// what this reader would have found.
  bool take_rest(LayerReader& rest);

  /// The statements that are left; false after an error.
  bool read_statements();
  Result<layer::Layer> finish();

 private:
  Block& top() { return blocks_.back(); }

  // In two parts

  /// Opens the prims that begin at these offsets, each in the one before it.
  bool enter_prims(const std::vector<std::size_t>& offsets);

  /// `rest` read to the end without a finding, began in the prims that are open here, and adds to
  /// them only what they do not have yet.
  bool continues_here(const LayerReader& rest) const;

  /// What was read about `path` later is nothing but names of children and properties, new ones.
  bool only_adds(const LayerReader& rest, Path path) const;
  bool are_new(Path parent, const std::vector<Token>& children,
               const std::vector<Token>& properties) const;

  // Where sources are wanted

  bool note_header();
  void note_open(Path path, SourceBlock block);
  void note_close(Path path);
  bool read_layer_metadata();

  /// One statement of the innermost block; false at the end or after an error.
  bool read_step();

  /// Behind the statement that has the cursor's error; false where nothing safe follows.
  bool go_on_behind_fault();
  bool read_layer_statement();

  /// Something that is no prim between the prims of the layer: often a '}' stands too early.
  bool fail_layer_statement();

  /// Where the default prim was closed, when another prim was closed after it.
  std::string default_prim_note() const;
  bool read_contents_statement();
  bool fail_contents_statement();
  bool read_order(Token field, std::size_t start);
  bool end_statement(std::string_view where);
  bool push(Block block);

  struct PrimHead {
    std::string type_name{};
    std::string name{};
    std::size_t name_start = 0;
    std::size_t name_end = 0;
  };

  /// `def Type "Name"`, with the cursor at the specifier.
  bool read_prim_head(std::string_view specifier_word, PrimHead& head);
  bool open_prim(std::string_view specifier_word);

  /// `Name` or `Name.Name`, with the blank behind it.
  bool read_prim_type(std::string& type_name);
  bool check_prim_name(std::string_view name, std::size_t offset);
  bool read_block_metadata(Path path, layer::SpecKind kind);
  bool open_brace(Path path, std::size_t start);
  bool open_variant_set();

  /// A set without variants is written `{}`; OpenUSD takes no blanks inside.
  bool check_first_variant();
  bool check_variant_name(std::string_view name, std::size_t offset);
  bool open_variant();
  void store_children(Block& block);
  bool close_block();

  LayerState state_;
  Cursor& cursor_;
  std::vector<Block> blocks_;
  std::string last_closed_;  // the last prim directly under the root
  std::uint32_t last_closed_line_ = 0;
  std::uint32_t default_closed_line_ = 0;      // 0 while the default prim is not closed
  std::size_t stop_ = std::string_view::npos;  // offset of the statement not to read
  std::size_t statement_ = 0;                  // offset of the one that is read
  bool stopped_ = false;
  std::vector<Path> around_;  // prims that were open where reading began
};

}  // namespace tenon::formats::text
