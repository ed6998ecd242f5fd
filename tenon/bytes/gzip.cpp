// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bytes/gzip.h"

#include <algorithm>
#include <limits>

#include "tenon/base/shared_library.h"

#if TENON_WITH_ZLIB
#include <zlib.h>
#endif

namespace tenon::bytes {

#if TENON_WITH_ZLIB
namespace {

constexpr int kWindowAndGzip = 15 + 16;
constexpr int kMemory = 9;

struct Zlib {
  int (*begin)(z_streamp, int, int, int, int, int, const char*, int) = nullptr;
  int (*go_on)(z_streamp, int) = nullptr;
  int (*end)(z_streamp) = nullptr;
  bool complete = false;
};

const Zlib& zlib() {
  static const Zlib found = [] {
    const SharedLibrary library = SharedLibrary::open({"libz.so.1"});
    Zlib all;
    all.complete = library.find("deflateInit2_", all.begin) && library.find("deflate", all.go_on) &&
                   library.find("deflateEnd", all.end);
    return all;
  }();
  return found;
}

}  // namespace

std::optional<std::string> gzipped(std::string_view bytes) {
  z_stream stream{};
  if (!zlib().complete ||
      zlib().begin(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, kWindowAndGzip, kMemory,
                   Z_DEFAULT_STRATEGY, ZLIB_VERSION, static_cast<int>(sizeof(stream))) != Z_OK) {
    return std::nullopt;
  }
  std::string result;
  std::string part(1u << 16, '\0');
  constexpr std::size_t kMost = std::numeric_limits<uInt>::max();
  int status = Z_OK;
  do {
    if (stream.avail_in == 0) {
      const std::size_t next = std::min(bytes.size(), kMost);
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
      stream.avail_in = static_cast<uInt>(next);
      bytes.remove_prefix(next);
    }
    stream.next_out = reinterpret_cast<Bytef*>(part.data());
    stream.avail_out = static_cast<uInt>(part.size());
    status = zlib().go_on(&stream, bytes.empty() ? Z_FINISH : Z_NO_FLUSH);
    result.append(part, 0, part.size() - stream.avail_out);
  } while (status == Z_OK || status == Z_BUF_ERROR);
  zlib().end(&stream);
  return status == Z_STREAM_END ? std::optional(std::move(result)) : std::nullopt;
}
#else
std::optional<std::string> gzipped(std::string_view) { return std::nullopt; }
#endif

std::string seven_bit_text(std::string_view bytes) {
  std::string text;
  text.reserve(bytes.size() * 6 / 5);
  const auto add = [&text](unsigned value) {
    if (value == 0 || value == '\r' || value == '<') {
      const unsigned other = 256 + value;
      text += static_cast<char>(0xc0u | other >> 6);
      text += static_cast<char>(0x80u | (other & 0x3fu));
    } else {
      text += static_cast<char>(value);
    }
  };
  unsigned held = 0;
  unsigned count = 0;
  for (const char byte : bytes) {
    held = held << 8 | static_cast<unsigned char>(byte);
    count += 8;
    while (count >= 7) {
      count -= 7;
      add(held >> count & 0x7fu);
    }
  }
  if (count > 0) {
    add(held << (7 - count) & 0x7fu);
  }
  return text;
}

}  // namespace tenon::bytes
