// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bytes/lz4_block.h"

#include <algorithm>
#include <cstdint>
#include <memory>

#include <lz4.h>

#include "tenon/base/limits/limits.h"
#include "tenon/bytes/byte_reader.h"

namespace tenon::bytes {
namespace {

constexpr std::size_t kChunk = LZ4_MAX_INPUT_SIZE;

Error corrupt() {
  return Error(ErrorCode::Corrupt, "compressed data are damaged").with_rule("file.lz4-damaged");
}

/// Appends one block to `out`, which may grow to `max_size`.
Result<void> append_block(std::span<const std::byte> block, std::size_t max_size,
                          std::string& out) {
  const std::size_t room =
      std::min({max_size - out.size(), kChunk,
                block.size() * static_cast<std::size_t>(limits::kDecompressionRatio)});
  if (block.size() > kChunk + kChunk / 255 + 16) {
    return corrupt();
  }
  // Not cleared: most of the room is never touched, and then costs no memory.
  const auto plain = std::make_unique_for_overwrite<char[]>(room);
  const int made = LZ4_decompress_safe(reinterpret_cast<const char*>(block.data()), plain.get(),
                                       static_cast<int>(block.size()), static_cast<int>(room));
  if (made < 0) {
    return corrupt();
  }
  out.append(plain.get(), static_cast<std::size_t>(made));
  return {};
}

void append_compressed(std::span<const std::byte> plain, bool with_size, std::string& out) {
  const int bound = LZ4_compressBound(static_cast<int>(plain.size()));
  const std::size_t head = out.size();
  const std::size_t start = head + (with_size ? sizeof(std::int32_t) : 0);
  out.resize(start + static_cast<std::size_t>(bound));
  const std::int32_t made =
      LZ4_compress_default(reinterpret_cast<const char*>(plain.data()), out.data() + start,
                           static_cast<int>(plain.size()), bound);
  out.resize(start + static_cast<std::size_t>(made));
  if (with_size) {
    std::copy_n(reinterpret_cast<const char*>(&made), sizeof(made), out.data() + head);
  }
}

}  // namespace

Result<std::string> lz4_decompress(std::span<const std::byte> compressed, std::size_t max_size) {
  ByteReader in(compressed);
  TENON_TRY(const std::uint8_t chunk_count, in.read<std::uint8_t>());
  std::string out;
  if (chunk_count == 0) {
    TENON_TRY(const auto block, in.take(in.remaining()));
    TENON_CHECK(append_block(block, max_size, out));
    return out;
  }
  for (unsigned i = 0; i < chunk_count; ++i) {
    TENON_TRY(const std::int32_t size, in.read<std::int32_t>());
    if (size < 0) {
      return corrupt();
    }
    TENON_TRY(const auto block, in.take(static_cast<std::uint64_t>(size)));
    TENON_CHECK(append_block(block, max_size, out));
  }
  return out;
}

std::string lz4_compress(std::span<const std::byte> plain) {
  std::string out(1, '\0');
  if (plain.size() <= kChunk) {
    append_compressed(plain, false, out);
    return out;
  }
  out[0] = static_cast<char>((plain.size() + kChunk - 1) / kChunk);
  for (std::size_t at = 0; at < plain.size(); at += kChunk) {
    append_compressed(plain.subspan(at, std::min(kChunk, plain.size() - at)), true, out);
  }
  return out;
}

}  // namespace tenon::bytes
