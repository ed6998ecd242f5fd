// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// The text form of paths: reading and writing. Grammar: Core Spec 1.0.1 section 6.
#include <string>
#include <vector>

#include "tenon/base/containers/short_list.h"
#include "tenon/base/limits/limits.h"
#include "tenon/base/path.h"
#include "tenon/base/text/text_cursor.h"
#include "tenon/base/text/unicode.h"

namespace tenon {
namespace {

std::size_t namespaced_length(std::string_view text) {
  std::size_t at = unicode::identifier_length(text);
  while (at != 0 && at < text.size() && text[at] == ':') {
    const std::size_t next = unicode::identifier_length(text.substr(at + 1));
    if (next == 0) {
      break;
    }
    at += 1 + next;
  }
  return at;
}

std::size_t variant_name_length(std::string_view text) {
  std::size_t at = !text.empty() && text.front() == '.' ? 1 : 0;
  while (at < text.size()) {
    const unicode::Decoded c = unicode::decode(text.substr(at));
    const bool fits =
        unicode::continues_identifier(c.code_point) || c.code_point == U'|' || c.code_point == U'-';
    if (c.length == 0 || !fits) {
      break;
    }
    at += c.length;
  }
  return at;
}

class PathReader : private TextCursor {
 public:
  PathReader(std::string_view text, std::size_t depth) : TextCursor(text), depth_(depth) {}

  Result<Path> read() {
    TENON_TRY(Path path, read_prims());
    TENON_TRY(path, read_property_part(path));
    if (at_ != text_.size()) {
      return fail("unexpected '" + std::string(text_.substr(at_, 1)) + "'");
    }
    return path;
  }

 private:
  void skip_blanks() {
    while (peek() == ' ' || peek() == '\t') {
      ++at_;
    }
  }
  Error fail(const std::string& why, ErrorCode code = ErrorCode::Parse) const {
    return Error(code, "ill-formed path <" + std::string(text_.substr(0, 200)) + ">: " + why +
                           " at character " + std::to_string(at_ + 1));
  }

  Result<Path> read_prims() {
    Path path = Path::relative_root();
    if (accept("/")) {
      path = Path::absolute_root();
      if (at_end()) {
        return path;
      }
    } else if (rest() == ".") {
      ++at_;
      return path;
    }
    if (!path.is_absolute()) {
      bool stepped = false;
      while (accept("..")) {
        path = path.child("..");
        stepped = true;
        if (!accept("/")) {
          return path;
        }
      }
      if (stepped && at_end()) {
        return fail("a name is missing after '/'");
      }
      if (peek() == '.') {
        return path;
      }
    }
    return read_names(path);
  }

  Result<Path> read_names(Path path) {
    while (true) {
      const std::size_t length = unicode::identifier_length(rest());
      if (length == 0) {
        return fail("a prim name is expected");
      }
      path = path.child(rest().substr(0, length));
      at_ += length;
      bool after_variant = false;
      while (peek() == '{') {
        TENON_TRY(path, read_variant(path));
        after_variant = true;
      }
      if (path.depth() > limits::kPathElements) {
        return fail("too many elements", ErrorCode::Limit);
      }
      if (accept("/")) {
        if (after_variant && at_end()) {
          return fail("a prim name is expected");
        }
        continue;
      }
      if (after_variant && !at_end() && peek() != '.' && peek() != ']') {
        continue;
      }
      return path;
    }
  }

  Result<Path> read_variant(Path prim) {
    ++at_;
    skip_blanks();
    const std::size_t set_length = unicode::identifier_length(rest());
    if (set_length == 0) {
      return fail("a variant set name is expected");
    }
    const Token set(rest().substr(0, set_length));
    at_ += set_length;
    skip_blanks();
    if (!accept("=")) {
      return fail("'=' is expected");
    }
    skip_blanks();
    const std::size_t name_length = variant_name_length(rest());
    const Token variant(rest().substr(0, name_length));
    at_ += name_length;
    skip_blanks();
    if (!accept("}")) {
      return fail("'}' is expected");
    }
    return prim.variant_selection(set, variant);
  }

  Result<Path> read_property_part(Path path) {
    if (peek() != '.') {
      return path;
    }
    ++at_;
    const std::size_t length = namespaced_length(rest());
    if (length == 0 || path.is_absolute_root()) {
      return fail("a property name is expected");
    }
    path = path.property(rest().substr(0, length));
    at_ += length;
    while (!at_end()) {
      if (peek() == '[') {
        TENON_TRY(Path target, read_bracket());
        path = path.target_element(target);
        continue;
      }
      if (accept(".mapper[")) {
        --at_;
        TENON_TRY(Path target, read_bracket());
        path = path.mapper(target);
        continue;
      }
      if (rest() == ".expression") {
        at_ = text_.size();
        return path.expression();
      }
      if (peek() != '.' || (path.kind() != PathKind::Target && path.kind() != PathKind::Mapper)) {
        return path;
      }
      ++at_;
      const std::size_t name = namespaced_length(rest());
      if (name == 0) {
        return fail("a property name is expected");
      }
      const Token word(rest().substr(0, name));
      path = path.is_target() ? path.property(word) : path.mapper_arg(word);
      at_ += name;
    }
    return path;
  }

  Result<Path> read_bracket() {
    ++at_;
    const std::size_t start = at_;
    std::size_t open = 1;
    while (!at_end() && open > 0) {
      open += peek() == '[' ? 1u : 0u;
      open -= peek() == ']' ? 1u : 0u;
      ++at_;
    }
    if (open > 0) {
      return fail("']' is expected");
    }
    if (depth_ > 8) {
      return fail("targets are nested too deep");
    }
    return PathReader(text_.substr(start, at_ - 1 - start), depth_ + 1).read();
  }

  std::size_t depth_;
};

void append_element(std::string& text, Path path) {
  const Path parent = path.parent();
  switch (path.kind()) {
    case PathKind::Prim:
      if (!(text.empty() || text.back() == '/' || parent.is_variant_selection())) {
        text += '/';
      }
      text += path.name().view();
      break;
    case PathKind::VariantSelection:
      text += '{' + path.name().str() + '=' + path.variant().str() + '}';
      break;
    case PathKind::Property:
      if (parent.is_prim() && parent.name() == "..") {
        text += '/';
      }
      [[fallthrough]];
    case PathKind::RelationalAttribute:
    case PathKind::MapperArg:
      text += '.';
      text += path.name().view();
      break;
    case PathKind::Target:
      text += '[' + path.target().str() + ']';
      break;
    case PathKind::Mapper:
      text += ".mapper[" + path.target().str() + ']';
      break;
    case PathKind::Expression:
      text += ".expression";
      break;
    case PathKind::AbsoluteRoot:
      text += '/';
      break;
    case PathKind::RelativeRoot:
    case PathKind::Empty:
      break;
  }
}

}  // namespace

Result<Path> Path::parse(std::string_view text) {
  if (text.empty()) {
    return Error(ErrorCode::Parse, "the empty text is not a path");
  }
  if (text.size() > limits::kPathTextLength) {
    return Error(ErrorCode::Limit,
                 "a path is longer than " + std::to_string(limits::kPathTextLength) + " bytes");
  }
  return PathReader(text, 0).read();
}

Path Path::from(std::string_view text) {
  auto path = parse(text);
  return path ? *path : Path();
}

std::string Path::str() const {
  if (kind() == PathKind::RelativeRoot) {
    return ".";
  }
  ShortList<Path, 24> elements;
  for (Path path = *this; !path.empty(); path = path.parent()) {
    elements.push_back(path);
  }
  std::string text;
  for (auto element = elements.rbegin(); element != elements.rend(); ++element) {
    append_element(text, *element);
  }
  return text;
}

bool is_identifier(std::string_view text) {
  return !text.empty() && unicode::identifier_length(text) == text.size();
}

bool is_namespaced_identifier(std::string_view text) {
  return !text.empty() && namespaced_length(text) == text.size();
}

bool is_variant_name(std::string_view text) { return variant_name_length(text) == text.size(); }

}  // namespace tenon
