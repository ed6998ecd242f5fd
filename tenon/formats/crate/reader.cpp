// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/crate/reader.h"

#include <string_view>
#include <vector>

#include "tenon/formats/crate/tables.h"
#include "tenon/formats/crate/value_reader.h"
#include "tenon/layer/fields.h"

namespace tenon::formats {
namespace {

using layer::SpecKind;

bool kind_fits(SpecKind kind, Path path) {
  switch (path.kind()) {
    case PathKind::AbsoluteRoot:
      return kind == SpecKind::PseudoRoot;
    case PathKind::Prim:
      return kind == SpecKind::Prim;
    case PathKind::VariantSelection:
      return kind == (path.variant().empty() ? SpecKind::VariantSet : SpecKind::Variant);
    case PathKind::Property:
    case PathKind::RelationalAttribute:
      return kind == SpecKind::Attribute || kind == SpecKind::Relationship;
    case PathKind::Target:
      return kind == SpecKind::Connection || kind == SpecKind::RelationshipTarget;
    case PathKind::Mapper:
      return kind == SpecKind::Mapper;
    case PathKind::MapperArg:
      return kind == SpecKind::MapperArg;
    case PathKind::Expression:
      return kind == SpecKind::Expression;
    case PathKind::Empty:
    case PathKind::RelativeRoot:
      break;
  }
  return false;
}

/// A single payload, the form of files before 0.8, as the list edit that it means.
layer::Value as_payload_list(layer::Value value) {
  const auto* payload = value.get<layer::Payload>();
  if (payload == nullptr) {
    return value;
  }
  const bool none = payload->asset_path.empty();  // what such files mean by it
  return layer::Value(layer::ListOp<layer::Payload>::make_explicit(
      none ? std::vector<layer::Payload>() : std::vector<layer::Payload>{*payload}));
}

class LayerBuilder {
 public:
  LayerBuilder(crate::Tables tables, std::string identifier, Diagnostics& diagnostics)
      : tables_(std::move(tables)),
        budget_(tables_.file->bytes->size()),
        diagnostics_(diagnostics),
        layer_(std::move(identifier)) {}

  Result<layer::Layer> build() {
    TENON_CHECK(read_values());
    layer_.reserve(tables_.specs.size() + 1);
    for (const crate::SpecRow& row : tables_.specs) {
      TENON_CHECK(add_spec(row));
    }
    return std::move(layer_);
  }

 private:
  /// Each field is read once; specs share it.
  Result<void> read_values() {
    Diagnostics found;
    crate::ValueReader reader(tables_, budget_, found);
    values_.reserve(tables_.fields.size());
    for (const crate::FieldRow& field : tables_.fields) {
      auto value = reader.read(field.value);
      if (!value) {
        Error error = std::move(value).error();
        Diagnostic diagnostic = error.diagnostic();
        diagnostic.message += " (field \"" + field.name.str() + "\")";
        return Error(error.code(), std::move(diagnostic));
      }
      const bool payload = field.name == layer::fields::payload;
      values_.push_back(payload ? as_payload_list(*std::move(value)) : *std::move(value));
    }
    for (Diagnostic diagnostic : found) {
      diagnostic.file = layer_.identifier();
      diagnostics_.add(std::move(diagnostic));
    }
    return {};
  }

  Result<void> add_spec(const crate::SpecRow& row) {
    const Path path = tables_.paths[row.path];
    if (!kind_fits(row.kind, path)) {
      return crate::corrupt("the spec at " + path.str() + " is of a kind that cannot be there");
    }
    const std::size_t before = layer_.spec_count();
    layer::Spec& spec = layer_.create(path, row.kind);
    const bool is_root = path.is_absolute_root();
    if (is_root ? root_seen_ : layer_.spec_count() == before) {
      return crate::corrupt("there are two specs at " + path.str());
    }
    root_seen_ = root_seen_ || is_root;
    return add_fields(row.field_set, spec);
  }

  Result<void> add_fields(std::uint32_t set, layer::Spec& spec) {
    const std::vector<std::uint32_t>& sets = tables_.field_sets;
    std::size_t end = set;
    while (sets[end] != crate::kEndOfSet) {
      ++end;
    }
    TENON_CHECK(budget_.spend(end - set + 1));
    spec.reserve_fields(end - set);
    for (std::size_t i = set; i < end; ++i) {
      const layer::Value& value = values_[sets[i]];
      if (!value.empty()) {
        spec.append(tables_.fields[sets[i]].name, value);
      }
    }
    return {};
  }

  crate::Tables tables_;
  crate::WorkBudget budget_;
  Diagnostics& diagnostics_;
  layer::Layer layer_;
  std::vector<layer::Value> values_;  // by index of the field
  bool root_seen_ = false;
};

}  // namespace

Result<layer::Layer> read_crate(std::shared_ptr<const bytes::FileBytes> bytes,
                                std::string identifier, Diagnostics& diagnostics) {
  const std::string file = identifier;
  auto tables = crate::read_tables(std::move(bytes));
  if (!tables) {
    return std::move(tables).error().in_file(file);
  }
  auto layer = LayerBuilder(*std::move(tables), std::move(identifier), diagnostics).build();
  if (!layer) {
    return std::move(layer).error().in_file(file);
  }
  return layer;
}

}  // namespace tenon::formats
