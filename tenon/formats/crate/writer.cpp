// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/crate/writer.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <unordered_map>
#include <vector>

#include "tenon/base/paths/path_order.h"
#include "tenon/formats/crate/table_writer.h"
#include "tenon/formats/crate/value_writer.h"

namespace tenon::formats {
namespace {

using Entry = layer::Layer::Entry;

std::uint32_t kind_number(layer::SpecKind kind) {
  const auto* it = std::find(std::begin(crate::kSpecKinds), std::end(crate::kSpecKinds), kind);
  return static_cast<std::uint32_t>(it - std::begin(crate::kSpecKinds));
}

/// Specs in the order of the file: prims before properties, those grouped by name, each by path.
/// Equal fields side by side pack well. Specs of targets carry nothing that their list does not.
struct OrderedSpecs {
  std::vector<const Entry*> entries;
  std::vector<Path> paths;  ///< the same in the order of paths
};

OrderedSpecs ordered_specs(const layer::Layer& layer) {
  std::vector<const Entry*> entries;
  std::vector<Path> paths;
  for (const Entry& entry : layer.entries()) {
    if (!entry.path.empty() && entry.spec.kind != layer::SpecKind::Connection &&
        entry.spec.kind != layer::SpecKind::RelationshipTarget) {
      entries.push_back(&entry);
      paths.push_back(entry.path);
    }
  }
  OrderedSpecs ordered;
  ordered.entries.reserve(entries.size());
  ordered.paths.reserve(entries.size());
  std::unordered_map<Token, std::vector<const Entry*>> properties;
  for (const std::uint32_t i : path_order(paths)) {
    ordered.paths.push_back(paths[i]);
    (paths[i].is_property() ? properties[paths[i].name()] : ordered.entries).push_back(entries[i]);
  }
  std::map<Token, const std::vector<const Entry*>*> by_name;
  for (const auto& [name, group] : properties) {
    by_name.emplace(name, &group);
  }
  for (const auto& [name, group] : by_name) {
    ordered.entries.insert(ordered.entries.end(), group->begin(), group->end());
  }
  return ordered;
}

/// Writes specs one by one. Readers let specs share equal fields; where some are met again soon
/// their set is known.
class SpecWriter {
 public:
  SpecWriter(crate::TableWriter& tables, crate::ValueWriter& values)
      : tables_(tables), values_(values) {}

  Result<void> write(const Entry& entry) {
    const void* const list = entry.spec.field_list().id();
    Known& known = known_[(reinterpret_cast<std::uintptr_t>(list) >> 2U) % kKnown];
    if (list == nullptr || known.list != list) {
      TENON_TRY(const std::uint32_t set, field_set(entry));
      known = {list, set};
    }
    tables_.spec(entry.path, kind_number(entry.spec.kind), known.set);
    return {};
  }

 private:
  static constexpr std::size_t kKnown = 256;

  struct Known {
    const void* list = nullptr;
    std::uint32_t set = 0;
  };

  Result<std::uint32_t> field_set(const Entry& entry) {
    fields_.clear();
    for (const layer::Field& field : entry.spec.fields()) {
      if (field.value.empty() || field.name == layer::fields::targetChildren ||
          field.name == layer::fields::connectionChildren) {
        continue;
      }
      auto word = values_.write(field.name, field.value);
      if (!word) {
        return std::move(word).error().with_prim(entry.path.prim().str());
      }
      fields_.push_back(tables_.field(field.name, *word));
    }
    return tables_.field_set(fields_);
  }

  crate::TableWriter& tables_;
  crate::ValueWriter& values_;
  std::array<Known, kKnown> known_{};
  std::vector<std::uint32_t> fields_;  // of the spec that is written
};

}  // namespace

Result<std::string> write_crate(const layer::Layer& layer) {
  bytes::ByteWriter out;
  out.write(crate::Bootstrap{});
  crate::TableWriter tables;
  crate::ValueWriter values(out, tables);
  SpecWriter specs(tables, values);
  const OrderedSpecs ordered = ordered_specs(layer);
  tables.reserve(ordered.entries.size());
  for (const Entry* entry : ordered.entries) {
    TENON_CHECK(specs.write(*entry));
  }
  crate::Bootstrap bootstrap = {};
  bootstrap.contents = static_cast<std::int64_t>(tables.write(out, ordered.paths));
  if (!tables.fits() || out.offset() > crate::ValueWord::kPayloadMask) {
    return Error(ErrorCode::Limit, "the layer is too large for a binary file")
        .with_rule("crate.too-much");
  }
  if (const std::string* text = tables.unfit_text()) {
    return Error(ErrorCode::Invalid, "the text \"" + text->substr(0, text->find('\0')) +
                                         "...\" has a zero byte, which binary files cannot hold")
        .with_rule("crate.zero-byte")
        .with_fix("remove the zero byte or save the layer as text");
  }
  std::memcpy(bootstrap.magic, crate::kMagic, crate::kMagicSize);
  const crate::Version version = values.needed();
  bootstrap.version[0] = version.major;
  bootstrap.version[1] = version.minor;
  bootstrap.version[2] = version.patch;
  out.patch(0, bootstrap);
  return out.take();
}

}  // namespace tenon::formats
