// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Each step reads one statement of the innermost open block. The names of children and properties
// are gathered in the block and stored in its spec when it closes. All that matters between two
// statements is the stack of blocks and what the layer holds, so reading can go on at any byte
// where a statement begins: behind a fault (fault_recovery.cpp), or in the middle of the text,
// where a second reader begins with the blocks around it already open (layer_halves.cpp). Depth is
// bounded by a limit.
#include "tenon/formats/text/layer_reader.h"

#include <utility>

#include "tenon/base/limits/limits.h"
#include "tenon/formats/text/header.h"
#include "tenon/formats/text/literals.h"
#include "tenon/formats/text/metadata_reader.h"
#include "tenon/formats/text/properties/property_reader.h"
#include "tenon/formats/text/value_reader.h"

namespace tenon::formats::text {
namespace {

using layer::SpecKind;
using layer::Value;
namespace fields = layer::fields;

void note_header(LayerState& state) {
  if (state.sources != nullptr) {
    std::size_t end = state.cursor.offset();
    while (end > 0 &&
           (state.cursor.text()[end - 1] == '\n' || state.cursor.text()[end - 1] == '\r')) {
      --end;
    }
    state.sources->header_end = end;
  }
}

void note_open(LayerState& state, Path path, SourceBlock block) {
  if (state.sources != nullptr) {
    block.body.begin = state.cursor.offset() - 1;
    state.sources->blocks.insert_or_assign(path, block);
  }
}

void note_close(LayerState& state, Path path) {
  if (state.sources != nullptr) {
    SourceBlock& block = state.sources->blocks[path];
    block.body.end = block.range.end = state.cursor.offset();
  }
}

// Where the default prim was closed, when another prim was closed after it.
std::string default_prim_note(const LastClosed& closed, Token default_prim) {
  return closed.default_line == 0 || closed.default_line == closed.line
             ? std::string()
             : ", and another closed </" + default_prim.str() + "> at line " +
                   std::to_string(closed.default_line);
}

// Something that is no prim between the prims of the layer: often a '}' stands too early.
bool fail_layer_statement(Cursor& cursor, const LastClosed& closed, Token default_prim) {
  constexpr std::string_view kExpected =
      "def, over, class, reorder rootPrims or the end of the file";
  if (closed.name.empty()) {
    return cursor.fail_expected(kExpected);
  }
  const std::string line = std::to_string(closed.line);
  const char c = cursor.peek();
  std::string fix = "remove this '" + std::string(1, c) + "', or the '}' at line " + line;
  if (c == '{') {
    fix = "write `def \"Name\"` before '{', or remove the '}' at line " + line;
  } else if (c != '}' && c != ')' && c != ']') {
    fix = "if this belongs to " + closed.name + ", remove the '}' at line " + line;
  }
  return cursor.fail_at(cursor.offset(), ErrorCode::Parse, "text.syntax",
                        "expected " + std::string(kExpected) + ", found " + cursor.found() +
                            "; an earlier '}' closed " + closed.name + " at line " + line +
                            default_prim_note(closed, default_prim),
                        fix);
}

bool fail_contents_statement(Cursor& cursor, const Block& block) {
  const std::string opened = std::to_string(cursor.place_of(block.start).line);
  std::string fix;
  if (cursor.at_end()) {
    fix = "add '}' for " + block_name(block) + ", opened at line " + opened;
  } else if (cursor.peek() == ')' || cursor.peek() == ']') {
    fix = "remove it; " + block_name(block) + " was opened at line " + opened;
  }
  return cursor.fail_expected(
      "a property, def, over, class, variantSet, reorder, or the '}' of " + block_name(block), fix);
}

bool read_order(LayerState& state, Path path, Token field, std::size_t start) {
  Cursor& cursor = state.cursor;
  cursor.skip_inline();
  if (!cursor.expect('=', "before the names")) {
    return false;
  }
  cursor.skip_inline();
  std::vector<std::string> names;
  if (!read_name_list(cursor, names)) {
    return false;
  }
  state.layer.create(path, SpecKind::Prim)
      .set(field, Value(std::vector<Token>(names.begin(), names.end())));
  if (state.sources != nullptr) {
    state.sources->orders[path].push_back({start, cursor.offset()});
  }
  return true;
}

bool end_statement(Cursor& cursor, const Block& block, std::string_view where) {
  if (cursor.accept('\n')) {
    return true;
  }
  cursor.skip_single_line();
  const bool at_layer = block.kind == Block::Kind::Layer && cursor.at_end();
  return at_layer || cursor.accept_statement_end() || cursor.failed() == true
             ? !cursor.failed()
             : cursor.fail_expected("the end of the line or ';' " + std::string(where));
}

}  // namespace

LayerReader::LayerReader(std::string_view text, std::string identifier, Diagnostics& diagnostics,
                         SourceMap* sources)
    : state_(text, std::move(identifier), diagnostics), cursor_(state_.cursor) {
  state_.sources = sources;
  blocks_.push_back({Block::Kind::Layer, Path::absolute_root()});
}

bool LayerReader::read_from_front(std::size_t stop) {
  stop_ = stop;
  if (!read_header(state_)) {
    return false;
  }
  note_header(state_);
  return read_block_metadata(state_, Path::absolute_root(), SpecKind::PseudoRoot, nullptr) &&
         read_statements();
}

bool LayerReader::read_statements() {
  while (read_step() || (cursor_.failed() && go_on_behind_fault())) {
  }
  return !cursor_.failed();
}

bool LayerReader::go_on_behind_fault() {
  const std::string_view text = cursor_.text();
  const std::size_t fault = cursor_.fault();
  if (fault < statement_ || fault >= text.size() || !state_.finds_all_faults) {
    return false;
  }
  cursor_.seek(statement_);
  const std::string_view word = cursor_.peek_identifier();
  const bool is_block = word == "def" || word == "over" || word == "class" ||
                        word == "variantSet" || top().kind == Block::Kind::VariantSet;
  if (!is_block && top().kind == Block::Kind::Layer) {
    return false;  // most likely a '}' stands too early, and all that follows is out of place
  }
  if (!is_block && word.empty()) {
    return false;
  }
  auto end = is_block ? end_of_faulty_block(text, statement_, fault)
                      : end_of_faulty_statement(text, statement_, fault, '}');
  if (end && *end < text.size() && text[*end] == ';') {
    ++*end;
  }
  return state_.go_on_at(end);
}

Result<layer::Layer> LayerReader::finish() {
  if (cursor_.failed()) {
    state_.keep_fault();
  }
  if (has_faults()) {
    std::vector<Diagnostic> further;
    for (std::size_t i = 1; i < state_.faults.size(); ++i) {
      further.push_back(state_.faults[i].diagnostic());
    }
    return std::move(state_.faults.front()).with_further(std::move(further));
  }
  store_children(state_, blocks_.front());
  return std::move(state_.layer);
}

bool LayerReader::read_step() {
  cursor_.skip_multi_line();
  if (cursor_.failed()) {
    return false;
  }
  if (cursor_.offset() >= stop_) {
    stopped_ = cursor_.offset() == stop_;
    stop_ = std::string_view::npos;
    if (stopped_) {
      return false;
    }
  }
  statement_ = cursor_.offset();
  switch (top().kind) {
    case Block::Kind::Layer:
      return !cursor_.at_end() && read_layer_statement();
    case Block::Kind::VariantSet:
      return cursor_.accept('}') ? close_block() : open_variant();
    case Block::Kind::Prim:
    case Block::Kind::Variant:
      return cursor_.accept('}') ? close_block() : read_contents_statement();
  }
  return false;
}

bool LayerReader::read_layer_statement() {
  const std::string_view word = cursor_.peek_identifier();
  if (word == "def" || word == "over" || word == "class") {
    return open_prim(word);
  }
  if (word != "reorder") {
    return fail_layer_statement(cursor_, last_closed_, state_.layer.default_prim());
  }
  const std::size_t start = cursor_.offset();
  cursor_.advance(word.size());
  if (!cursor_.accept_separator() || !cursor_.accept_word("rootPrims")) {
    return cursor_.fail_expected("`rootPrims`");
  }
  return read_order(state_, top().path, fields::primOrder, start) &&
         end_statement(cursor_, top(), "after reorder rootPrims");
}

bool LayerReader::read_contents_statement() {
  if (KnownAttribute* const known = state_.known_attributes.find(cursor_.rest())) {
    return read_known_attribute(state_, *known, top().path, top().properties) &&
           end_statement(cursor_, top(), "after a property");
  }
  const std::string_view word = cursor_.peek_identifier();
  if (word == "def" || word == "over" || word == "class") {
    return open_prim(word);
  }
  if (word == "variantSet") {
    return open_variant_set();
  }
  if (word.empty()) {
    return fail_contents_statement(cursor_, top());
  }
  if (word == "reorder") {
    const std::size_t start = cursor_.offset();
    cursor_.advance(word.size());
    if (cursor_.accept_separator()) {
      if (cursor_.accept_word("nameChildren")) {
        return read_order(state_, top().path, fields::primOrder, start) &&
               end_statement(cursor_, top(), "after reorder nameChildren");
      }
      if (cursor_.accept_word("properties")) {
        return read_order(state_, top().path, fields::propertyOrder, start) &&
               end_statement(cursor_, top(), "after reorder properties");
      }
    }
    cursor_.seek(start);
  }
  return read_property(state_, top().path, top().properties) &&
         end_statement(cursor_, top(), "after a property");
}

bool LayerReader::push(Block block) {
  if (blocks_.size() > limits::kTextNestingDepth) {
    return cursor_.fail_at(
        block.start, ErrorCode::Limit, "text.depth",
        "blocks are nested deeper than " + std::to_string(limits::kTextNestingDepth));
  }
  blocks_.push_back(std::move(block));
  if (blocks_.back().properties.capacity() == 0) {
    blocks_.back().properties = std::exchange(state_.spare_names, {});
  }
  state_.open_block = blocks_.back().path;
  return true;
}

bool LayerReader::open_prim(std::string_view specifier_word) {
  const std::size_t start = cursor_.offset();
  PrimHead head;
  if (!read_prim_head(cursor_, specifier_word, head)) {
    return false;
  }
  const Path path = top().path.child(Token(head.name));
  if (const layer::Spec* old = state_.layer.find(path)) {
    return cursor_.fail_at(
        head.name_start, ErrorCode::Parse, "text.duplicate",
        "prim <" + path.str() + "> was already given at line " + std::to_string(old->line),
        "rename one of them or put both into one block");
  }
  top().children.push_back(path.name());
  layer::Spec& spec = state_.make_spec(path, SpecKind::Prim, start);
  spec.reserve_fields(4);
  spec.append(fields::specifier, Value(specifier_word == "def"    ? layer::Specifier::Def
                                       : specifier_word == "over" ? layer::Specifier::Over
                                                                  : layer::Specifier::Class));
  if (!head.type_name.empty()) {
    spec.append(fields::typeName, Value(Token(head.type_name)));
  }
  if (!read_block_metadata(state_, path, SpecKind::Prim, &spec) ||
      !open_brace(cursor_, path, start)) {
    return false;
  }
  note_open(state_, path, {{start, 0}, head.name_start, head.name_end, {}});
  return push({Block::Kind::Prim, path, start});
}

bool LayerReader::open_variant_set() {
  const std::size_t start = cursor_.offset();
  cursor_.accept_word("variantSet");
  std::string name;
  if (!cursor_.accept_separator() || !at_string(cursor_)) {
    return cursor_.fail_expected("the name of the variant set in quotes");
  }
  if (!read_variant_name(cursor_, start, name)) {
    return false;
  }
  cursor_.skip_inline();
  if (!cursor_.expect('=', "after the name of the variant set")) {
    return false;
  }
  cursor_.skip_multi_line();
  const Path prim = top().path;
  const Path path = prim.variant_selection(Token(name), Token());
  if (!state_.layer.has(path)) {
    state_.make_spec(path, SpecKind::VariantSet, start);
    std::vector<Token>& sets = top().variant_sets;
    if (sets.empty()) {
      sets = state_.layer.children(prim, fields::variantSetChildren);
    }
    sets.emplace_back(name);
  }
  if (!open_brace(cursor_, path, start) || !check_first_variant(cursor_)) {
    return false;
  }
  note_open(state_, path, {{start, 0}, start, start, {}});
  return push({Block::Kind::VariantSet, path, start});
}

bool LayerReader::open_variant() {
  const std::size_t start = cursor_.offset();
  std::string name;
  if (!at_string(cursor_)) {
    return cursor_.fail_expected(
        "the name of a variant in quotes, or the '}' of the variant "
        "set opened at line " +
        std::to_string(cursor_.place_of(top().start).line));
  }
  if (!read_variant_name(cursor_, start, name)) {
    return false;
  }
  const std::size_t name_end = cursor_.offset();
  const Token variant(name);
  const Path path = top().path.parent().variant_selection(top().path.name(), variant);
  if (state_.layer.has(path)) {
    state_.warn(start, "text.duplicate",
                "variant \"" + name + "\" is given twice; both blocks are merged",
                "put both into one block");
  } else {
    top().children.push_back(variant);
    state_.make_spec(path, SpecKind::Variant, start);
  }
  const layer::Spec& spec = state_.layer.create(path, SpecKind::Variant);
  Block block{Block::Kind::Variant, path, start};
  block.children = layer::Layer::children(spec, fields::primChildren);
  block.properties = layer::Layer::children(spec, fields::properties);
  if (!read_block_metadata(state_, path, SpecKind::Variant, nullptr) ||
      !open_brace(cursor_, path, start)) {
    return false;
  }
  note_open(state_, path, {{start, 0}, start, name_end, {}});
  return push(std::move(block));
}

bool LayerReader::close_block() {
  const std::size_t brace = cursor_.offset() - 1;
  Block block = std::move(top());
  blocks_.pop_back();
  state_.open_block = top().path;
  note_close(state_, block.path);
  store_children(state_, block);
  if (top().kind == Block::Kind::Layer) {
    last_closed_.name = block_name(block);
    last_closed_.line = cursor_.place_of(brace).line;
    if (block.path.name() == state_.layer.default_prim()) {
      last_closed_.default_line = last_closed_.line;
    }
  }
  if (block.kind == Block::Kind::Variant) {
    return true;
  }
  cursor_.skip_single_line();
  if (cursor_.failed()) {
    return false;
  }
  const char c = cursor_.peek();
  if (c == '\n' || c == '\r' || (top().kind == Block::Kind::Layer && cursor_.at_end())) {
    return true;
  }
  return cursor_.fail_expected("the end of the line after the '}' of " + block_name(block));
}

}  // namespace tenon::formats::text
