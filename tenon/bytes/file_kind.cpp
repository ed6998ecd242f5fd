// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The tests go from sure to unsure, and the first that holds decides. Marks come first: fixed bytes
// at a fixed place. Formats with a weak mark or none follow, told by header fields that have to
// make sense, then zip files by the name of their first entry, then texts by the first word behind
// comments. A name is never looked at, and the time is at most linear in the bytes.
#include "tenon/bytes/file_kind.h"

#include <algorithm>
#include <cstddef>
#include <initializer_list>

#include "tenon/bytes/read_policy.h"
#include "tenon/bytes/shape_file.h"

namespace tenon::bytes {
namespace {

using namespace std::string_view_literals;

/// Bytes at an offset that say what a file is.
struct Mark {
  FileKind kind;
  std::size_t offset;
  std::string_view bytes;
};

constexpr std::string_view kPng = "\x89PNG\r\n\x1a\n"sv;

constexpr Mark kMarks[] = {
    {FileKind::Image, 0, kPng},
    {FileKind::Image, 0, "\xff\xd8\xff"sv},      // JPEG
    {FileKind::Image, 0, "\x76\x2f\x31\x01"sv},  // OpenEXR
    {FileKind::Image, 0, "#?RADIANCE"sv},
    {FileKind::Image, 0, "#?RGBE"sv},
    {FileKind::Image, 0, "GIF87a"sv},
    {FileKind::Image, 0, "GIF89a"sv},
    {FileKind::Image, 8, "WEBP"sv},   // behind RIFF
    {FileKind::Image, 0, "II*\0"sv},  // TIFF
    {FileKind::Image, 0, "MM\0*"sv},
    {FileKind::Image, 0, "II+\0"sv},  // BigTIFF
    {FileKind::Image, 0, "MM\0+"sv},
    {FileKind::Image, 0, "\xabKTX 11\xbb\r\n\x1a\n"sv},
    {FileKind::Image, 0, "\xabKTX 20\xbb\r\n\x1a\n"sv},
    {FileKind::Image, 0, "DDS \x7c\0\0\0"sv},
    {FileKind::Image, 0, "8BPS\0\x01"sv},  // Photoshop
    {FileKind::Image, 0, "Ptex\x01\0\0\0"sv},
    {FileKind::Image, 0, "\0\0\0\x0cjP  \r\n\x87\n"sv},  // JPEG 2000
    {FileKind::Image, 0, "\0\0\0\x0cJXL \r\n\x87\n"sv},  // JPEG XL
    {FileKind::Image, 0, "\x13\xab\xa1\x5c"sv},          // ASTC
    {FileKind::Image, 0, "SDPX"sv},                      // DPX
    {FileKind::Image, 0, "XPDS"sv},
    {FileKind::Image, 4, "ftypavif"sv},
    {FileKind::Image, 4, "ftypavis"sv},
    {FileKind::Image, 4, "ftypheic"sv},
    {FileKind::Image, 4, "ftypmif1"sv},
    {FileKind::Sound, 4, "ftypM4A"sv},
    {FileKind::Sound, 4, "ftypmp4"sv},
    {FileKind::Sound, 4, "ftypisom"sv},
    {FileKind::Sound, 8, "WAVEfmt "sv},  // behind RIFF
    {FileKind::Sound, 0, "ID3"sv},
    {FileKind::Sound, 0, "OggS\0"sv},
    {FileKind::Sound, 0, "fLaC\0"sv},
    {FileKind::Volume, 0, "\x20\x42\x44\x56\0\0\0\0"sv},  // OpenVDB
    {FileKind::Shader, 0, "-- glslfx version "sv},
    {FileKind::Shader, 0, "OpenShadingLanguage "sv},
    {FileKind::Light, 0, "IESNA"sv},
    {FileKind::Layer, 0, "#usda "sv},
    {FileKind::Layer, 0, "#sdf "sv},
    {FileKind::Layer, 0, "PXR-USDC"sv},
};

unsigned byte_at(std::string_view bytes, std::size_t at) {
  return static_cast<unsigned char>(bytes[at]);
}
unsigned short_at(std::string_view bytes, std::size_t at) {
  return byte_at(bytes, at) + 256 * byte_at(bytes, at + 1);
}

/// TGA begins with no mark: its header has to make sense, and there must be room for the pixels
/// (Truevision TGA 2.0, fields 1 to 5).
bool is_tga(std::string_view bytes) {
  constexpr std::size_t kHeader = 18;
  if (bytes.size() < kHeader) {
    return false;
  }
  const unsigned map = byte_at(bytes, 1);
  const unsigned type = byte_at(bytes, 2);
  const unsigned depth = byte_at(bytes, 16);
  const bool packed = type >= 9 && type <= 11;
  const unsigned plain = packed ? type - 8 : type;
  const bool known_depth = depth == 8 || depth == 15 || depth == 16 || depth == 24 || depth == 32;
  const std::size_t width = short_at(bytes, 12);
  const std::size_t height = short_at(bytes, 14);
  if (map > 1 || plain < 1 || plain > 3 || (plain == 1) != (map == 1) || !known_depth ||
      width == 0 || height == 0 || (byte_at(bytes, 17) & 0xc0u) != 0) {
    return false;
  }
  const std::size_t entry = map == 0 ? 0 : (byte_at(bytes, 7) + 7) / 8;
  const std::size_t before = kHeader + byte_at(bytes, 0) + entry * short_at(bytes, 5);
  const std::size_t pixel = (depth + 7) / 8;
  const std::size_t least =
      packed ? (width * height + 127) / 128 * (1 + pixel) : width * height * pixel;
  return bytes.size() >= before + least;
}

/// A zip file that begins with a layer, as packages of USD do and documents of offices do not.
bool is_package(std::string_view bytes) {
  constexpr std::size_t kHeader = 30;
  if (!bytes.starts_with("PK\x03\x04") || bytes.size() < kHeader) {
    return false;
  }
  const std::string_view name = bytes.substr(kHeader, short_at(bytes, 26));
  const std::size_t dot = name.rfind('.');
  const std::string_view ending = dot == std::string_view::npos ? "" : name.substr(dot);
  return ending == ".usd" || ending == ".usda" || ending == ".usdc" || ending == ".usdz";
}

/// "BM", the size of the file and that of the next header, which there are few of.
bool is_bmp(std::string_view bytes) {
  return bytes.starts_with("BM") && bytes.size() >= 26 && short_at(bytes, 16) == 0 &&
         short_at(bytes, 14) >= 12 && short_at(bytes, 14) <= 124 && short_at(bytes, 6) == 0;
}

/// Portable anymaps in binary form: "P4" to "P6", a blank, then the width or a comment; "P7" and
/// the word WIDTH.
bool is_anymap(std::string_view bytes) {
  if (bytes.size() < 9 || bytes[0] != 'P' || (bytes[2] != '\n' && bytes[2] != ' ')) {
    return false;
  }
  const bool is_number = bytes[3] >= '0' && bytes[3] <= '9';
  return bytes[1] == '7' ? bytes.substr(3, 5) == "WIDTH"
                         : bytes[1] >= '4' && bytes[1] <= '6' && (is_number || bytes[3] == '#');
}

/// A frame of MPEG audio: layer, rate and frequency are not reserved.
bool is_mpeg_audio(std::string_view bytes) {
  return bytes.size() > 4 && byte_at(bytes, 0) == 0xff && (byte_at(bytes, 1) & 0xe6u) == 0xe2u &&
         (byte_at(bytes, 2) >> 4) != 15 && (byte_at(bytes, 2) >> 4) != 0 &&
         (byte_at(bytes, 2) & 0x0cu) != 0x0cu;
}

std::string_view without_blanks(std::string_view text) {
  const std::size_t at = text.find_first_not_of(" \t\r\n");
  return at == std::string_view::npos ? std::string_view() : text.substr(at);
}

std::string_view without_byte_order(std::string_view text) {
  return text.starts_with("\xef\xbb\xbf") ? text.substr(3) : text;
}

/// Text that may precede the part that identifies a file's kind: a comment and the like.
struct Aside {
  std::string_view begin;
  std::string_view end;
};

/// The text behind blanks and asides; empty where one of them does not end.
std::string_view behind(std::string_view text, std::initializer_list<Aside> asides) {
  text = without_blanks(without_byte_order(text));
  while (true) {
    const Aside* aside = std::find_if(asides.begin(), asides.end(), [&](const Aside& one) {
      return text.starts_with(one.begin);
    });
    if (aside == asides.end()) {
      return text;
    }
    const std::size_t end = text.find(aside->end, aside->begin.size());
    if (end == std::string_view::npos) {
      return {};
    }
    text = without_blanks(text.substr(end + aside->end.size()));
  }
}

/// XML whose root element is <materialx>, told by what is in front of it.
bool is_materialx(std::string_view text) {
  constexpr std::size_t kLookedAt = 65536;
  return behind(text.substr(0, kLookedAt), {{"<!--", "-->"}, {"<?", ">"}, {"<!", ">"}})
      .starts_with("<materialx");
}

Error wrong_kind(const std::string& path, const char* what, const char* fix) {
  return Error(ErrorCode::Invalid, "@" + path + "@ is " + what)
      .with_rule(kWrongKindRule)
      .with_fix(fix);
}

}  // namespace

bool is_png(std::string_view bytes) { return bytes.starts_with(kPng); }

bool is_mdl(std::string_view text) {
  text = behind(text, {{"//", "\n"}, {"/*", "*/"}});
  if (!text.starts_with("mdl ") && !text.starts_with("mdl\t")) {
    return false;
  }
  text = without_blanks(text.substr(4));
  const std::size_t dot = text.find_first_not_of("0123456789");
  return dot != 0 && dot != std::string_view::npos && text[dot] == '.' && text.size() > dot + 1 &&
         text[dot + 1] >= '0' && text[dot + 1] <= '9';
}

FileKind kind_of(std::string_view bytes) {
  const auto mark = std::find_if(std::begin(kMarks), std::end(kMarks), [&](const Mark& one) {
    return bytes.size() > one.offset && bytes.substr(one.offset).starts_with(one.bytes) &&
           (one.offset != 8 || bytes.starts_with("RIFF"));
  });
  if (mark != std::end(kMarks)) {
    return mark->kind;
  }
  if (is_tga(bytes) || is_bmp(bytes) || is_anymap(bytes)) {
    return FileKind::Image;
  }
  if (is_mpeg_audio(bytes)) {
    return FileKind::Sound;
  }
  if (is_package(bytes)) {
    return FileKind::Package;
  }
  if (is_mdl(bytes) || is_materialx(bytes)) {
    return FileKind::Shader;
  }
  return is_shape_file(bytes) ? FileKind::Shape : FileKind::Unknown;
}

Error not_read(const std::string& path, Error error) {
  if (error.diagnostic().rule == kOutsideRule) {
    return error;
  }
  return Error(error.code(), "@" + path + "@ cannot be read: " + error.message())
      .with_rule(kUnreadableRule)
      .with_fix("name a file that can be read");
}

Error not_media(const std::string& path) {
  return wrong_kind(path,
                    "neither an image nor a sound, a volume, a module of a material, a light "
                    "profile, a mesh or a layer",
                    "name a file that is what the asset uses it as");
}

Error not_a_layer(const std::string& path) {
  return wrong_kind(path, "named as a layer and is none", "name a file of USD");
}

Error not_nameable(const std::string& path) {
  return Error(ErrorCode::Invalid, "@" + path + "@ has characters that no asset path may have: " +
                                       "control characters, or bytes that are not UTF-8")
      .with_rule(kUnreadableRule)
      .with_fix("give the file another name");
}

}  // namespace tenon::bytes
