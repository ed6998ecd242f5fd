// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/crate_parts.h"

#include <algorithm>
#include <cstring>
#include <map>

#include "tenon/bytes/byte_reader.h"
#include "tenon/bytes/byte_writer.h"
#include "tenon/bytes/integer_coding.h"
#include "tenon/bytes/lz4_block.h"

namespace tenon::fuzz {
namespace {

using bytes::ByteReader;
using bytes::ByteWriter;
using formats::crate::Bootstrap;
using formats::crate::Section;
using formats::crate::ValueWord;

constexpr std::uint64_t kMaxRows = 1u << 20;

Result<Column> take_column(ByteReader& in, std::uint64_t count) {
  TENON_TRY(const std::uint64_t size, in.read<std::uint64_t>());
  TENON_TRY(const auto packed, in.take(size));
  return bytes::decode_integers<std::uint32_t>(packed, count);
}

Result<std::uint64_t> take_count(ByteReader& in) {
  TENON_TRY(const std::uint64_t count, in.read<std::uint64_t>());
  return count <= kMaxRows ? Result<std::uint64_t>(count)
                           : Error(ErrorCode::Limit, "too many rows to take apart");
}

Result<void> take_tokens(ByteReader in, CrateParts& parts) {
  TENON_TRY(parts.token_count, in.read<std::uint64_t>());
  TENON_TRY(const std::uint64_t plain_size, in.read<std::uint64_t>());
  TENON_TRY(const std::uint64_t packed_size, in.read<std::uint64_t>());
  TENON_TRY(const auto packed, in.take(packed_size));
  TENON_TRY(parts.tokens, bytes::lz4_decompress(packed, std::min(plain_size, kMaxRows)));
  return {};
}

Result<void> take_fields(ByteReader in, CrateParts& parts) {
  TENON_TRY(const std::uint64_t count, take_count(in));
  TENON_TRY(parts.field_names, take_column(in, count));
  TENON_TRY(const std::uint64_t size, in.read<std::uint64_t>());
  TENON_TRY(const auto packed, in.take(size));
  TENON_TRY(const std::string words, bytes::lz4_decompress(packed, count * sizeof(ValueWord)));
  parts.field_words.resize(words.size() / sizeof(ValueWord));
  if (!parts.field_words.empty()) {
    std::memcpy(parts.field_words.data(), words.data(),
                parts.field_words.size() * sizeof(ValueWord));
  }
  return {};
}

Result<void> take_paths(ByteReader in, CrateParts& parts) {
  TENON_TRY(parts.path_count, take_count(in));
  TENON_TRY(const std::uint64_t count, take_count(in));
  TENON_TRY(parts.paths, take_column(in, count));
  TENON_TRY(parts.path_tokens, take_column(in, count));
  TENON_TRY(parts.path_jumps, take_column(in, count));
  return {};
}

Result<void> take_specs(ByteReader in, CrateParts& parts) {
  TENON_TRY(const std::uint64_t count, take_count(in));
  TENON_TRY(parts.spec_paths, take_column(in, count));
  TENON_TRY(parts.spec_sets, take_column(in, count));
  TENON_TRY(parts.spec_kinds, take_column(in, count));
  return {};
}

Result<std::map<std::string, Section>> take_sections(ByteReader in, std::int64_t contents) {
  TENON_CHECK(in.seek(static_cast<std::uint64_t>(contents)));
  TENON_TRY(const std::uint64_t count, in.read<std::uint64_t>());
  TENON_TRY(const std::vector<Section> rows, in.read_array<Section>(count));
  std::map<std::string, Section> sections;
  for (const Section& row : rows) {
    const auto size = static_cast<std::int64_t>(in.size());
    if (row.start < 0 || row.size < 0 || row.start > size || row.size > size - row.start) {
      return formats::crate::corrupt("section");
    }
    sections[std::string(row.name, strnlen(row.name, sizeof(row.name)))] = row;
  }
  return sections;
}

Result<CrateParts> try_take_apart(std::string_view crate) {
  const std::span<const std::byte> all(reinterpret_cast<const std::byte*>(crate.data()),
                                       crate.size());
  ByteReader in(all);
  TENON_TRY(const Bootstrap bootstrap, in.read<Bootstrap>());
  TENON_TRY(auto sections, take_sections(in, bootstrap.contents));
  std::size_t data_end = crate.size();
  for (const auto& [name, section] : sections) {
    data_end = std::min(data_end, static_cast<std::size_t>(section.start));
  }
  const auto section = [&](const char* name) {
    return ByteReader(all.subspan(static_cast<std::size_t>(sections[name].start),
                                  static_cast<std::size_t>(sections[name].size)));
  };
  CrateParts parts;
  std::copy_n(bootstrap.version, 3, parts.version);
  if (data_end > sizeof(Bootstrap)) {
    parts.data = crate.substr(sizeof(Bootstrap), data_end - sizeof(Bootstrap));
  }
  TENON_CHECK(take_tokens(section("TOKENS"), parts));
  ByteReader strings = section("STRINGS");
  TENON_TRY(const std::uint64_t string_count, strings.read<std::uint64_t>());
  TENON_TRY(parts.strings, strings.read_array<std::uint32_t>(string_count));
  TENON_CHECK(take_fields(section("FIELDS"), parts));
  ByteReader sets = section("FIELDSETS");
  TENON_TRY(const std::uint64_t set_count, take_count(sets));
  TENON_TRY(parts.field_sets, take_column(sets, set_count));
  TENON_CHECK(take_paths(section("PATHS"), parts));
  TENON_CHECK(take_specs(section("SPECS"), parts));
  return parts;
}

class CrateAssembly {
 public:
  explicit CrateAssembly(const CrateParts& parts) : parts_(parts) {}

  std::string run() {
    Bootstrap bootstrap{};
    std::memcpy(bootstrap.magic, formats::crate::kMagic, formats::crate::kMagicSize);
    std::copy_n(parts_.version, 3, bootstrap.version);
    out_.write(bootstrap);
    out_.write_text(parts_.data);
    section("TOKENS", [this] { tokens(); });
    section("STRINGS", [this] {
      out_.write(count(1, parts_.strings.size()));
      out_.write_array(std::span(parts_.strings));
    });
    section("FIELDS", [this] { fields(); });
    section("FIELDSETS", [this] {
      out_.write(count(3, parts_.field_sets.size()));
      column(parts_.field_sets);
    });
    section("PATHS", [this] {
      out_.write(count(4, parts_.path_count));
      out_.write(std::uint64_t{parts_.paths.size()});
      column(parts_.paths);
      column(parts_.path_tokens);
      column(parts_.path_jumps);
    });
    section("SPECS", [this] {
      out_.write(count(5, parts_.spec_paths.size()));
      column(parts_.spec_paths);
      column(parts_.spec_sets);
      column(parts_.spec_kinds);
    });
    out_.patch(offsetof(Bootstrap, contents), static_cast<std::int64_t>(out_.offset()));
    out_.write(std::uint64_t{sections_.size()});
    out_.write_array(std::span(std::as_const(sections_)));
    return out_.take();
  }

 private:
  std::uint64_t count(unsigned table, std::uint64_t real) const {
    return parts_.claimed_count && parts_.claiming_table == table ? *parts_.claimed_count : real;
  }
  void sized(const std::string& bytes) {
    out_.write(std::uint64_t{bytes.size()});
    out_.write_text(bytes);
  }
  void column(const Column& column) {
    sized(bytes::encode_integers(std::span<const std::uint32_t>(column)));
  }
  void tokens() {
    out_.write(count(0, parts_.token_count));
    out_.write(std::uint64_t{parts_.tokens.size()});
    sized(bytes::lz4_compress(std::as_bytes(std::span(parts_.tokens))));
  }
  void fields() {
    out_.write(count(2, parts_.field_names.size()));
    column(parts_.field_names);
    sized(bytes::lz4_compress(std::as_bytes(std::span(parts_.field_words))));
  }
  template <class Write>
  void section(const char* name, Write write) {
    Section row{};
    std::strncpy(row.name, name, sizeof(row.name) - 1);
    row.start = static_cast<std::int64_t>(out_.offset());
    write();
    row.size = static_cast<std::int64_t>(out_.offset()) - row.start;
    sections_.push_back(row);
  }

  const CrateParts& parts_;
  ByteWriter out_;
  std::vector<Section> sections_;
};

}  // namespace

std::optional<CrateParts> take_apart(std::string_view crate) {
  Result<CrateParts> parts = try_take_apart(crate);
  return parts ? std::optional(*std::move(parts)) : std::nullopt;
}

std::string put_together(const CrateParts& parts) { return CrateAssembly(parts).run(); }

}  // namespace tenon::fuzz
