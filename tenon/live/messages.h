// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What a page and a live session say to each other, as tables: messages read are checked against
// them, and their JSON Schema is made of them, of which the page's types
// (page/src/live/protocol.ts) and docs/viewer.md are made and against which tests hold what is
// sent. Every message is a JSON object. Numbers are SI and radians, world axes; values of
// properties are text as layers print it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/answers/json.h"
#include "tenon/base/path.h"
#include "tenon/base/result.h"
#include "tenon/math/vector.h"

namespace tenon::live {

using answers::Json;

/// Counts up when a message changes what it means; new ones and new keys leave it.
inline constexpr int kProtocol = 1;

enum class FieldType : std::uint8_t {
  Text,
  Path,     ///< of a prim, absolute
  Number,   ///< finite
  Integer,  ///< 0 to Field::most
  Flag,
  Point,    ///< three numbers
  Numbers,  ///< in requests at most 64, like the next ones at most 256
  Paths,    ///< as Path
  Rows,     ///< objects with the fields of Field::shape
  Object,   ///< one of them; in notices and answers alone, like the next ones
  List,     ///< of Field::item
  Any,
};

struct Shape;

struct Field {
  std::string_view name;
  FieldType type = FieldType::Text;
  bool required = true;  ///< else it may be null, and missing in requests
  std::string_view meaning{};
  std::uint32_t most = 1'000'000;  ///< of Integer, in requests
  const Shape* shape = nullptr;    ///< of Rows, in requests without Rows itself, and Object
  const Field* item = nullptr;     ///< of List: what each of it is
  bool may_miss = false;           ///< of notices and answers
};

/// The fields of an object. A name is that of its type in the page's TypeScript.
struct Shape {
  std::string_view name{};
  std::span<const Field> fields{};
  std::string_view verb{};  ///< not empty: there are more, as in `tenon VERB --json`
};

/// A kind of message: a request, which says "do", or a notice, which says "is".
struct MessageInfo {
  std::string_view name;
  std::span<const Field> fields;
  std::string_view meaning;
  const Shape* answer = nullptr;  ///< of requests: the result; null: an object without fields
};

/// What a session says by itself, to those whom it concerns.
std::span<const MessageInfo> notices();

/// {"protocol", "requests": [{"name", "meaning", "schema", "result"}], "notices": the same without
/// "result"}; "schema" is JSON Schema of the whole message, "result" that of `result` in its
/// answer.
Json messages_json(std::span<const MessageInfo> requests);

/// A request that was understood, its fields as their types say.
class Asked {
 public:
  /// Null "id": none was given.
  const Json& id() const { return id_; }
  const std::string& name() const { return name_; }

  bool has(std::string_view field) const;
  std::string text(std::string_view field) const;  ///< empty when not given
  double number(std::string_view field, double otherwise = 0) const;
  std::uint32_t integer(std::string_view field, std::uint32_t otherwise = 0) const;
  bool flag(std::string_view field, bool otherwise = false) const;
  Vec3d point(std::string_view field) const;
  std::vector<double> numbers(std::string_view field) const;
  Path path(std::string_view field) const;  ///< empty when not given
  std::vector<Path> paths(std::string_view field) const;
  std::vector<Asked> rows(std::string_view field) const;

 private:
  friend class Listener;
  Json fields_ = Json::object();
  Json id_;
  std::string name_;
};

/// Reads requests by their table.
class Listener {
 public:
  explicit Listener(std::span<const MessageInfo> requests) : requests_(requests) {}

  /// `asked` gets the id and the name also of what is refused, as far as they can be read. Errors:
  /// Parse (live.bad-message) for what is no JSON object, NotFound (live.unknown-request), Invalid
  /// (live.bad-field). Otherwise the index of the request in the table.
  Result<std::size_t> read(std::string_view text, Asked& asked) const;

 private:
  std::span<const MessageInfo> requests_;
};

}  // namespace tenon::live
