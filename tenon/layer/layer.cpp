// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Specs lie in the order in which they were made; a table says where that of a path is. Readers
// make properties right behind their prim: such a run, of kShortList entries at most, is not in the
// table, for it is looked through from its prim on. Erased specs keep their place with an empty
// path, for places are never given twice.
#include "tenon/layer/layer.h"

#include <algorithm>
#include <span>

namespace tenon::layer {

Layer::Layer(std::string identifier) : identifier_(std::move(identifier)) {
  create(Path::absolute_root(), SpecKind::PseudoRoot);
}

Layer::Layer(const Layer& other) = default;
Layer::Layer(Layer&& other) noexcept = default;
Layer& Layer::operator=(const Layer& other) = default;
Layer& Layer::operator=(Layer&& other) noexcept = default;
Layer::~Layer() = default;

/// The entry of this number; null for 0.
const Layer::Entry* Layer::numbered(std::uint32_t entry) const {
  return entry == 0 ? nullptr : &entries_[entry - 1];
}

/// Looks through the run behind entry `first`, from 1 on: properties of its owner, or erased.
const Layer::Entry* Layer::in_run(Path property, std::size_t first) const {
  const std::size_t end = std::min(first + kShortList, entries_.size());
  while (first < end) {
    const std::span<const Entry> row = entries_.row(first, end);
    for (const Entry& entry : row) {
      const std::uint64_t differs = entry.path.id() ^ property.id();
      if (differs == 0) {
        return &entry;
      }
      if (static_cast<std::uint32_t>(differs) != 0 && !entry.path.empty()) {  // of another element
        return nullptr;
      }
    }
    first += row.size();
  }
  return nullptr;
}

const Layer::Entry* Layer::entry_at(Path path) const {
  return path.is_direct_property() ? property_at(path, tabled(path.parent()))
                                   : numbered(tabled(path));
}

/// The same of a property whose owner has the entry of this number, or none: 0.
const Layer::Entry* Layer::property_at(Path path, std::uint32_t owner) const {
  const Entry* entry = owner == 0 ? nullptr : in_run(path, owner);
  return entry == nullptr && has_strays_ ? numbered(tabled(path)) : entry;
}

const Spec* Layer::find(Path path) const {
  const Entry* entry = entry_at(path);
  return entry == nullptr ? nullptr : &entry->spec;
}

Spec* Layer::find(Path path) { return const_cast<Spec*>(std::as_const(*this).find(path)); }

/// From text, the properties of a run are in the order of the list.
const Layer::Entry* Layer::find_property(const Spec& owner, Path path, Token name) const {
  const std::vector<Token>& names = children(owner, fields::properties);
  const Path property = path.property(name);
  if (names.size() > kShortList) {
    return entry_at(property);
  }
  const auto listed = std::find(names.begin(), names.end(), name);
  if (listed == names.end()) {
    return nullptr;
  }
  const std::uint32_t first = tabled(path);
  const std::size_t guess = first + static_cast<std::size_t>(listed - names.begin());
  if (guess < entries_.size() && entries_[guess].path == property) {
    return &entries_[guess];
  }
  return property_at(property, first);
}

/// The entry of `path`; one without a kind, as which `made` says so, where there was none.
Layer::Entry& Layer::add(Path path, bool& made) {
  const bool property = path.is_direct_property();
  const bool in_open_run =
      property && path.parent() == run_owner_ && entries_.size() - run_entry_ < kShortList;
  const std::uint64_t mark = std::uint64_t{1} << (path.id() >> 32u) % 64;
  const bool may_be_there = !in_open_run || (run_marks_ & mark) != 0;
  const Entry* there = !in_open_run   ? entry_at(path)
                       : may_be_there ? in_run(path, run_entry_)
                                      : nullptr;
  if (there == nullptr && in_open_run && has_strays_) {
    there = numbered(tabled(path));
  }
  made = there == nullptr;
  if (!made) {
    return const_cast<Entry&>(*there);
  }
  Entry& entry = entries_.emplace_back();
  entry.path = path;
  run_marks_ |= mark;
  if (!in_open_run) {
    enter(path, entries_.size());
    run_owner_ = property ? Path() : path;
    run_marks_ = 0;
    run_entry_ = static_cast<std::uint32_t>(entries_.size());
  }
  return entry;
}

Spec* Layer::create_new(Path path, SpecKind kind) {
  bool made = false;
  Spec& spec = add(path, made).spec;
  if (!made) {
    return nullptr;
  }
  spec.kind = kind;
  return &spec;
}

Spec& Layer::create(Path path, SpecKind kind) {
  bool made = false;
  Spec& spec = add(path, made).spec;
  if (made) {
    spec.kind = kind;
  }
  return spec;
}

void Layer::erase(Path path) {
  const Entry* entry = entry_at(path);
  if (entry == nullptr) {
    return;
  }
  if (!path.is_direct_property()) {
    end_run(path);
  }
  const_cast<Entry&>(*entry) = {};
  ++erased_;
}

/// Puts the run of `owner`, which is about to go, into the table.
void Layer::end_run(Path owner) {
  const std::size_t first = tabled(owner);
  const std::size_t end = std::min(first + kShortList, entries_.size());
  for (std::size_t i = first; i < end; ++i) {
    const Path path = entries_[i].path;
    if (path.is_direct_property_of(owner)) {
      enter(path, i + 1);
    } else if (!path.empty()) {
      break;
    }
  }
  run_owner_ = run_owner_ == owner ? Path() : run_owner_;
}

void Layer::enter(Path path, std::size_t entry) {
  table_.put(path, static_cast<std::uint32_t>(entry), path_of());
  has_strays_ = has_strays_ || path.is_direct_property();
}

void Layer::reserve(std::size_t spec_count) { table_.reserve(spec_count, path_of()); }

void Layer::take_missing(Layer&& other) {
  may_lack_text_ = may_lack_text_ || other.may_lack_text_;
  for (std::size_t i = 0; i < other.entries_.size(); ++i) {
    Entry& theirs = other.entries_[i];
    bool made = false;
    if (theirs.path.empty()) {
      continue;
    }
    Entry& entry = add(theirs.path, made);
    if (made) {
      entry.spec = std::move(theirs.spec);
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
