// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Specs lie in the order in which they were made; a table of slots, open to the next free one, says
// where that of a path is. A path is known by its number, so slots need no look at paths that are
// not the one. Erased specs keep their place with an empty path, for places are never given twice.
#include "tenon/layer/layer.h"

#include <algorithm>

namespace tenon::layer {
namespace {

/// Where to look for a path first. Eight neighbouring numbers share a line of the cache; such
/// eights are scattered, so that long runs of numbers do not pile up.
std::size_t home_of(std::uint32_t number, std::size_t slot_count) {
  const std::uint64_t scattered = (std::uint64_t{number >> 3u} * 0x9E3779B97F4A7C15ull) >> 32u;
  return static_cast<std::size_t>(scattered << 3u | (number & 7u)) & (slot_count - 1);
}

}  // namespace

Layer::Layer(std::string identifier) : identifier_(std::move(identifier)) {
  create(Path::absolute_root(), SpecKind::PseudoRoot);
}

Layer::Layer(const Layer& other) = default;
Layer::Layer(Layer&& other) noexcept = default;
Layer& Layer::operator=(const Layer& other) = default;
Layer& Layer::operator=(Layer&& other) noexcept = default;
Layer::~Layer() = default;

/// Where `path` is in the table, or the empty slot where it would be.
std::size_t Layer::slot_of(Path path) const {
  const std::uint32_t number = path.number();
  std::size_t at = home_of(number, slots_.size());
  while (slots_[at].entry != 0) {
    if (slots_[at].path == number && entries_[slots_[at].entry - 1].path == path) {
      return at;
    }
    at = (at + 1) & (slots_.size() - 1);
  }
  return at;
}

/// As slot_of, with one look at the entry; null where there is none.
const Layer::Entry* Layer::entry_at(Path path) const {
  const std::uint32_t number = path.number();
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t at = home_of(number, slots_.size()); slots_[at].entry != 0;
       at = (at + 1) & mask) {
    if (slots_[at].path == number) {
      const Entry& entry = entries_[slots_[at].entry - 1];
      if (entry.path == path) {
        return &entry;
      }
    }
  }
  return nullptr;
}

const Spec* Layer::find(Path path) const {
  const Entry* entry = entry_at(path);
  return entry == nullptr ? nullptr : &entry->spec;
}

Spec* Layer::find(Path path) { return const_cast<Spec*>(std::as_const(*this).find(path)); }

/// Readers make properties right behind their prim: from text in the order of its list, from
/// binary layers sorted. Found there, a property needs no path to be made, and only the slot of its
/// prim, which was looked at before.
const Layer::Entry* Layer::find_property(const Spec& owner, Path path, Token name) const {
  const std::vector<Token>& names = children(owner, fields::properties);
  if (names.size() > kShortList) {
    return entry_at(path.property(name));
  }
  const auto listed = std::find(names.begin(), names.end(), name);
  if (listed == names.end()) {
    return nullptr;
  }
  const std::size_t first = slots_[slot_of(path)].entry;
  const auto is_it = [&](const Entry& entry) {
    const Path there = entry.path;
    return there.name() == name && there.parent() == path && there.kind() == PathKind::Property;
  };
  const std::size_t guess = first + static_cast<std::size_t>(listed - names.begin());
  if (guess < entries_.size() && is_it(entries_[guess])) {
    return &entries_[guess];
  }
  const auto begin = entries_.begin() + static_cast<std::ptrdiff_t>(first);
  const std::size_t count = std::min(names.size(), entries_.size() - first);
  const auto end = begin + static_cast<std::ptrdiff_t>(count);
  if (const auto found = std::find_if(begin, end, is_it); found != end) {
    return &*found;
  }
  return entry_at(path.property(name));
}

Spec& Layer::create(Path path, SpecKind kind) {
  if (4 * (entries_.size() + 1) > 3 * slots_.size()) {
    grow(std::max<std::size_t>(16, 2 * slots_.size()));
  }
  Slot& slot = slots_[slot_of(path)];
  if (slot.entry != 0) {
    return entries_[slot.entry - 1].spec;
  }
  Entry& entry = entries_.emplace_back();
  entry.path = path;
  entry.spec.kind = kind;
  slot = {path.number(), static_cast<std::uint32_t>(entries_.size())};
  return entry.spec;
}

void Layer::erase(Path path) {
  const std::uint32_t entry = slots_[slot_of(path)].entry;
  if (entry != 0) {
    entries_[entry - 1] = {};
    ++erased_;
  }
}

void Layer::reserve(std::size_t spec_count) {
  std::size_t slot_count = std::max<std::size_t>(16, slots_.size());
  while (4 * (spec_count + 1) > 3 * slot_count) {
    slot_count *= 2;
  }
  if (slot_count > slots_.size()) {
    grow(slot_count);
  }
}

void Layer::take_missing(Layer&& other) {
  reserve(spec_count() + other.spec_count());
  may_lack_text_ = may_lack_text_ || other.may_lack_text_;
  for (Entry& theirs : other.entries_) {
    const std::size_t slot = theirs.path.empty() ? 0 : slot_of(theirs.path);
    if (!theirs.path.empty() && slots_[slot].entry == 0) {
      slots_[slot] = {theirs.path.number(), static_cast<std::uint32_t>(entries_.size() + 1)};
      entries_.push_back(std::move(theirs));
    }
  }
}

void Layer::grow(std::size_t slot_count) {
  slots_.assign(slot_count, Slot());
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const Path path = entries_[i].path;
    if (!path.empty()) {
      slots_[slot_of(path)] = {path.number(), static_cast<std::uint32_t>(i + 1)};
    }
  }
}

const std::vector<Token>& Layer::children(const Spec& spec, Token field) {
  static const std::vector<Token> none;
  const auto* names = spec.get<std::vector<Token>>(field);
  return names == nullptr ? none : *names;
}

const std::vector<Token>& Layer::children(Path path, Token field) const {
  static const std::vector<Token> none;
  const Spec* spec = find(path);
  return spec == nullptr ? none : children(*spec, field);
}

Token Layer::default_prim() const { return root().get_or(fields::defaultPrim, Token()); }

const std::vector<std::string>& Layer::sublayers() const {
  static const std::vector<std::string> none;
  const auto* paths = root().get<std::vector<std::string>>(fields::subLayers);
  return paths == nullptr ? none : *paths;
}

LayerOffset Layer::sublayer_offset(std::size_t i) const {
  const auto* offsets = root().get<std::vector<LayerOffset>>(fields::subLayerOffsets);
  return offsets == nullptr || i >= offsets->size() ? LayerOffset{} : (*offsets)[i];
}

double Layer::time_codes_per_second() const {
  if (const auto* rate = root().get<double>(fields::timeCodesPerSecond)) {
    return *rate;
  }
  return root().get_or(fields::framesPerSecond, 24.0);
}

}  // namespace tenon::layer
