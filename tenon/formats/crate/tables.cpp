// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Nothing in the file is trusted. A section is a window that lies within the file, a table may have
// no more rows than a constant and the size of the file allow, which is checked before memory is
// taken, and every index is checked when its row is read. Users of the tables need no checks of
// their own. Specs come after the paths, which path_tree.cpp reads: each is noted under its path,
// which finds doubles.
#include "tenon/formats/crate/tables.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <span>
#include <string_view>

#include "tenon/base/limits/crate_limits.h"
#include "tenon/base/limits/limits.h"
#include "tenon/bytes/lz4_block.h"

namespace tenon::formats::crate {
namespace {

std::string version_text(const Version& version) {
  return std::to_string(version.major) + "." + std::to_string(version.minor) + "." +
         std::to_string(version.patch);
}

Result<Version> check_version(const Bootstrap& bootstrap) {
  const Version version{bootstrap.version[0], bootstrap.version[1], bootstrap.version[2]};
  const bool too_new = version.major != kNewestRead.major || version.minor > kNewestRead.minor;
  if (version < kOldestRead || too_new) {
    return Error(ErrorCode::Unsupported, "binary layers of version " + version_text(version) +
                                             " cannot be read, only " + version_text(kOldestRead) +
                                             " to " + version_text(kNewestRead))
        .with_rule("crate.version")
        .with_fix(version < kOldestRead ? "convert the file with a release of OpenUSD before 26.08"
                                        : "save the file as text");
  }
  return version;
}

/// The table of contents: where the sections that matter start.
class Contents {
 public:
  static Result<Contents> read(bytes::ByteReader in, std::int64_t offset) {
    if (offset < static_cast<std::int64_t>(sizeof(Bootstrap))) {
      return corrupt("the table of contents is at an impossible place");
    }
    TENON_CHECK(in.seek(static_cast<std::uint64_t>(offset)));
    TENON_TRY(const std::uint64_t count, in.read<std::uint64_t>());
    Contents contents;
    TENON_TRY(contents.sections_, in.read_array<Section>(count));
    for (const Section& section : contents.sections_) {
      const auto size = static_cast<std::int64_t>(in.size());
      if (section.start < 0 || section.size < 0 || section.start > size ||
          section.size > size - section.start) {
        return corrupt("section " + name_of(section) + " reaches beyond the end of the file");
      }
    }
    return contents;
  }

  /// A reader of the section's bytes alone; of nothing when there is no such section.
  bytes::ByteReader section(std::string_view name, const bytes::FileBytes& bytes) const {
    for (const Section& section : sections_) {
      if (name_of(section) == name) {
        return bytes::ByteReader(bytes.span().subspan(static_cast<std::size_t>(section.start),
                                                      static_cast<std::size_t>(section.size)));
      }
    }
    return bytes::ByteReader({});
  }

 private:
  static std::string name_of(const Section& section) {
    return {section.name, strnlen(section.name, sizeof(section.name))};
  }

  std::vector<Section> sections_;
};

Result<std::vector<Token>> read_tokens(bytes::ByteReader in) {
  if (in.size() == 0) {
    return std::vector<Token>();
  }
  TENON_TRY(const std::uint64_t count, in.read<std::uint64_t>());
  TENON_TRY(const std::uint64_t plain_size, in.read<std::uint64_t>());
  TENON_TRY(const std::uint64_t packed_size, in.read<std::uint64_t>());
  TENON_TRY(const auto packed, in.take(packed_size));
  // Two tokens that differ need a byte between them that LZ4 does not copy, or the end of a copy.
  if (count > limits::kCrateTokens + packed.size() * limits::kCrateTokensPerByte ||
      count > plain_size) {
    return corrupt("the table of tokens is larger than its data");
  }
  if (count == 0) {
    return std::vector<Token>();
  }
  TENON_TRY(const std::string text,
            bytes::lz4_decompress(packed, static_cast<std::size_t>(plain_size)));
  std::vector<Token> tokens;
  tokens.reserve(static_cast<std::size_t>(count));
  std::string_view left = text;
  while (tokens.size() < count) {
    const std::size_t end = left.find('\0');
    if (end == std::string_view::npos) {
      return corrupt("the table of tokens ends too early");
    }
    tokens.emplace_back(left.substr(0, end));
    left.remove_prefix(end + 1);
  }
  return tokens;
}

Result<std::vector<std::uint32_t>> read_strings(bytes::ByteReader in, std::size_t token_count) {
  if (in.size() == 0) {
    return std::vector<std::uint32_t>();
  }
  TENON_TRY(const std::uint64_t count, in.read<std::uint64_t>());
  TENON_TRY(std::vector<std::uint32_t> strings, in.read_array<std::uint32_t>(count));
  for (const std::uint32_t token : strings) {
    if (token >= token_count) {
      return corrupt("a string names a token that is not there");
    }
  }
  return strings;
}

Result<std::vector<FieldRow>> read_fields(bytes::ByteReader in, const CrateFile& file) {
  if (in.size() == 0) {
    return std::vector<FieldRow>();
  }
  TENON_TRY(const std::uint64_t count, read_row_count(in, file, limits::kCrateFields));
  TENON_TRY(auto names, open_packed<std::uint32_t>(in, count));
  TENON_TRY(const std::uint64_t words_size, in.read<std::uint64_t>());
  TENON_TRY(const auto packed, in.take(words_size));
  const auto size = static_cast<std::size_t>(count);
  TENON_TRY(const std::string words, bytes::lz4_decompress(packed, size * sizeof(ValueWord)));
  if (words.size() != size * sizeof(ValueWord)) {
    return corrupt("the table of fields ends too early");
  }
  std::vector<FieldRow> fields(size);
  for (std::size_t i = 0; i < size; ++i) {
    const std::uint32_t name = names.next();
    if (name >= file.tokens.size()) {
      return corrupt("a field's name is not there");
    }
    fields[i].name = file.tokens[name];
    std::memcpy(&fields[i].value, words.data() + i * sizeof(ValueWord), sizeof(ValueWord));
  }
  return fields;
}

Result<std::vector<std::uint32_t>> read_field_sets(bytes::ByteReader in, const CrateFile& file,
                                                   std::size_t field_count) {
  if (in.size() == 0) {
    return std::vector<std::uint32_t>();
  }
  TENON_TRY(const std::uint64_t count, read_row_count(in, file, limits::kCrateFieldSetRows));
  TENON_TRY(auto rows, open_packed<std::uint32_t>(in, count));
  const std::uint64_t max_sets = max_rows(file, limits::kCrateFields);
  std::vector<std::uint32_t> sets;
  sets.reserve(static_cast<std::size_t>(count));
  std::uint64_t ended = 0;
  std::size_t start = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    sets.push_back(rows.next());
    if (sets.back() == kEndOfSet) {
      start = sets.size();
      if (++ended > max_sets) {
        return corrupt("there are more sets of fields than a file of its size can have");
      }
    } else if (sets.back() >= field_count || sets.size() - start > field_count) {
      return corrupt("a set of fields names a field that is not there");
    }
  }
  if (!sets.empty() && sets.back() != kEndOfSet) {
    return corrupt("the table of field sets ends too early");
  }
  return sets;
}

Result<Tables> read_sections(const Contents& contents, std::shared_ptr<CrateFile> file) {
  const bytes::FileBytes& bytes = *file->bytes;
  const bytes::ByteReader tokens = contents.section("TOKENS", bytes);
  const bytes::ByteReader fields = contents.section("FIELDS", bytes);
  const bytes::ByteReader sets = contents.section("FIELDSETS", bytes);
  Tables tables;
  TENON_TRY(file->tokens, read_tokens(tokens));
  bytes.let_go(tokens.span());
  TENON_TRY(file->strings, read_strings(contents.section("STRINGS", bytes), file->tokens.size()));
  TENON_TRY(tables.fields, read_fields(fields, *file));
  bytes.let_go(fields.span());
  TENON_TRY(tables.field_sets, read_field_sets(sets, *file, tables.fields.size()));
  bytes.let_go(sets.span());
  tables.path_section = contents.section("PATHS", bytes);
  tables.spec_section = contents.section("SPECS", bytes);
  tables.file = std::move(file);
  return tables;
}

}  // namespace

std::uint64_t max_rows(const CrateFile& file, std::uint64_t base) {
  return base + file.bytes->size() / limits::kCrateBytesPerRow;
}

Result<std::uint64_t> read_row_count(bytes::ByteReader& in, const CrateFile& file,
                                     std::uint64_t base) {
  TENON_TRY(const std::uint64_t count, in.read<std::uint64_t>());
  if (count > max_rows(file, base)) {
    return corrupt("a table claims " + std::to_string(count) + " rows in a file of " +
                   std::to_string(file.bytes->size()) + " bytes");
  }
  return count;
}

template <class T>
Result<bytes::IntegerStream<T>> open_packed(bytes::ByteReader& in, std::uint64_t count) {
  TENON_TRY(const std::uint64_t size, in.read<std::uint64_t>());
  TENON_TRY(const auto packed, in.take(size));
  return bytes::IntegerStream<T>::open(packed, count);
}

template Result<bytes::IntegerStream<std::int32_t>> open_packed(bytes::ByteReader&, std::uint64_t);
template Result<bytes::IntegerStream<std::uint32_t>> open_packed(bytes::ByteReader&, std::uint64_t);
template Result<bytes::IntegerStream<std::int64_t>> open_packed(bytes::ByteReader&, std::uint64_t);
template Result<bytes::IntegerStream<std::uint64_t>> open_packed(bytes::ByteReader&, std::uint64_t);

namespace {

/// What row `at` says, noted by its path.
Result<void> note_spec(const Tables& tables, std::uint64_t at, std::uint32_t path,
                       std::uint32_t set, std::uint32_t kind, ZeroedArray<SpecRow>& specs) {
  const bool starts_run =
      set < tables.field_sets.size() && (set == 0 || tables.field_sets[set - 1] == kEndOfSet);
  if (path >= tables.paths.size() || tables.paths[path].empty() || !starts_run || kind == 0 ||
      kind >= std::size(kSpecKinds)) {
    return corrupt("spec " + std::to_string(at) + " has an impossible path, kind or set of fields");
  }
  if (specs[path].kind != layer::SpecKind::None) {
    return corrupt("there are two specs at " + tables.paths[path].str());
  }
  specs[path] = {set, kSpecKinds[kind]};
  return {};
}

}  // namespace

Result<void> read_specs(Tables& tables) {
  TENON_TRY(tables.specs, ZeroedArray<SpecRow>::make(tables.paths.size()));
  bytes::ByteReader in = tables.spec_section;
  if (in.size() == 0) {
    return {};
  }
  TENON_TRY(const std::uint64_t count, read_row_count(in, *tables.file, limits::kCrateRows));
  TENON_TRY(auto path_rows, open_packed<std::uint32_t>(in, count));
  TENON_TRY(auto set_rows, open_packed<std::uint32_t>(in, count));
  TENON_TRY(auto kind_rows, open_packed<std::uint32_t>(in, count));
  constexpr std::size_t kBlock = 256;
  std::array<std::uint32_t, kBlock> paths;
  std::array<std::uint32_t, kBlock> sets;
  std::array<std::uint32_t, kBlock> kinds;
  for (std::uint64_t start = 0; start < count; start += kBlock) {
    const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(kBlock, count - start));
    path_rows.read(std::span(paths).first(size));
    set_rows.read(std::span(sets).first(size));
    kind_rows.read(std::span(kinds).first(size));
    for (std::size_t i = 0; i < size; ++i) {
      TENON_CHECK(note_spec(tables, start + i, paths[i], sets[i], kinds[i], tables.specs));
    }
  }
  return {};
}

Result<Tables> read_tables(std::shared_ptr<const bytes::FileBytes> bytes) {
  bytes::ByteReader in(bytes->span());
  TENON_TRY(const Bootstrap bootstrap, in.read<Bootstrap>());
  if (std::memcmp(bootstrap.magic, kMagic, kMagicSize) != 0) {
    return corrupt("not a binary layer");
  }
  auto file = std::make_shared<CrateFile>();
  TENON_TRY(file->version, check_version(bootstrap));
  TENON_TRY(const Contents contents, Contents::read(in, bootstrap.contents));
  file->bytes = std::move(bytes);
  return read_sections(contents, std::move(file));
}

}  // namespace tenon::formats::crate
