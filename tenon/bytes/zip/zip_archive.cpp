// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Layout: local headers with their data, then the central directory, then its end record, which
// begins at most 65535 bytes (a comment) before the end of the file. Where its numbers are too
// small, a locator right before it says where the end record of 64 bits is (APPNOTE.TXT 6.3.10 of
// PKWARE, 4.3.14 to 4.3.16 and 4.5.3). Sorted by place, each entry must end before the next begins,
// so no bytes count twice and a small file cannot unpack to a large one. Contents are slices of the
// file and are not copied.
#include "tenon/bytes/zip/zip_archive.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <set>

#include "tenon/base/limits/reading_limits.h"
#include "tenon/bytes/byte_reader.h"
#include "tenon/bytes/byte_writer.h"

namespace tenon::bytes {
namespace {

constexpr std::uint32_t kLocalSignature = 0x04034b50;
constexpr std::uint32_t kCentralSignature = 0x02014b50;
constexpr std::uint32_t kEndSignature = 0x06054b50;
constexpr std::uint32_t kEnd64Signature = 0x06064b50;
constexpr std::uint32_t kLocator64Signature = 0x07064b50;
constexpr std::size_t kLocator64Size = 20;
constexpr std::uint16_t kField64 = 1;            // id of the extra field with numbers of 64 bits
constexpr std::uint32_t kIn64Bits = 0xffffffff;  // the number is in the extra field
constexpr std::size_t kLocalSize = 30;
constexpr std::size_t kCentralSize = 46;
constexpr std::size_t kEndSize = 22;
constexpr std::size_t kAlignment = 64;
constexpr std::uint16_t kPaddingField = 0x1986;  // id of the extra field that OpenUSD pads with
constexpr std::uint16_t kVersion = 10;
constexpr std::uint16_t kDate = 0x21;  // 1980-01-01, the earliest; packages carry no dates

Error damaged(std::string message) {
  return Error(ErrorCode::Corrupt, std::move(message))
      .with_rule("package.damaged")
      .with_fix("copy or download the file again");
}

struct EndRecord {
  std::uint64_t entry_count = 0;
  std::uint64_t directory = 0;
};

/// The end record of 64 bits, by the locator before the short end record at `end`.
Result<EndRecord> read_end_record_64(const FileBytes& bytes, std::size_t end) {
  if (end < kLocator64Size) {
    return damaged("the 64-bit table of contents of the zip file is missing");
  }
  ByteReader in(bytes.span());
  TENON_CHECK(in.seek(end - kLocator64Size));
  TENON_TRY(const auto locator, in.read<std::uint32_t>());
  TENON_CHECK(in.take(4));
  TENON_TRY(const auto offset, in.read<std::uint64_t>());
  if (locator != kLocator64Signature || offset > end) {
    return damaged("the 64-bit table of contents of the zip file is missing");
  }
  TENON_CHECK(in.seek(offset));
  TENON_TRY(const auto signature, in.read<std::uint32_t>());
  if (signature != kEnd64Signature) {
    return damaged("the 64-bit table of contents of the zip file is damaged");
  }
  EndRecord record;
  TENON_CHECK(in.seek(offset + 32));
  TENON_TRY(record.entry_count, in.read<std::uint64_t>());
  TENON_CHECK(in.take(8));
  TENON_TRY(record.directory, in.read<std::uint64_t>());
  if (record.directory > end || record.entry_count > (end - record.directory) / kCentralSize) {
    return damaged("the 64-bit table of contents of the zip file is damaged");
  }
  return record;
}

Result<EndRecord> read_end_record(const FileBytes& bytes) {
  if (bytes.size() < kEndSize) {
    return damaged("too short for a zip file");
  }
  const std::string_view text = bytes.text();
  const char signature[] = {'P', 'K', 5, 6};
  const std::size_t at = text.rfind(std::string_view(signature, 4), text.size() - kEndSize);
  if (at == std::string_view::npos || text.size() - at > kEndSize + 0xffff) {
    return damaged("the table of contents of the zip file is missing");
  }
  ByteReader in(bytes.span());
  EndRecord end;
  TENON_CHECK(in.seek(at + 10));
  TENON_TRY(const auto entry_count, in.read<std::uint16_t>());
  TENON_CHECK(in.take(4));
  TENON_TRY(const auto directory, in.read<std::uint32_t>());
  if (entry_count == 0xffff || directory == kIn64Bits) {
    return read_end_record_64(bytes, at);
  }
  end.entry_count = entry_count;
  end.directory = directory;
  return end;
}

#pragma pack(push, 1)
struct CentralHeader {
  std::uint32_t signature;
  std::uint16_t made_by;
  std::uint16_t needed;
  std::uint16_t flags;
  std::uint16_t method;
  std::uint16_t time;
  std::uint16_t date;
  std::uint32_t crc;
  std::uint32_t compressed_size;
  std::uint32_t size;
  std::uint16_t name_size;
  std::uint16_t extra_size;
  std::uint16_t comment_size;
  std::uint16_t disk;
  std::uint16_t internal;
  std::uint32_t external;
  std::uint32_t header;
};
struct LocalHeader {
  std::uint32_t signature;
  std::uint16_t needed;
  std::uint16_t flags;
  std::uint16_t method;
  std::uint16_t time;
  std::uint16_t date;
  std::uint32_t crc;
  std::uint32_t compressed_size;
  std::uint32_t size;
  std::uint16_t name_size;
  std::uint16_t extra_size;
};
#pragma pack(pop)
static_assert(sizeof(CentralHeader) == kCentralSize && sizeof(LocalHeader) == kLocalSize);

/// Reads the numbers in the extra field of 64 bits; it holds only those that do not fit, in this
/// order.
Result<void> read_field_64(ByteReader& extra, const CentralHeader& header, ZipEntry& entry) {
  while (extra.remaining() >= 4) {
    TENON_TRY(const auto id, extra.read<std::uint16_t>());
    TENON_TRY(const auto size, extra.read<std::uint16_t>());
    TENON_TRY(const auto content, extra.take(size));
    if (id != kField64) {
      continue;
    }
    ByteReader in(content);
    if (header.size == kIn64Bits) {
      TENON_CHECK(in.take(8));
    }
    if (header.compressed_size == kIn64Bits) {
      TENON_TRY(entry.size, in.read<std::uint64_t>());
    }
    if (header.header == kIn64Bits) {
      TENON_TRY(entry.header, in.read<std::uint64_t>());
    }
    return {};
  }
  return damaged("the 64-bit table of contents of the zip file is damaged");
}

Result<ZipEntry> read_central_header(ByteReader& in) {
  TENON_TRY(const CentralHeader header, in.read<CentralHeader>());
  if (header.signature != kCentralSignature) {
    return damaged("the table of contents of the zip file is damaged");
  }
  TENON_TRY(const auto name, in.take(header.name_size));
  TENON_TRY(const auto extra, in.take(header.extra_size));
  TENON_CHECK(in.take(header.comment_size));
  ZipEntry entry;
  entry.name.assign(reinterpret_cast<const char*>(name.data()), name.size());
  entry.header = header.header;
  entry.size = header.compressed_size;
  entry.crc = header.crc;
  entry.method = header.method;
  entry.encrypted = (header.flags & 1u) != 0;
  if (header.size == kIn64Bits || header.compressed_size == kIn64Bits ||
      header.header == kIn64Bits) {
    ByteReader numbers(extra);
    TENON_CHECK(read_field_64(numbers, header, entry));
  }
  return entry;
}

using CrcTables = std::array<std::array<std::uint32_t, 256>, 8>;

/// Table k takes a byte that k further bytes follow.
const CrcTables& crc_tables() {
  static const CrcTables tables = [] {
    CrcTables made{};
    for (std::uint32_t i = 0; i < 256; ++i) {
      std::uint32_t value = i;
      for (int bit = 0; bit < 8; ++bit) {
        value = (value >> 1) ^ ((value & 1u) != 0 ? 0xedb88320u : 0u);
      }
      made[0][i] = value;
    }
    for (std::size_t k = 1; k < made.size(); ++k) {
      for (std::size_t i = 0; i < 256; ++i) {
        const std::uint32_t before = made[k - 1][i];
        made[k][i] = (before >> 8) ^ made[0][before & 0xffu];
      }
    }
    return made;
  }();
  return tables;
}

/// Eight bytes at a time, as their tables are independent of each other.
std::uint32_t crc32(std::string_view data) {
  const CrcTables& tables = crc_tables();
  std::uint32_t crc = 0xffffffffu;
  for (; data.size() >= 8; data.remove_prefix(8)) {
    std::array<std::uint32_t, 2> words;
    std::memcpy(words.data(), data.data(), 8);
    words[0] ^= crc;
    crc = 0;
    for (std::size_t k = 0; k < 8; ++k) {
      crc ^= tables[7 - k][words[k / 4] >> (8 * (k % 4)) & 0xffu];
    }
  }
  for (const char c : data) {
    crc = tables[0][(crc ^ static_cast<unsigned char>(c)) & 0xffu] ^ (crc >> 8);
  }
  return ~crc;
}

/// Bytes of the extra field that bring data after a header at `offset` to an aligned place; 0 or
/// at least the four of its own head.
std::size_t padding(std::size_t offset, std::size_t name_size) {
  const std::size_t rest = (offset + kLocalSize + name_size) % kAlignment;
  if (rest == 0) {
    return 0;
  }
  const std::size_t missing = kAlignment - rest;
  return missing < 4 ? missing + kAlignment : missing;
}

void write_local(const ZipFile& file, const CentralHeader& header, ByteWriter& out) {
  const std::size_t extra = padding(out.offset(), file.name.size());
  const LocalHeader local{kLocalSignature,
                          kVersion,
                          0,
                          0,
                          0,
                          kDate,
                          header.crc,
                          header.size,
                          header.size,
                          header.name_size,
                          static_cast<std::uint16_t>(extra)};
  out.write(local);
  out.write_text(file.name);
  if (extra != 0) {
    out.write(kPaddingField);
    out.write(static_cast<std::uint16_t>(extra - 4));
    out.write_text(std::string(extra - 4, '\0'));
  }
  out.write_text(file.contents);
}

Result<void> check_files(const std::vector<ZipFile>& files) {
  std::set<std::string_view> names;
  std::uint64_t total = 0;
  for (const ZipFile& file : files) {
    if (file.name.empty() || file.name.size() > 0xffff || !names.insert(file.name).second) {
      return Error(ErrorCode::Invalid, "cannot name a file of a package \"" + file.name + "\"")
          .with_rule("package.bad-name");
    }
    total += file.contents.size() + 2 * (file.name.size() + kAlignment + sizeof(CentralHeader));
  }
  if (total > std::numeric_limits<std::uint32_t>::max() || files.size() >= 0xffff) {
    return Error(ErrorCode::Limit, "a package holds at most 4 GiB and 65534 files")
        .with_rule("package.too-large");
  }
  return {};
}

}  // namespace

bool ZipArchive::is_zip(std::string_view bytes) {
  return bytes.starts_with(std::string_view("PK\x03\x04", 4)) ||
         bytes.starts_with(std::string_view("PK\x05\x06", 4));
}

Result<ZipArchive> ZipArchive::open(std::shared_ptr<const FileBytes> bytes) {
  ZipArchive archive;
  TENON_TRY(const EndRecord end, read_end_record(*bytes));
  ByteReader in(bytes->span());
  TENON_CHECK(in.seek(end.directory));
  for (std::uint64_t i = 0; i < end.entry_count; ++i) {
    TENON_TRY(ZipEntry entry, read_central_header(in));
    archive.entries_.push_back(std::move(entry));
  }
  TENON_CHECK(archive.check_order(end.directory));
  archive.bytes_ = std::move(bytes);
  return archive;
}

/// Sorts the entries by place and sees that each has one, and a name, of its own. An entry that
/// shares bytes with others would make a small file a large one.
Result<void> ZipArchive::check_order(std::uint64_t directory) {
  std::stable_sort(entries_.begin(), entries_.end(),
                   [](const ZipEntry& a, const ZipEntry& b) { return a.header < b.header; });
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    ZipEntry& entry = entries_[i];
    entry.end = i + 1 < entries_.size() ? entries_[i + 1].header : directory;
    const std::uint64_t head = kLocalSize + entry.name.size();
    if (entry.end < entry.header || entry.end - entry.header < head ||
        entry.end - entry.header - head < entry.size) {
      return damaged("\"" + entry.name + "\" overlaps the next entry of the zip file");
    }
    names.push_back(entry.name);
  }
  std::sort(names.begin(), names.end());
  const auto twice = std::adjacent_find(names.begin(), names.end());
  return twice == names.end() ? Result<void>()
                              : damaged("the zip file has \"" + std::string(*twice) + "\" twice");
}

const ZipEntry* ZipArchive::find(std::string_view name) const {
  const auto it = std::find_if(entries_.begin(), entries_.end(),
                               [&](const ZipEntry& entry) { return entry.name == name; });
  return it == entries_.end() ? nullptr : &*it;
}

namespace {

/// What an entry's own header says of it, where it says it: sizes and check sum may come later.
bool agrees(const LocalHeader& header, std::string_view name, const ZipEntry& entry) {
  constexpr std::uint16_t kComesLater = 8;
  const bool later = (header.flags & kComesLater) != 0;
  const bool long_size = header.compressed_size == kIn64Bits;
  return name == entry.name && header.method == entry.method &&
         ((header.flags & 1u) != 0) == entry.encrypted &&
         (later ||
          (header.crc == entry.crc && (long_size || header.compressed_size == entry.size)));
}

}  // namespace

Result<std::shared_ptr<const FileBytes>> ZipArchive::contents_of(const ZipEntry& entry) const {
  if (entry.encrypted || entry.method != 0) {
    return Error(ErrorCode::Unsupported, "\"" + entry.name + "\" is " +
                                             (entry.encrypted ? "encrypted" : "compressed") +
                                             "; packages hold plain files only")
        .with_rule("package.not-stored")
        .with_fix("pack it again without compression, for example with usdzip");
  }
  ByteReader in(bytes_->span());
  TENON_CHECK(in.seek(entry.header));
  TENON_TRY(const LocalHeader header, in.read<LocalHeader>());
  if (header.signature != kLocalSignature) {
    return damaged("\"" + entry.name + "\" is not where the table of contents says");
  }
  TENON_TRY(const auto name, in.take(header.name_size));
  const std::string_view own(reinterpret_cast<const char*>(name.data()), name.size());
  if (!agrees(header, own, entry)) {
    return damaged("\"" + entry.name + "\" is something else than the table of contents says");
  }
  TENON_CHECK(in.take(header.extra_size));
  const std::size_t start = in.offset();
  if (start > entry.end || entry.end - start < entry.size) {
    return damaged("\"" + entry.name + "\" overlaps the next entry of the zip file");
  }
  TENON_CHECK(in.take(entry.size));
  return FileBytes::slice(bytes_, start, static_cast<std::size_t>(entry.size));
}

Result<std::shared_ptr<const FileBytes>> ZipArchive::read(const ZipEntry& entry) const {
  return entry.size <= limits::kCheckedEntryBytes ? read_checked(entry) : contents_of(entry);
}

Result<std::shared_ptr<const FileBytes>> ZipArchive::read_checked(const ZipEntry& entry) const {
  TENON_TRY(auto contents, contents_of(entry));
  if (crc32(contents->text()) != entry.crc) {
    return damaged("the contents of \"" + entry.name + "\" are not those of its check sum");
  }
  return contents;
}

Result<std::string> write_zip(const std::vector<ZipFile>& files) {
  TENON_CHECK(check_files(files));
  ByteWriter out;
  ByteWriter directory;
  for (const ZipFile& file : files) {
    CentralHeader header{};
    header.signature = kCentralSignature;
    header.made_by = kVersion;
    header.needed = kVersion;
    header.date = kDate;
    header.crc = crc32(file.contents);
    header.compressed_size = static_cast<std::uint32_t>(file.contents.size());
    header.size = header.compressed_size;
    header.name_size = static_cast<std::uint16_t>(file.name.size());
    header.header = static_cast<std::uint32_t>(out.offset());
    directory.write(header);
    directory.write_text(file.name);
    write_local(file, header, out);
  }
  const auto start = static_cast<std::uint32_t>(out.offset());
  const auto count = static_cast<std::uint16_t>(files.size());
  out.write_text(directory.bytes());
  out.write(kEndSignature);
  out.write(std::uint32_t{0});  // disk numbers
  out.write(count);
  out.write(count);
  out.write(static_cast<std::uint32_t>(directory.offset()));
  out.write(start);
  out.write(std::uint16_t{0});  // comment
  return out.take();
}

}  // namespace tenon::bytes
