// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// No file can hold the digest of all of its bytes, so a file's own digest is taken with zeros in
// its place. That place is found in the bytes without parsing: behind the file's name in text, by
// the form of the comment in XML, behind a mark of 64 bits in binary layers. The digest of a zip
// archive is made of its entries, because the archive holds checksums over the note.
#include "tenon/structure/written_note.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <optional>

#include "tenon/base/content_digest.h"
#include "tenon/base/text/comma_list.h"
#include "tenon/bytes/file_bytes.h"
#include "tenon/bytes/read_record.h"
#include "tenon/bytes/zip/zip_archive.h"
#include "tenon/formats/open_layer.h"
#include "tenon/layer/dictionary.h"
#include "tenon/layer/fields.h"
#include "tenon/structure/digest_text.h"
#include "tenon/structure/xml_note.h"

namespace tenon::structure {
namespace {

namespace fs = std::filesystem;
namespace fields = layer::fields;
using layer::Dictionary;
using layer::Value;

constexpr const char* kTool = "tenon";
constexpr const char* kWritten = "written";
constexpr const char* kSelf = "self";
/// Stands before the digest in binary layers, so that its place is found in their bytes.
constexpr std::int64_t kMark = 0x5e1f9d1e57a3c06b;

Value own_value(std::uint64_t digest) {
  return Value(layer::Array<std::int64_t>{kMark, static_cast<std::int64_t>(digest)});
}

const Dictionary* note_of(const layer::Layer& layer) {
  const auto* data = layer.root().get<Dictionary>(fields::customLayerData);
  const Value* tool = data == nullptr ? nullptr : data->find(kTool);
  const auto* own = tool == nullptr ? nullptr : tool->get<Dictionary>();
  const Value* written = own == nullptr ? nullptr : own->find(kWritten);
  return written == nullptr ? nullptr : written->get<Dictionary>();
}

/// Calls `change` on tenon's own part of customLayerData.
template <class Change>
void change_note(layer::Layer& layer, Change change) {
  Dictionary data = layer.root().get_or(fields::customLayerData, Dictionary());
  const Value* known = data.find(kTool);
  Dictionary tool = known == nullptr ? Dictionary() : known->get_or(Dictionary());
  change(tool);
  if (tool.empty()) {
    data.items.erase(kTool);
  } else {
    data.items.insert_or_assign(kTool, Value(std::move(tool)));
  }
  if (data.empty()) {
    layer.root().erase(fields::customLayerData);
  } else {
    layer.root().set(fields::customLayerData, Value(std::move(data)));
  }
}

/// The place of the own digest in the bytes of a layer, and its length.
struct Place {
  std::size_t at = 0;
  std::size_t size = 0;
};

std::optional<Place> place_of_digest(std::string_view contents, const std::string& own) {
  if (contents.starts_with("PXR-USDC")) {
    std::array<char, sizeof kMark> mark{};
    std::memcpy(mark.data(), &kMark, sizeof kMark);
    const std::size_t at = contents.find(std::string_view(mark.data(), mark.size()));
    const bool found = at != std::string_view::npos && at + 16 <= contents.size();
    return found ? std::optional(Place{at + 8, 8}) : std::nullopt;
  }
  if (holds_xml_note(contents)) {
    const auto note = xml_note_of(contents);
    return note ? std::optional(Place{note->own_at, kDigestDigits}) : std::nullopt;
  }
  const std::string start = "string \"" + own + "\" = \"";
  const std::size_t at = contents.find(start);
  const bool found =
      at != std::string_view::npos && at + start.size() + kDigestDigits <= contents.size();
  return found ? std::optional(Place{at + start.size(), kDigestDigits}) : std::nullopt;
}

std::uint64_t masked_digest(std::string_view contents, const std::string& own) {
  const std::optional<Place> place = place_of_digest(contents, own);
  if (!place) {
    return content_digest(contents);
  }
  std::string masked(contents);
  masked.replace(place->at, place->size, place->size, '0');
  return content_digest(masked);
}

std::optional<std::uint64_t> noted_digest(const Dictionary& note, const std::string& name) {
  const Value* value = note.find(name);
  if (value == nullptr) {
    return std::nullopt;
  }
  if (const auto* numbers = value->get<layer::Array<std::int64_t>>()) {
    return numbers->size() == 2 ? std::optional(static_cast<std::uint64_t>((*numbers)[1]))
                                : std::nullopt;
  }
  return digest_from(value->get_or(std::string()));
}

std::shared_ptr<const bytes::FileBytes> contents_of(const std::string& file) {
  bytes::FileRules rules;
  rules.is_input = false;
  return bytes::FileBytes::open(file, rules).value_or(nullptr);
}

Dictionary dictionary_of(const XmlNote& xml) {
  Dictionary note;
  for (const auto& [name, digest] : xml.others) {
    note.items.insert_or_assign(name, Value(hex_of(digest)));
  }
  note.items.insert_or_assign(kSelf, Value(hex_of(xml.own)));
  return note;
}

/// The note in the bytes of a file, as a copy.
std::optional<Dictionary> note_in(std::shared_ptr<const bytes::FileBytes> contents,
                                  const std::string& file) {
  if (holds_xml_note(contents->text())) {
    const auto xml = xml_note_of(contents->text());
    return xml ? std::optional(dictionary_of(*xml)) : std::nullopt;
  }
  Diagnostics ignored;
  const auto layer = formats::read_layer(std::move(contents), file, ignored);
  const Dictionary* note = layer ? note_of(*layer) : nullptr;
  return note == nullptr ? std::nullopt : std::optional(*note);
}

Error edited(const std::string& file, const WrittenState& state) {
  return Error(ErrorCode::Invalid,
               state.noted
                   ? "the asset was edited since it was written: " + comma_list(state.edited) +
                         (state.edited.size() == 1 ? " differs" : " differ")
                   : std::string("there is a file already, and it does not say that it is "
                                 "as this program has written it"))
      .in_file(file)
      .with_rule("output.edited")
      .with_fix("give --force to overwrite it, or name another place");
}

}  // namespace

void add_note(layer::Layer& layer, const std::string& own, const Digests& others,
              formats::LayerFormat format) {
  Dictionary note;
  for (const auto& [name, digest] : others) {
    note.items.insert_or_assign(name, Value(hex_of(digest)));
  }
  if (format == formats::LayerFormat::Text) {
    note.items.insert_or_assign(own, Value(std::string(kDigestDigits, '0')));
  } else {
    note.items.insert_or_assign(kSelf, own_value(0));
  }
  change_note(layer, [&](Dictionary& tool) {
    tool.items.insert_or_assign(kWritten, Value(std::move(note)));
  });
}

void remove_note(layer::Layer& layer) {
  if (note_of(layer) != nullptr) {
    change_note(layer, [](Dictionary& tool) { tool.items.erase(kWritten); });
  }
}

void set_own_digest(layer::Layer& layer, std::uint64_t digest) {
  const Dictionary* known = note_of(layer);
  Dictionary note = known == nullptr ? Dictionary() : *known;
  note.items.insert_or_assign(kSelf, own_value(digest));
  change_note(layer, [&](Dictionary& tool) {
    tool.items.insert_or_assign(kWritten, Value(std::move(note)));
  });
}

std::uint64_t own_digest(std::string_view contents, const std::string& own) {
  if (!bytes::ZipArchive::is_zip(contents)) {
    return masked_digest(contents, own);
  }
  auto archive = bytes::ZipArchive::open(bytes::FileBytes::own(std::string(contents)));
  std::string digests;
  for (std::size_t i = 0; archive && i < archive->entries().size(); ++i) {
    const bytes::ZipEntry& entry = archive->entries()[i];
    const auto inside = archive->read(entry);
    const std::string_view text = inside ? (*inside)->text() : std::string_view();
    digests += entry.name + hex_of(i == 0 ? masked_digest(text, own) : content_digest(text));
  }
  return content_digest(digests);
}

void seal(std::string& contents, const std::string& own) {
  const std::optional<Place> place = place_of_digest(contents, own);
  if (!place) {
    return;
  }
  contents.replace(place->at, place->size, place->size, '0');
  const std::uint64_t digest = content_digest(contents);
  if (place->size == kDigestDigits) {
    contents.replace(place->at, place->size, hex_of(digest));
  } else {
    std::memcpy(contents.data() + place->at, &digest, sizeof digest);
  }
}

std::optional<std::uint64_t> noted_own_digest(std::string_view contents, const std::string& own) {
  const std::optional<Place> place = place_of_digest(contents, own);
  if (!place) {
    return std::nullopt;
  }
  if (place->size == kDigestDigits) {
    return digest_from(contents.substr(place->at, place->size));
  }
  std::uint64_t digest = 0;
  std::memcpy(&digest, contents.data() + place->at, sizeof digest);
  return digest;
}

Digests noted_digests(const layer::Layer& layer, const std::string& own) {
  Digests digests;
  const Dictionary* note = note_of(layer);
  for (const auto& [name, value] : note == nullptr ? Dictionary().items : note->items) {
    const auto digest = noted_digest(*note, name);
    if (digest && name != own && name != kSelf) {
      digests.emplace(name, *digest);
    }
  }
  return digests;
}

void copy_note(const layer::Layer& from, layer::Layer& layer) {
  const Dictionary* note = note_of(from);
  change_note(layer, [&](Dictionary& tool) {
    tool.items.erase(kWritten);
    if (note != nullptr) {
      tool.items.insert_or_assign(kWritten, Value(*note));
    }
  });
}

WrittenState written_state(const std::string& file) {
  WrittenState state;
  const auto contents = contents_of(file);
  const auto note = contents == nullptr ? std::nullopt : note_in(contents, file);
  const std::string own = fs::path(file).filename().string();
  const std::string self = note && note->find(kSelf) != nullptr ? kSelf : own;
  if (!note || note->find(self) == nullptr) {
    return state;
  }
  state.noted = true;
  for (const auto& [name, value] : note->items) {
    const bool is_self = name == self;
    const std::string shown = is_self ? own : name;
    const auto other =
        is_self ? contents : contents_of((fs::path(file).parent_path() / name).string());
    const bool same =
        other != nullptr && noted_digest(*note, name) == (is_self ? own_digest(other->text(), own)
                                                                  : content_digest(other->text()));
    (same ? state.written : state.edited).push_back(shown);
  }
  return state;
}

std::string noted_description(std::string text, const Digests& others) {
  std::string contents = with_xml_note(std::move(text), others);
  seal(contents, {});
  return contents;
}

std::string copy_place(const std::string& opening) { return ".tenon/" + opening + ".base"; }

bool is_copy_place(std::string_view name) {
  return name.starts_with(".tenon/") && name.ends_with(".base");
}

Result<void> check_not_edited(const std::string& file, const Digests& beside) {
  std::error_code error;
  WrittenState state;
  if (fs::is_regular_file(file, error)) {
    state = written_state(file);
    if (!state.noted || !state.edited.empty()) {
      return edited(file, state);
    }
  }
  std::vector<std::string> strange;
  for (const auto& [name, digest] : beside) {
    const auto there = contents_of((fs::path(file).parent_path() / name).string());
    const bool known =
        std::find(state.written.begin(), state.written.end(), name) != state.written.end();
    if (there != nullptr && !known && content_digest(there->text()) != digest) {
      strange.push_back(name);
    }
  }
  if (strange.empty()) {
    return {};
  }
  return Error(ErrorCode::Invalid,
               "files that were not written with it are in the way: " + comma_list(strange))
      .in_file(file)
      .with_rule("output.unknown")
      .with_fix("name another place, or give --force to overwrite them");
}

}  // namespace tenon::structure
