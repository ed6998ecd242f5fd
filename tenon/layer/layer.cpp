// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/layer/layer.h"

#include <algorithm>
#include <functional>

namespace tenon::layer {
namespace {

constexpr std::uint64_t kIndexMask = 0xFFFFFFFFu;

/// Where to look for a path first, and the upper half of its slot, which tells most others apart
/// without a look at the entry.
struct Place {
  std::size_t at;
  std::uint64_t tag;
};

Place place_of(Path path, std::size_t slot_count) {
  const std::uint64_t hash = std::hash<Path>{}(path);
  return {(hash >> 17) & (slot_count - 1), hash & ~kIndexMask};
}

std::size_t entry_of(std::uint64_t slot) { return (slot & kIndexMask) - 1; }

}  // namespace

Layer::Layer(std::string identifier) : identifier_(std::move(identifier)) {
  create(Path::absolute_root(), SpecKind::PseudoRoot);
}

const Spec* Layer::find(Path path) const {
  const Place place = place_of(path, slots_.size());
  for (std::size_t at = place.at; slots_[at] != 0; at = (at + 1) & (slots_.size() - 1)) {
    if ((slots_[at] & ~kIndexMask) == place.tag) {
      const Entry& entry = entries_[entry_of(slots_[at])];
      if (entry.path == path) {
        return &entry.spec;
      }
    }
  }
  return nullptr;
}

Spec* Layer::find(Path path) { return const_cast<Spec*>(std::as_const(*this).find(path)); }

Spec& Layer::create(Path path, SpecKind kind) {
  if (!slots_.empty()) {
    if (Spec* spec = find(path)) {
      return *spec;
    }
  }
  if (2 * (entries_.size() + 1) > slots_.size()) {
    grow();
  }
  entries_.push_back({path, {}});
  entries_.back().spec.kind = kind;
  index_entry(entries_.size() - 1);
  return entries_.back().spec;
}

void Layer::erase(Path path) {
  std::size_t at = place_of(path, slots_.size()).at;
  while (slots_[at] != 0) {
    Entry& entry = entries_[entry_of(slots_[at])];
    if (entry.path == path) {
      entry = {};
      ++erased_;
      return;
    }
    at = (at + 1) & (slots_.size() - 1);
  }
}

void Layer::reserve(std::size_t spec_count) {
  while (2 * spec_count > slots_.size()) {
    grow();
  }
}

void Layer::index_entry(std::size_t entry) {
  const Place place = place_of(entries_[entry].path, slots_.size());
  std::size_t at = place.at;
  while (slots_[at] != 0) {
    at = (at + 1) & (slots_.size() - 1);
  }
  slots_[at] = place.tag | (entry + 1);
}

void Layer::grow() {
  slots_.assign(std::max<std::size_t>(64, 2 * slots_.size()), 0);
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (!entries_[i].path.empty()) {
      index_entry(i);
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
