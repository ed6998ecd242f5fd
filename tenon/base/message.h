// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tenon {

class Path;

/// What a finding says that something else is.
enum class RelatedRole : std::uint8_t {
  Prim,
  Body,
  Collider,
  Joint,
  Articulation,
  Material,
  Scene,
  CollisionGroup,
  Property,
  Target,  ///< named by a relationship, and not what is needed there
};

/// "prim", "body", ..., "collisionGroup", "property", "target".
std::string_view role_name(RelatedRole role);

/// What a finding is about beside its own prim.
struct RelatedPrim {
  std::string path;  ///< of a prim or a property
  RelatedRole role = RelatedRole::Prim;
  std::string
      file;  ///< where it is authored, or the layer whose paths `path` is one of; may be empty
  std::uint32_t line = 0;    ///< 1-based; 0: unknown
  std::uint32_t column = 0;  ///< 1-based, in bytes; 0: unknown

  bool operator==(const RelatedPrim&) const = default;
};

/// The sentence of a finding and what it is about. A sentence names a prim by `named(path, role)`
/// alone, so that each prim in the text is a field as well:
///   "the leader " + named(leader.path, RelatedRole::Joint) + " is disabled"
class Message {
 public:
  Message(std::string text);  // NOLINT(google-explicit-constructor): most sentences name nothing
  Message(const char* text);  // NOLINT(google-explicit-constructor)

  const std::string& text() const { return text_; }
  const std::vector<RelatedPrim>& related() const { return related_; }

  Message& operator+=(const Message& tail);
  /// It is about this as well, which the text does not name.
  Message& about(Path path, RelatedRole role, std::string file = {});

 private:
  friend Message named(Path path, RelatedRole role, std::string file);

  void relate(RelatedPrim prim);

  std::string text_;
  std::vector<RelatedPrim> related_;  ///< in the order of the text, each once
};

/// `<path>`; with a file, `@file@<path>`: a path within that layer.
Message named(Path path, RelatedRole role = RelatedRole::Prim, std::string file = {});

inline Message operator+(Message head, const Message& tail) {
  head += tail;
  return head;
}

}  // namespace tenon
