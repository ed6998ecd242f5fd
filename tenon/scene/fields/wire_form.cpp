// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The fields one after the other in the order of the tables, in the bytes that tenon/base/wire.h
// makes of plain values: numbers as in memory, counts before lists, a flag before a value that may
// be absent, paths as text. They are preceded by a digest of all names and sizes, so that builds
// with other fields refuse each other's bytes. The input is untrusted: no count is believed before
// the bytes that it needs are there, and the scene is checked at the end.
#include "tenon/scene/fields/wire_form.h"

#include <cstring>
#include <string>
#include <utility>

#include "tenon/base/content_digest.h"
#include "tenon/base/wire.h"
#include "tenon/scene/check_scene.h"
#include "tenon/scene/fields/data_type.h"

namespace tenon::scene {
namespace {

constexpr std::string_view kMagic = "tenon scene 1\n";

/// The names of all fields, as deep as they lie, and the sizes of what they are made of: builds
/// that agree in these understand each other's bytes.
void add_form(const DataType& type, std::string& form) {
  switch (type.kind) {
    case DataKind::Struct:
      form += '{';
      for (const DataField& field : type.fields) {
        form += std::string(field.info->name) + ':';
        add_form(*field.type, form);
      }
      form += '}';
      break;
    case DataKind::List:
    case DataKind::Optional:
      form += type.kind == DataKind::List ? '[' : '?';
      add_form(*type.item, form);
      break;
    case DataKind::Pair:
      form += '(';
      add_form(*type.item, form);
      add_form(*type.second, form);
      break;
    default:
      form += std::to_string(type.wire_size) + ';';
  }
}

void put(DataView value, wire::StringSink& sink);

void put_list(DataView list, wire::StringSink& sink) {
  const std::size_t count = list.size();
  wire::encode(sink, std::uint64_t{count});
  if (list.type->item->is_flat) {
    sink.put(list.type->first(list.at), count * list.type->item->size);
    return;
  }
  for (std::size_t i = 0; i < count; ++i) {
    put(list[i], sink);
  }
}

/// The bytes that wire::encode makes of the same value.
void put(DataView value, wire::StringSink& sink) {
  if (value.type->is_flat) {
    sink.put(value.at, value.type->size);
    return;
  }
  switch (value.kind()) {
    case DataKind::Flag:
      wire::encode(sink, value.as<bool>());
      break;
    case DataKind::Text:
      wire::encode(sink, value.as<std::string>());
      break;
    case DataKind::Path:
      wire::encode(sink, value.as<Path>().empty() ? std::string() : value.as<Path>().str());
      break;
    case DataKind::Optional:
      wire::encode(sink, value.size() != 0);
      if (value.size() != 0) {
        put(value[0], sink);
      }
      break;
    case DataKind::Pair:
      put(value.first(), sink);
      put(value.second(), sink);
      break;
    case DataKind::List:
      put_list(value, sink);
      break;
    case DataKind::Struct:
      for (const DataField& field : value.type->fields) {
        put(value.member(field), sink);
      }
      break;
    default:
      sink.put(value.at, value.type->size);
  }
}

/// Reads values from untrusted bytes, which may be damaged.
class SceneDecoder {
 public:
  explicit SceneDecoder(std::string_view bytes) : decoder_(bytes) {}

  wire::Decoder& decoder() { return decoder_; }
  bool is_done() const { return is_sound_ && decoder_.is_done(); }

  void read(DataRef value) {
    if (value.type->is_flat) {
      decoder_.take(value.at, value.type->size);
      return;
    }
    switch (value.kind()) {
      case DataKind::Flag:
        value.as<bool>() = decoder_.flag();
        break;
      case DataKind::Word:
        read_word(value);
        break;
      case DataKind::Text:
        decoder_.read(value.as<std::string>());
        break;
      case DataKind::Path:
        read_path(value.as<Path>());
        break;
      case DataKind::Optional:
        if (decoder_.flag()) {
          value.resize(1);
          read(value[0]);
        }
        break;
      case DataKind::Pair:
        read(value.first());
        read(value.second());
        break;
      case DataKind::List:
        read_list(value);
        break;
      case DataKind::Struct:
        for (const DataField& field : value.type->fields) {
          read(value.member(field));
        }
        break;
      default:
        decoder_.take(value.at, value.type->size);
    }
  }

 private:
  void read_word(DataRef value) {
    decoder_.take(value.at, value.type->size);
    if (enumerator_of(value) >= value.type->words.size()) {
      std::memset(value.at, 0, value.type->size);
      is_sound_ = false;
    }
  }

  void read_path(Path& path) {
    std::string text;
    decoder_.read(text);
    if (text.empty() || !decoder_.is_sound()) {
      return;
    }
    if (const Result<Path> parsed = Path::parse(text)) {
      path = *parsed;
    } else {
      is_sound_ = false;
    }
  }

  void read_list(DataRef list) {
    const DataType& item = *list.type->item;
    const std::size_t count = decoder_.count(item.wire_size);
    list.resize(count);
    if (item.is_flat) {
      decoder_.take(count == 0 ? nullptr : list[0].at, count * item.size);
      return;
    }
    for (std::size_t i = 0; i < count && decoder_.is_sound() && is_sound_; ++i) {
      read(list[i]);
    }
  }

  wire::Decoder decoder_;
  bool is_sound_ = true;
};

std::uint64_t form_digest() {
  static const std::uint64_t digest = [] {
    std::string form;
    add_form(data_type<PhysicsScene>(), form);
    return content_digest(form);
  }();
  return digest;
}

}  // namespace

std::string wire_form(const PhysicsScene& scene) {
  wire::StringSink sink;
  sink.put(kMagic.data(), kMagic.size());
  wire::encode(sink, form_digest());
  put(view_of(scene), sink);
  return std::move(sink.bytes);
}

Result<PhysicsScene> read_wire_form(std::string_view bytes) {
  if (bytes.substr(0, kMagic.size()) != kMagic) {
    return Error(ErrorCode::Corrupt, "these bytes are not a physics scene");
  }
  SceneDecoder decoder(bytes.substr(kMagic.size()));
  std::uint64_t form = 0;
  decoder.decoder().read(form);
  if (decoder.decoder().is_sound() && form != form_digest()) {
    return Error(ErrorCode::Unsupported, "a build with other fields wrote this physics scene")
        .with_fix("write and read it with the same version of tenon");
  }
  PhysicsScene scene;
  decoder.read(ref_to(scene));
  if (!decoder.is_done()) {
    return Error(ErrorCode::Corrupt, "the bytes of this physics scene are damaged");
  }
  TENON_CHECK(check_scene(scene));
  return scene;
}

std::uint64_t scene_hash(const PhysicsScene& scene) { return content_digest(wire_form(scene)); }

std::uint64_t mesh_hash(const TriangleMesh& mesh) {
  wire::StringSink sink;
  put(view_of(mesh), sink);
  return content_digest(sink.bytes);
}

}  // namespace tenon::scene
