// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/formats/text/block.h"

namespace tenon::formats::text {

/// Which prim directly under the root was closed last, and where the default prim was: used to
/// report a '}' that comes too early.
struct LastClosed {
  std::string name{};
  std::uint32_t line = 0;
  std::uint32_t default_line = 0;  ///< 0 while the default prim is not closed
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
  /// Where reading failed, an offset.
  std::size_t fault() const { return state_.cursor.fault(); }
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

  /// Opens the prims that begin at these offsets, each in the one before it.
  bool enter_prims(const std::vector<std::size_t>& offsets);

  /// `rest` read to the end without a finding, began in the prims that are open here, and adds to
  /// them only what they do not have yet.
  bool continues_here(const LayerReader& rest) const;

  /// One statement of the innermost block; false at the end or after an error.
  bool read_step();

  /// Behind the statement that has the cursor's error; false where nothing safe follows.
  bool go_on_behind_fault();
  bool read_layer_statement();
  bool read_contents_statement();
  bool push(Block block);
  bool open_prim(std::string_view specifier_word);
  bool open_variant_set();
  bool open_variant();
  bool close_block();

  LayerState state_;
  Cursor& cursor_;
  std::vector<Block> blocks_;
  LastClosed last_closed_;
  std::size_t stop_ = std::string_view::npos;  // offset of the statement not to read
  std::size_t statement_ = 0;                  // offset of the one that is read
  bool stopped_ = false;
  std::vector<Path> around_;  // prims that were open where reading began
};

}  // namespace tenon::formats::text
