// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/mutants/zip_parts.h"

#include <array>

#include "tenon/bytes/byte_writer.h"

namespace tenon::fuzz {
namespace {

constexpr std::size_t kAlignment = 64;

std::array<std::uint32_t, 256> crc_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t value = i;
    for (int bit = 0; bit < 8; ++bit) {
      value = (value >> 1) ^ ((value & 1) != 0 ? 0xedb88320u : 0u);
    }
    table[i] = value;
  }
  return table;
}

/// What both headers have, from the flags to the length of the name.
void write_claims(bytes::ByteWriter& out, const ZipPart& part, const ZipClaims& claims,
                  std::uint32_t crc) {
  const auto size = part.wide ? ~0u : static_cast<std::uint32_t>(part.bytes.size());
  out.write(claims.flags.value_or(std::uint16_t{0}));
  out.write(claims.method.value_or(std::uint16_t{0}));
  out.write(std::uint32_t{0x00210000});  // the first day that a zip file can name
  out.write(claims.crc.value_or(crc));
  out.write(claims.packed_size.value_or(size));
  out.write(claims.plain_size.value_or(size));
  out.write(static_cast<std::uint16_t>(claims.name.value_or(part.name).size()));
}

/// Both sizes in 64 bits, as an extra field; nothing where they are not asked for.
std::string wide_sizes(const ZipPart& part) {
  bytes::ByteWriter out;
  if (part.wide) {
    out.write(std::uint16_t{1});
    out.write(std::uint16_t{16});
    out.write(*part.wide);
    out.write(*part.wide);
  }
  return out.take();
}

/// The directory's record of 64 bits, and where that is.
void write_wide_end(bytes::ByteWriter& out, std::uint64_t count, std::uint64_t size,
                    std::uint64_t offset) {
  const std::uint64_t place = out.bytes().size();
  out.write(std::uint32_t{0x06064b50});
  out.write(std::uint64_t{44});
  out.write(std::uint32_t{0x002d002d});
  out.write(std::uint64_t{0});  // disks
  out.write(count);
  out.write(count);
  out.write(size);
  out.write(offset);
  out.write(std::uint32_t{0x07064b50});
  out.write(std::uint32_t{0});
  out.write(place);
  out.write(std::uint32_t{1});
}

void write_local(bytes::ByteWriter& out, const ZipPart& part) {
  const std::string& name = part.local.name.value_or(part.name);
  out.write(std::uint32_t{0x04034b50});
  out.write(std::uint16_t{10});
  write_claims(out, part, part.local, crc32(part.bytes));
  const std::string wide = wide_sizes(part);
  const std::size_t here = out.bytes().size() + 2 + name.size() + wide.size();
  const std::size_t padding = (kAlignment - (here + 4) % kAlignment) % kAlignment + part.extra;
  out.write(static_cast<std::uint16_t>(wide.size() + 4 + padding));
  out.write_text(name);
  out.write_text(wide);
  out.write(std::uint16_t{0x1986});
  out.write(static_cast<std::uint16_t>(padding));
  out.write_text(std::string(padding, '\0'));
  out.write_text(part.bytes);
}

void write_central(bytes::ByteWriter& out, const ZipPart& part, std::uint32_t offset) {
  out.write(std::uint32_t{0x02014b50});
  out.write(std::uint16_t{10});
  out.write(std::uint16_t{10});
  write_claims(out, part, part.central, crc32(part.bytes));
  const std::string wide = wide_sizes(part);
  out.write(static_cast<std::uint16_t>(wide.size()));
  out.write(std::uint16_t{0});  // no comment, disk 0, no attributes
  out.write(std::uint64_t{0});
  out.write(part.offset.value_or(offset));
  out.write_text(part.central.name.value_or(part.name));
  out.write_text(wide);
}

}  // namespace

std::uint32_t crc32(std::string_view bytes) {
  static const std::array<std::uint32_t, 256> kTable = crc_table();
  std::uint32_t crc = ~0u;
  for (const char c : bytes) {
    crc = kTable[(crc ^ static_cast<unsigned char>(c)) & 0xff] ^ (crc >> 8);
  }
  return ~crc;
}

std::string put_together(const ZipParts& zip) {
  bytes::ByteWriter out;
  std::vector<std::uint32_t> offsets;
  for (const ZipPart& part : zip.parts) {
    offsets.push_back(static_cast<std::uint32_t>(out.bytes().size()));
    write_local(out, part);
  }
  const auto directory = static_cast<std::uint32_t>(out.bytes().size());
  for (std::size_t i = 0; i < zip.parts.size(); ++i) {
    write_central(out, zip.parts[i], offsets[i]);
  }
  const auto size = static_cast<std::uint32_t>(out.bytes().size()) - directory;
  const auto count = zip.count.value_or(static_cast<std::uint16_t>(zip.parts.size()));
  if (zip.wide_offset) {
    write_wide_end(out, count, size, *zip.wide_offset);
  }
  out.write(std::uint32_t{0x06054b50});
  out.write(std::uint32_t{0});
  out.write(count);
  out.write(count);
  out.write(zip.directory_size.value_or(size));
  out.write(zip.directory_offset.value_or(zip.wide_offset ? ~0u : directory));
  out.write(static_cast<std::uint16_t>(zip.comment.size()));
  out.write_text(zip.comment);
  return out.bytes();
}

}  // namespace tenon::fuzz
