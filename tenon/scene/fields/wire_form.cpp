// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/fields/wire_form.h"

#include <optional>
#include <utility>

#include "tenon/base/content_digest.h"
#include "tenon/base/wire.h"
#include "tenon/scene/check_scene.h"
#include "tenon/scene/fields/scene_fields.h"

namespace tenon::wire {

template <>
struct TravelsAs<Path> {
  static std::string to(const Path& path) { return path.empty() ? std::string() : path.str(); }
  static std::optional<Path> from(const std::string& text) {
    if (text.empty()) {
      return Path();
    }
    const Result<Path> path = Path::parse(text);
    return path ? std::optional(*path) : std::nullopt;
  }
};

}  // namespace tenon::wire

namespace tenon::scene {
namespace {

constexpr std::string_view kMagic = "tenon scene 1\n";

/// The names of all fields, as deep as they lie, and the sizes of what they are made of: builds
/// that agree in these understand each other's bytes.
template <class T>
void add_form(std::string& form) {
  if constexpr (HasTable<T>) {
    form += '{';
    each_field_type<T>([&](const FieldInfo& info, auto type) {
      form += std::string(info.name) + ':';
      add_form<typename decltype(type)::type>(form);
    });
    form += '}';
  } else if constexpr (wire::kIsVector<T> || wire::kIsOptional<T>) {
    form += wire::kIsVector<T> ? '[' : '?';
    add_form<typename T::value_type>(form);
  } else if constexpr (wire::kIsPair<T>) {
    form += '(';
    add_form<typename T::first_type>(form);
    add_form<typename T::second_type>(form);
  } else {
    form += std::to_string(wire::min_size<T>()) + ';';
  }
}

std::uint64_t form_digest() {
  static const std::uint64_t digest = [] {
    std::string form;
    add_form<PhysicsScene>(form);
    return content_digest(form);
  }();
  return digest;
}

}  // namespace

std::string wire_form(const PhysicsScene& scene) {
  wire::StringSink sink;
  sink.put(kMagic.data(), kMagic.size());
  wire::encode(sink, form_digest());
  wire::encode(sink, scene);
  return std::move(sink.bytes);
}

Result<PhysicsScene> read_wire_form(std::string_view bytes) {
  if (bytes.substr(0, kMagic.size()) != kMagic) {
    return Error(ErrorCode::Corrupt, "these bytes are no physics scene");
  }
  wire::Decoder decoder(bytes.substr(kMagic.size()));
  std::uint64_t form = 0;
  decoder.read(form);
  if (decoder.is_sound() && form != form_digest()) {
    return Error(ErrorCode::Unsupported, "a build with other fields wrote this physics scene")
        .with_fix("write and read it with the same version of tenon");
  }
  PhysicsScene scene;
  decoder.read(scene);
  if (!decoder.is_done()) {
    return Error(ErrorCode::Corrupt, "the bytes of this physics scene are damaged");
  }
  TENON_CHECK(check_scene(scene));
  return scene;
}

std::uint64_t scene_hash(const PhysicsScene& scene) { return content_digest(wire_form(scene)); }

std::uint64_t mesh_hash(const TriangleMesh& mesh) { return content_digest(wire::encoded(mesh)); }

}  // namespace tenon::scene
