// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tenon/base/containers/stable_list.h"
#include "tenon/base/path.h"
#include "tenon/base/paths/path_numbers.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"
#include "tenon/layer/spec.h"

namespace tenon::layer {

/// One layer as a value: specs by path. Knows no files and no other layer.
/// Children are named by fields of their parent, in order: primChildren, properties,
/// variantSetChildren (std::vector<Token>), variantChildren.
class Layer {
 public:
  struct Entry {
    Path path;
    Spec spec;
  };

  /// An empty layer with its pseudo-root.
  explicit Layer(std::string identifier);
  Layer(const Layer& other);
  Layer(Layer&& other) noexcept;
  Layer& operator=(const Layer& other);
  Layer& operator=(Layer&& other) noexcept;
  ~Layer();

  /// What arcs resolve to: an absolute file path, `package.usdz[inner.usda]`, or a made-up name of
  /// a layer that is in no file.
  const std::string& identifier() const { return identifier_; }
  void set_identifier(std::string identifier) { identifier_ = std::move(identifier); }

  /// True where something comes from a binary form or from a foreign format. Those can hold what
  /// the text form does not support: fields and types with invalid names, values of another type
  /// than declared, bytes that are not UTF-8. Its text is read back before it is returned.
  bool may_lack_text() const { return may_lack_text_; }
  void set_may_lack_text() { may_lack_text_ = true; }

  const Spec* find(Path path) const;
  Spec* find(Path path);
  bool has(Path path) const { return find(path) != nullptr; }
  /// The property `name` of a prim or variant, whose own spec is `owner` and which lists it; null
  /// if there is none.
  const Entry* find_property(const Spec& owner, Path path, Token name) const;
  /// The number of the spec at the path of a prim, a variant or the root, from 1 on; 0 where there
  /// is none. It stays while nothing is erased.
  std::uint32_t number_of(Path path) const { return tabled(path); }
  const Spec& numbered_spec(std::uint32_t number) const { return entries_[number - 1].spec; }
  Spec& numbered_spec(std::uint32_t number) { return entries_[number - 1].spec; }
  /// The property at `path` when its spec is in the place that it most often has: the one that the
  /// list of its owner, numbered `owner`, gives it, behind the owner. Null says nothing.
  const Entry* guess_property(std::uint32_t owner, std::size_t listed_at, Path path) const {
    const std::size_t at = owner + listed_at;
    return at < entries_.size() && entries_[at].path == path ? &entries_[at] : nullptr;
  }
  /// Names in a list of so many are searched one by one.
  static constexpr std::size_t kShortList = 32;
  const Spec& root() const { return *find(Path::absolute_root()); }
  Spec& root() { return *find(Path::absolute_root()); }

  /// The spec at `path`, made if absent; parents and children lists are not touched.
  Spec& create(Path path, SpecKind kind);
  /// The same where there must be none yet; null, and nothing done, where there is one.
  Spec* create_new(Path path, SpecKind kind);
  /// Removes the spec at `path` alone.
  void erase(Path path);
  void reserve(std::size_t spec_count);
  /// Moves the specs of `other` at paths where this layer has none behind its own, in their order.
  void take_missing(Layer&& other);

  /// All specs in the order in which they were made.
  const StableList<Entry>& entries() const { return entries_; }
  std::size_t spec_count() const { return entries_.size() - erased_; }

  /// Names listed in a children field ("primChildren", "properties", ...) of `path`; empty if none.
  const std::vector<Token>& children(Path path, Token field) const;
  static const std::vector<Token>& children(const Spec& spec, Token field);

  Token default_prim() const;
  const std::vector<std::string>& sublayers() const;
  /// Offset of sublayer `i`; identity when none is authored.
  LayerOffset sublayer_offset(std::size_t i) const;
  /// timeCodesPerSecond, else framesPerSecond, else 24.
  double time_codes_per_second() const;

 private:
  const Entry* entry_at(Path path) const;
  const Entry* property_at(Path path, std::uint32_t owner) const;
  const Entry* in_run(Path property, std::size_t first) const;
  const Entry* numbered(std::uint32_t entry) const;
  auto path_of() const {
    return [this](std::uint32_t number) { return entries_[number - 1].path; };
  }
  /// The number of the entry of a path that is in the table; 0 where there is none.
  std::uint32_t tabled(Path path) const { return table_.find(path, path_of()); }
  Entry& add(Path path, bool& made);
  void enter(Path path, std::size_t entry);
  void end_run(Path owner);

  std::string identifier_;
  StableList<Entry> entries_;  // erased entries keep an empty path
  PathNumbers table_;          // of entries that are in no run
  std::size_t erased_ = 0;
  Path run_owner_;               // whose properties, made next, are its run
  std::uint32_t run_entry_ = 0;  // its entry, from 1 on
  std::uint64_t run_marks_ = 0;  // a bit for each name in the run, which names share
  bool has_strays_ = false;      // properties in the table
  bool may_lack_text_ = false;
};

using LayerPtr = std::shared_ptr<const Layer>;

}  // namespace tenon::layer
