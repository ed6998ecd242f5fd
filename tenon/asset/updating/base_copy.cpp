// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Layers are kept in binary form, whatever form they have in the asset: small, and without a writer
// of its own. Meshes would double an asset, so a digest replaces long arrays, as a string that
// begins with a mark; when the copy is read, arrays that are still known come back.
#include "tenon/asset/updating/base_copy.h"

#include <algorithm>
#include <type_traits>
#include <utility>
#include <vector>

#include "tenon/base/content_digest.h"
#include "tenon/bytes/file_bytes.h"
#include "tenon/bytes/zip/zip_archive.h"
#include "tenon/formats/open_layer.h"
#include "tenon/formats/save_layer.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"
#include "tenon/structure/digest_text.h"

namespace tenon {
namespace {

using layer::AssetPath;
using layer::Duration;
using layer::PathExpression;
using layer::TimeCode;
using layer::Value;
namespace fields = layer::fields;

/// Longer arrays of numbers are kept as digests.
constexpr std::size_t kKeptElements = 32;
constexpr std::string_view kArrayMark = "tenon:array ";
constexpr const char* kDigestsName = "digests";
constexpr const char* kKeptName = "kept";
constexpr const char* kLayerEnding = ".usdc";

/// The bytes of an array of numbers; none of other values.
template <class T>
std::string_view bytes_of_array(const Value& value) {
  if constexpr (std::is_trivially_copyable_v<T> && !std::is_same_v<T, Token>) {
    if (const auto* array = value.get<layer::Array<T>>()) {
      return {reinterpret_cast<const char*>(&*array->begin()), array->size() * sizeof(T)};
    }
  }
  return {};
}

std::string mark_of(std::size_t size, std::string_view numbers) {
  return std::string(kArrayMark) + std::to_string(size) + ' ' +
         structure::hex_of(content_digest(numbers));
}

/// The digest that replaces a long array of numbers; empty for other values.
std::string array_mark(const Value& value) {
  if (!value.is_array() || value.size() <= kKeptElements) {
    return {};
  }
  std::string_view numbers;
#define TENON_SCALAR(enumerator, type, name, crate_id)           \
  if (numbers = bytes_of_array<type>(value); !numbers.empty()) { \
    return mark_of(value.size(), numbers);                       \
  }
#include "tenon/layer/value_types.def"
  return {};
}

bool is_array_mark(const Value& value) {
  const auto* text = value.get<std::string>();
  return text != nullptr && text->starts_with(kArrayMark);
}

layer::Layer without_arrays(layer::Layer layer) {
  for (const layer::Layer::Entry& entry : layer.entries()) {
    const Value* value = entry.path.empty() ? nullptr : entry.spec.find(fields::default_value);
    if (value == nullptr) {
      continue;
    }
    if (std::string mark = array_mark(*value); !mark.empty()) {
      layer.find(entry.path)->set(fields::default_value, Value(std::move(mark)));
    }
  }
  return layer;
}

/// "0123456789abcdef name" in each line.
std::string digest_lines(const structure::Digests& digests) {
  std::string text;
  for (const auto& [name, digest] : digests) {
    text += structure::hex_of(digest) + ' ' + name + '\n';
  }
  return text;
}

/// Each line of digest_lines.
template <class Take>
void each_digest(std::string_view text, Take take) {
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    const auto digest = structure::digest_from(line.substr(0, structure::kDigestDigits));
    if (digest && line.size() > structure::kDigestDigits + 1) {
      take(std::string(line.substr(structure::kDigestDigits + 1)), *digest);
    }
  }
}

/// A line for each conflict; 0 for a layer without one that need not be told again.
std::string kept_lines(const std::map<std::string, std::set<std::uint64_t>>& kept) {
  std::string text;
  for (const auto& [name, conflicts] : kept) {
    text += digest_lines({{name, 0}});
    for (const std::uint64_t conflict : conflicts) {
      text += digest_lines({{name, conflict}});
    }
  }
  return text;
}

Result<BaseCopy> decode_base(std::shared_ptr<const bytes::FileBytes> bytes) {
  TENON_TRY(const bytes::ZipArchive archive, bytes::ZipArchive::open(std::move(bytes)));
  BaseCopy copy;
  for (const bytes::ZipEntry& entry : archive.entries()) {
    TENON_TRY(const auto contents, archive.read(entry));
    if (entry.name == kDigestsName) {
      each_digest(contents->text(), [&](std::string name, std::uint64_t digest) {
        copy.digests.emplace(std::move(name), digest);
      });
    } else if (entry.name == kKeptName) {
      each_digest(contents->text(), [&](std::string name, std::uint64_t conflict) {
        copy.kept[std::move(name)].insert(conflict);
      });
    } else if (entry.name.ends_with(kLayerEnding)) {
      const std::string name =
          entry.name.substr(0, entry.name.size() - std::string_view(kLayerEnding).size());
      Diagnostics ignored;
      TENON_TRY(layer::Layer layer, formats::read_layer(contents, name, ignored));
      copy.layers.emplace(name, std::move(layer));
    }
  }
  return copy;
}

}  // namespace

Result<std::string> encode_base(const structure::Package& package, BaseChanges changes) {
  const structure::PackageFile& opening = package.files.at(package.interface);
  structure::Digests digests = structure::noted_digests(*opening.layer, package.interface);
  digests[package.interface] =
      structure::noted_own_digest(opening.bytes->text(), package.interface).value_or(0);
  std::vector<std::pair<std::string, std::string>> layers;
  for (const auto& [name, digest] : changes.digests) {
    digests.erase(name);
    if (digest) {
      digests.emplace(name, *digest);
    }
  }
  for (const auto& [name, file] : package.files) {
    if (file.layer != nullptr) {
      const auto changed = changes.layers.find(name);
      layer::Layer layer =
          without_arrays(changed == changes.layers.end() ? *file.layer : changed->second);
      structure::remove_note(layer);
      TENON_TRY(std::string encoded, formats::encode_layer(layer, formats::LayerFormat::Crate));
      layers.emplace_back(name + kLayerEnding, std::move(encoded));
    }
  }
  const std::string lines = digest_lines(digests);
  const std::string kept = kept_lines(changes.kept);
  std::vector<bytes::ZipFile> files{{kDigestsName, lines}};
  if (!kept.empty()) {
    files.push_back({kKeptName, kept});
  }
  for (const auto& [name, contents] : layers) {
    files.push_back({name, contents});
  }
  return bytes::write_zip(files);
}

Result<void> write_with_base(structure::Package package, const std::string& folder,
                             const structure::WriteOptions& options) {
  TENON_TRY(std::string copy, encode_base(package));
  package.files[structure::copy_place(package.interface)].bytes =
      bytes::FileBytes::own(std::move(copy));
  return structure::write_package(package, folder, options);
}

Result<std::optional<BaseCopy>> read_base(const std::string& folder, const std::string& opening) {
  auto bytes = bytes::FileBytes::open(folder + '/' + structure::copy_place(opening));
  if (!bytes && bytes.error().code() == ErrorCode::NotFound) {
    return std::optional<BaseCopy>();
  }
  if (!bytes) {
    return std::move(bytes).error();
  }
  const auto asset = bytes::FileBytes::open(folder + '/' + opening);
  const auto noted = asset ? structure::noted_own_digest((*asset)->text(), opening) : std::nullopt;
  auto copy = decode_base(*std::move(bytes));
  if (!copy) {
    return std::move(copy).error().in_file(folder + '/' + structure::copy_place(opening));
  }
  const auto known = copy->digests.find(opening);
  if (!noted || known == copy->digests.end() || known->second != *noted) {
    return std::optional<BaseCopy>();
  }
  return std::optional<BaseCopy>(*std::move(copy));
}

Result<layer::Layer> restored(layer::Layer base, const layer::Layer& edited,
                              const layer::Layer& source, formats::LayerFormat format) {
  std::vector<std::pair<Path, Value>> left;
  for (const layer::Layer::Entry& entry : base.entries()) {
    const Value* mark = entry.path.empty() ? nullptr : entry.spec.find(fields::default_value);
    if (mark == nullptr || !is_array_mark(*mark)) {
      continue;
    }
    const Value wanted = *mark;
    layer::Spec& spec = *base.find(entry.path);
    spec.erase(fields::default_value);
    for (const layer::Layer* layer : {&edited, &source}) {
      const layer::Spec* other = layer->find(entry.path);
      const Value* value = other == nullptr ? nullptr : other->find(fields::default_value);
      if (value != nullptr && array_mark(*value) == wanted.get_or(std::string())) {
        spec.set(fields::default_value, *value);
        break;
      }
    }
    if (!spec.has(fields::default_value)) {
      left.emplace_back(entry.path, wanted);
    }
  }
  if (format == formats::LayerFormat::Text) {
    TENON_TRY(std::string text, formats::encode_layer(base, format));
    Diagnostics ignored;
    const std::string name = base.identifier();
    TENON_TRY(base, formats::read_layer(bytes::FileBytes::own(std::move(text)), name, ignored));
  }
  for (auto& [path, mark] : left) {
    if (layer::Spec* spec = base.find(path)) {
      spec->set(fields::default_value, std::move(mark));
    }
  }
  return base;
}

}  // namespace tenon
