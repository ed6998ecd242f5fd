// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/crate/tables.h"

#include <array>
#include <cstring>
#include <string_view>

#include "tenon/base/limits.h"
#include "tenon/bytes/integer_coding.h"
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
        return corrupt("section " + name_of(section) + " leaves the file");
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

Result<std::vector<Token>> read_tokens(bytes::ByteReader in, std::uint64_t file_size) {
  if (in.size() == 0) {
    return std::vector<Token>();
  }
  TENON_TRY(const std::uint64_t count, in.read<std::uint64_t>());
  TENON_TRY(const std::uint64_t plain_size, in.read<std::uint64_t>());
  TENON_TRY(const std::uint64_t packed_size, in.read<std::uint64_t>());
  TENON_TRY(const auto packed, in.take(packed_size));
  if (plain_size > limits::kCrateTextBase + file_size * limits::kCrateTextPerByte ||
      count > limits::kCrateRowsBase + file_size / limits::kCrateBytesPerRow ||
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
  TENON_TRY(const std::uint64_t count, read_row_count(in, file));
  TENON_TRY(const std::vector<std::uint32_t> names, read_packed<std::uint32_t>(in, count));
  TENON_TRY(const std::uint64_t words_size, in.read<std::uint64_t>());
  TENON_TRY(const auto packed, in.take(words_size));
  TENON_TRY(const std::string words,
            bytes::lz4_decompress(packed, names.size() * sizeof(ValueWord)));
  if (words.size() != names.size() * sizeof(ValueWord)) {
    return corrupt("the table of fields ends too early");
  }
  std::vector<FieldRow> fields(names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] >= file.tokens.size()) {
      return corrupt("a field's name is not there");
    }
    fields[i].name = file.tokens[names[i]];
    std::memcpy(&fields[i].value, words.data() + i * sizeof(ValueWord), sizeof(ValueWord));
  }
  return fields;
}

Result<std::vector<std::uint32_t>> read_field_sets(bytes::ByteReader in, const CrateFile& file,
                                                   std::size_t field_count) {
  if (in.size() == 0) {
    return std::vector<std::uint32_t>();
  }
  TENON_TRY(const std::uint64_t count, read_row_count(in, file));
  TENON_TRY(std::vector<std::uint32_t> sets, read_packed<std::uint32_t>(in, count));
  for (const std::uint32_t field : sets) {
    if (field != kEndOfSet && field >= field_count) {
      return corrupt("a set of fields names a field that is not there");
    }
  }
  if (!sets.empty() && sets.back() != kEndOfSet) {
    return corrupt("the table of field sets ends too early");
  }
  return sets;
}

/// The specs in the order of `path_order`: neighbours in the tree are neighbours in memory.
/// ErrorCode::Corrupt when a path has two.
Result<std::vector<SpecRow>> sorted_by_path(const std::vector<SpecRow>& specs,
                                            const Tables& tables) {
  constexpr std::uint32_t kNone = 0xffffffffu;
  std::vector<std::uint32_t> spec_of_path(tables.paths.size(), kNone);
  for (std::size_t i = 0; i < specs.size(); ++i) {
    if (spec_of_path[specs[i].path] != kNone) {
      return corrupt("there are two specs at " + tables.paths[specs[i].path].str());
    }
    spec_of_path[specs[i].path] = static_cast<std::uint32_t>(i);
  }
  std::vector<SpecRow> sorted;
  sorted.reserve(specs.size());
  for (const std::uint32_t path : tables.path_order) {
    if (spec_of_path[path] != kNone) {
      sorted.push_back(specs[spec_of_path[path]]);
    }
  }
  return sorted;
}

Result<Tables> read_sections(const Contents& contents, std::shared_ptr<CrateFile> file) {
  const bytes::FileBytes& bytes = *file->bytes;
  Tables tables;
  TENON_TRY(file->tokens, read_tokens(contents.section("TOKENS", bytes), bytes.size()));
  TENON_TRY(file->strings, read_strings(contents.section("STRINGS", bytes), file->tokens.size()));
  TENON_TRY(tables.fields, read_fields(contents.section("FIELDS", bytes), *file));
  TENON_TRY(tables.field_sets,
            read_field_sets(contents.section("FIELDSETS", bytes), *file, tables.fields.size()));
  tables.path_section = contents.section("PATHS", bytes);
  tables.spec_section = contents.section("SPECS", bytes);
  tables.file = std::move(file);
  return tables;
}

}  // namespace

Result<std::uint64_t> read_row_count(bytes::ByteReader& in, const CrateFile& file) {
  TENON_TRY(const std::uint64_t count, in.read<std::uint64_t>());
  if (count > limits::kCrateRowsBase + file.bytes->size() / limits::kCrateBytesPerRow) {
    return corrupt("a table claims " + std::to_string(count) + " rows in a file of " +
                   std::to_string(file.bytes->size()) + " bytes");
  }
  return count;
}

template <class T>
Result<std::vector<T>> read_packed(bytes::ByteReader& in, std::uint64_t count) {
  TENON_TRY(const std::uint64_t size, in.read<std::uint64_t>());
  TENON_TRY(const auto packed, in.take(size));
  return bytes::decode_integers<T>(packed, count);
}

template Result<std::vector<std::int32_t>> read_packed(bytes::ByteReader&, std::uint64_t);
template Result<std::vector<std::uint32_t>> read_packed(bytes::ByteReader&, std::uint64_t);
template Result<std::vector<std::int64_t>> read_packed(bytes::ByteReader&, std::uint64_t);
template Result<std::vector<std::uint64_t>> read_packed(bytes::ByteReader&, std::uint64_t);

Result<void> read_specs(Tables& tables) {
  bytes::ByteReader in = tables.spec_section;
  if (in.size() == 0) {
    return {};
  }
  TENON_TRY(const std::uint64_t count, read_row_count(in, *tables.file));
  TENON_TRY(const std::vector<std::uint32_t> paths, read_packed<std::uint32_t>(in, count));
  TENON_TRY(const std::vector<std::uint32_t> sets, read_packed<std::uint32_t>(in, count));
  TENON_TRY(const std::vector<std::uint32_t> kinds, read_packed<std::uint32_t>(in, count));
  std::vector<SpecRow> specs(paths.size());
  for (std::size_t i = 0; i < specs.size(); ++i) {
    const bool starts_run = sets[i] < tables.field_sets.size() &&
                            (sets[i] == 0 || tables.field_sets[sets[i] - 1] == kEndOfSet);
    if (paths[i] >= tables.paths.size() || tables.paths[paths[i]].empty() || !starts_run ||
        kinds[i] == 0 || kinds[i] >= std::size(kSpecKinds)) {
      return corrupt("spec " + std::to_string(i) +
                     " has an impossible path, kind or set of fields");
    }
    specs[i] = {paths[i], sets[i], kSpecKinds[kinds[i]]};
  }
  TENON_TRY(tables.specs, sorted_by_path(specs, tables));
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
