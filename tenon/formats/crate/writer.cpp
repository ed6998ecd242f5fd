// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/crate/writer.h"

#include <algorithm>
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
std::vector<const Entry*> ordered_specs(const layer::Layer& layer) {
  std::vector<const Entry*> entries;
  std::vector<Path> paths;
  for (const Entry& entry : layer.entries()) {
    if (!entry.path.empty() && entry.spec.kind != layer::SpecKind::Connection &&
        entry.spec.kind != layer::SpecKind::RelationshipTarget) {
      entries.push_back(&entry);
      paths.push_back(entry.path);
    }
  }
  std::vector<const Entry*> ordered;
  ordered.reserve(entries.size());
  std::unordered_map<Token, std::vector<const Entry*>> properties;
  for (const std::uint32_t i : path_order(paths)) {
    (paths[i].is_property() ? properties[paths[i].name()] : ordered).push_back(entries[i]);
  }
  std::map<Token, const std::vector<const Entry*>*> by_name;
  for (const auto& [name, group] : properties) {
    by_name.emplace(name, &group);
  }
  for (const auto& [name, group] : by_name) {
    ordered.insert(ordered.end(), group->begin(), group->end());
  }
  return ordered;
}

/// `fields` is room for the numbers of its fields.
Result<void> write_spec(const Entry& entry, crate::TableWriter& tables, crate::ValueWriter& values,
                        std::vector<std::uint32_t>& fields) {
  fields.clear();
  for (const layer::Field& field : entry.spec.fields()) {
    if (field.value.empty() || field.name == layer::fields::targetChildren ||
        field.name == layer::fields::connectionChildren) {
      continue;
    }
    auto word = values.write(field.name, field.value);
    if (!word) {
      return std::move(word).error().with_prim(entry.path.prim().str());
    }
    fields.push_back(tables.field(field.name, *word));
  }
  tables.spec(entry.path, kind_number(entry.spec.kind), tables.field_set(fields));
  return {};
}

}  // namespace

Result<std::string> write_crate(const layer::Layer& layer) {
  bytes::ByteWriter out;
  out.write(crate::Bootstrap{});
  crate::TableWriter tables;
  crate::ValueWriter values(out, tables);
  std::vector<std::uint32_t> fields;
  for (const Entry* entry : ordered_specs(layer)) {
    TENON_CHECK(write_spec(*entry, tables, values, fields));
  }
  crate::Bootstrap bootstrap = {};
  bootstrap.contents = static_cast<std::int64_t>(tables.write(out));
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
