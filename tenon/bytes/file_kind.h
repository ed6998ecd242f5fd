// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "tenon/base/error.h"

/// What a file is by its bytes, whatever it is called. What an asset names as a texture goes into
/// an output only where it is one.
namespace tenon::bytes {

enum class FileKind : std::uint8_t {
  Unknown,
  Image,    ///< PNG, JPEG, OpenEXR, Radiance, TGA, BMP, GIF, WebP, TIFF, KTX, DDS, AVIF, ...
  Sound,    ///< WAV, MP3, MPEG-4, Ogg, FLAC
  Volume,   ///< OpenVDB
  Shader,   ///< MDL, MaterialX, glslfx, compiled OSL
  Light,    ///< IES LM-63
  Shape,    ///< STL, OBJ, MuJoCo's meshes, height fields and skins
  Layer,    ///< a layer of USD, text or crate
  Package,  ///< a zip file with a layer in front
};

FileKind kind_of(std::string_view bytes);
/// The one format of images that MuJoCo reads.
bool is_png(std::string_view bytes);
/// A module of NVIDIA's Material Definition Language: "mdl 1.7;" behind comments.
bool is_mdl(std::string_view text);

/// The rule of an error about a file whose contents do not match its name.
inline constexpr const char* kWrongKindRule = "read.wrong-kind";
/// The rule of an error about a file that is there and cannot be read: a folder, a pipe.
inline constexpr const char* kUnreadableRule = "read.unreadable";
/// `error`, which opening `path` gave, as one of those of read_policy.h or under kUnreadableRule.
Error not_read(const std::string& path, Error error);

/// Invalid, rule kWrongKindRule: `path` is nothing that a scene shows or plays.
Error not_media(const std::string& path);
/// The same: `path` is no layer and no package.
Error not_a_layer(const std::string& path);
/// Invalid, rule kUnreadableRule: the characters of `path` are not allowed in an asset path.
Error not_nameable(const std::string& path);

}  // namespace tenon::bytes
