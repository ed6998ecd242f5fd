// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// What lets the second half of a layer be read while the first half is.
#include <algorithm>

#include "tenon/formats/text/layer_reader.h"
#include "tenon/formats/text/split_text.h"

namespace tenon::formats::text {
namespace {

namespace fields = layer::fields;

void append(std::vector<Token>& names, const std::vector<Token>& more) {
  names.insert(names.end(), more.begin(), more.end());
}

bool are_new(const layer::Layer& layer, Path parent, const std::vector<Token>& children,
             const std::vector<Token>& properties) {
  return std::none_of(children.begin(), children.end(),
                      [&](Token name) { return layer.has(parent.child(name)); }) &&
         std::none_of(properties.begin(), properties.end(),
                      [&](Token name) { return layer.has(parent.property(name)); });
}

// What `rest` says about `path` is nothing but names of children and properties, new ones.
bool only_adds(const layer::Layer& layer, const layer::Layer& rest, Path path) {
  const layer::Spec* const found = rest.find(path);
  if (found == nullptr) {
    return false;
  }
  const layer::Spec& more = *found;
  const auto is_plain = [](const layer::Field& field) {
    return field.name == fields::primChildren || field.name == fields::properties;
  };
  const auto items = more.fields();
  return std::all_of(items.begin(), items.end(), is_plain) &&
         are_new(layer, path, layer::Layer::children(more, fields::primChildren),
                 layer::Layer::children(more, fields::properties));
}

}  // namespace

void LayerReader::read_from(std::size_t offset, const std::atomic<bool>& wanted) {
  if (!enter_prims(prims_around(cursor_.text(), offset))) {
    return;
  }
  cursor_.seek(offset);
  while (wanted.load(std::memory_order_relaxed) && read_step()) {
  }
}

bool LayerReader::take_rest(LayerReader& rest) {
  if (!continues_here(rest)) {
    return false;
  }
  for (Block& block : blocks_) {
    const layer::Layer& more = rest.state_.layer;
    const bool is_layer = block.kind == Block::Kind::Layer;
    append(block.children, is_layer ? rest.blocks_.front().children
                                    : more.children(block.path, fields::primChildren));
    append(block.properties, more.children(block.path, fields::properties));
  }
  state_.layer.take_missing(std::move(rest.state_.layer));
  while (blocks_.size() > 1) {
    store_children(state_, blocks_.back());
    blocks_.pop_back();
  }
  return true;
}

bool LayerReader::enter_prims(const std::vector<std::size_t>& offsets) {
  for (const std::size_t offset : offsets) {
    cursor_.seek(offset);
    PrimHead head;
    if (!read_prim_head(cursor_, cursor_.peek_identifier(), head)) {
      return false;
    }
    const Path path = top().path.child(Token(head.name));
    state_.layer.create(path, layer::SpecKind::Prim);
    if (!push({Block::Kind::Prim, path, offset})) {
      return false;
    }
    around_.push_back(path);
  }
  return true;
}

bool LayerReader::continues_here(const LayerReader& rest) const {
  const bool at_end = rest.cursor_.at_end() && !rest.cursor_.failed() && rest.blocks_.size() == 1 &&
                      rest.state_.diagnostics.empty();
  const auto same = [](const Block& block, Path path) {
    return block.kind == Block::Kind::Prim && block.path == path;
  };
  return at_end &&
         std::equal(blocks_.begin() + 1, blocks_.end(), rest.around_.begin(), rest.around_.end(),
                    same) &&
         std::all_of(blocks_.begin(), blocks_.end(),
                     [&](const Block& block) {
                       return only_adds(state_.layer, rest.state_.layer, block.path);
                     }) &&
         are_new(state_.layer, blocks_.front().path, rest.blocks_.front().children, {});
}

}  // namespace tenon::formats::text
