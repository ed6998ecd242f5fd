// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "tenon/formats/text/layout/source_map.h"
#include "tenon/formats/text/text_scanner.h"

/// The words of statements in text that is known to be a layer's, without their meaning.
namespace tenon::formats::text {

inline constexpr std::size_t kNowhere = std::string_view::npos;

/// The statement of a prim, variant or property, as far as its metadata.
struct StatementText {
  SourceRange range;                ///< without metadata and braces
  SourceRange type;                 ///< empty where none is written
  std::string name;                 ///< of the prim, variant or property
  std::string_view suffix;          ///< of a property: "timeSamples", "connect", ...
  SourceRange value;                ///< empty where there is none
  std::size_t metadata = kNowhere;  ///< of the '('
  bool takes_away = false;          ///< `delete` or `reorder`
};

/// The statement of a prim or a variant that begins at `offset`.
std::optional<StatementText> block_statement(std::string_view text, std::size_t offset);
/// The same of an attribute or relationship.
std::optional<StatementText> property_statement(std::string_view text, std::size_t offset);
/// The parentheses of the layer itself; kNowhere when there are none.
std::size_t layer_metadata(std::string_view text);

/// Behind the statement and its metadata.
std::size_t end_of(std::string_view text, const StatementText& statement);

/// One statement in parentheses.
struct MetadataText {
  SourceRange range;
  std::string_view word;  ///< empty for a comment
  SourceRange value;
  bool takes_away = false;
};

/// Takes the next statement of the parentheses that the scanner is in; nothing at their end.
std::optional<MetadataText> take_metadata(std::string_view text, Scanner& scanner);

/// One entry of a dictionary, of time samples or of relocates.
struct EntryText {
  SourceRange range;
  std::string key;  ///< without quotes
  SourceRange value;
};

/// Takes the next entry of the braces that the scanner is in; nothing at their end.
std::optional<EntryText> take_entry(std::string_view text, Scanner& scanner);

/// Takes a value, of references and payloads without their parentheses; empty when none is there.
SourceRange take_value(std::string_view text, Scanner& scanner);

/// Takes the next item of the brackets that the scanner is in, and what separates it from the one
/// behind it; nothing at their end.
std::optional<SourceRange> take_item(std::string_view text, Scanner& scanner);

/// Where the item of this number, from 0 on, of the list or single value at `begin` stands; `begin`
/// when there is none.
std::size_t offset_of_item(std::string_view text, std::size_t begin, std::size_t number);

/// A string without its quotes; other text as it is.
std::string unquoted(std::string_view text);

}  // namespace tenon::formats::text
