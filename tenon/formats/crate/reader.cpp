// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Most values hold no paths. In a large file they are read on one thread while paths and specs are
// made on another; values with paths follow. An error of the structure goes before one of the
// values, so the outcome does not depend on the threads. Each field is read once and each set of
// fields made once, and specs share them. A budget in proportion to the file's size bounds what
// references to the same data could multiply.
#include "tenon/formats/crate/reader.h"

#include <algorithm>
#include <span>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "tenon/base/parallel.h"
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

constexpr std::size_t kWorthAThread = 256u << 10;  // bytes; less is read before a thread starts

class LayerBuilder {
 public:
  LayerBuilder(crate::Tables tables, std::string identifier, Diagnostics& diagnostics)
      : tables_(std::move(tables)),
        budget_(tables_.file->bytes->size()),
        diagnostics_(diagnostics),
        layer_(std::move(identifier)) {}

  Result<layer::Layer> build() {
    Result<void> plain;
    Result<void> structure;
    const auto values = [&] { plain = read_values(false); };
    const auto specs = [&] { structure = make_specs(); };
    if (tables_.file->bytes->size() >= kWorthAThread) {
      run_both(values, specs);
    } else {
      values();
      specs();
    }
    TENON_CHECK(structure);
    TENON_CHECK(plain);
    TENON_CHECK(read_values(true));
    report_findings();
    TENON_TRY(list_of_set_, crate::ZeroedArray<std::uint32_t>::make(tables_.field_sets.size()));
    for (std::size_t i = 0; i < specs_.size(); ++i) {
      TENON_CHECK(add_fields(tables_.specs[i].field_set, *specs_[i]));
    }
    layer_.set_may_lack_text();
    return std::move(layer_);
  }

 private:
  /// Paths, and specs without their fields.
  Result<void> make_specs() {
    TENON_CHECK(read_paths(tables_));
    TENON_CHECK(read_specs(tables_));
    layer_.reserve(tables_.specs.size() + 1);
    specs_.reserve(tables_.specs.size());
    for (const crate::SpecRow& row : tables_.specs) {
      TENON_CHECK(make_spec(row));
    }
    return {};
  }

  Result<void> make_spec(const crate::SpecRow& row) {
    const Path path = tables_.paths[row.path];
    if (!kind_fits(row.kind, path)) {
      return crate::corrupt("the spec at " + path.str() + " is of a kind that cannot be there");
    }
    const std::size_t before = layer_.spec_count();
    specs_.push_back(&layer_.create(path, row.kind));
    const bool is_root = path.is_absolute_root();
    if (is_root ? root_seen_ : layer_.spec_count() == before) {
      return crate::corrupt("there are two specs at " + path.str());
    }
    root_seen_ = root_seen_ || is_root;
    return {};
  }

  /// Each field is read once; specs share it. Those that may hold paths are read after the others.
  Result<void> read_values(bool with_paths) {
    crate::ValueReader reader(tables_, budget_, findings_);
    values_.resize(tables_.fields.size());
    for (std::size_t i = 0; i < values_.size(); ++i) {
      const crate::FieldRow& field = tables_.fields[i];
      if (crate::may_hold_paths(field.value) != with_paths) {
        continue;
      }
      auto value = reader.read(field.value);
      if (!value) {
        Error error = std::move(value).error();
        Diagnostic diagnostic = error.diagnostic();
        diagnostic.message += " (field \"" + field.name.str() + "\")";
        return Error(error.code(), std::move(diagnostic));
      }
      const bool payload = field.name == layer::fields::payload;
      values_[i] = payload ? as_payload_list(*std::move(value)) : *std::move(value);
    }
    return {};
  }

  void report_findings() {
    for (Diagnostic diagnostic : findings_) {
      diagnostic.file = layer_.identifier();
      diagnostics_.add(std::move(diagnostic));
    }
  }

  /// Specs of one set of fields share them.
  Result<void> add_fields(std::uint32_t set, layer::Spec& spec) {
    std::uint32_t& list = list_of_set_[set];
    if (list == 0) {
      TENON_TRY(layer::FieldList fields, read_fields(set));
      field_lists_.push_back(std::move(fields));
      list = static_cast<std::uint32_t>(field_lists_.size());
    }
    spec.set_field_list(field_lists_[list - 1]);
    return {};
  }

  Result<layer::FieldList> read_fields(std::uint32_t set) {
    const std::vector<std::uint32_t>& sets = tables_.field_sets;
    std::size_t end = set;
    while (sets[end] != crate::kEndOfSet) {
      ++end;
    }
    TENON_CHECK(budget_.spend(end - set));
    layer::FieldList fields;
    fields.reserve(end - set);
    for (std::size_t i = set; i < end; ++i) {
      const layer::Value& value = values_[sets[i]];
      if (!value.empty()) {
        TENON_CHECK(check_children(tables_.fields[sets[i]].name, value));
        fields.append(tables_.fields[sets[i]].name, value);
      }
    }
    keep_first_of_each(fields);
    return fields;
  }

  /// What lists of children name has to be a name: paths are made of them.
  static Result<void> check_children(Token field, const layer::Value& value) {
    const auto* const names = value.get<std::vector<Token>>();
    if (names == nullptr) {
      return {};
    }
    const auto is_name = [&](Token name) {
      return field == layer::fields::primChildren ? is_identifier(name.view())
             : field == layer::fields::properties ? is_namespaced_identifier(name.view())
             : field == layer::fields::variantChildren || field == layer::fields::variantSetChildren
                 ? is_variant_name(name.view())
                 : true;
    };
    const auto wrong = std::find_if_not(names->begin(), names->end(), is_name);
    if (wrong != names->end()) {
      return crate::corrupt("`" + field.str() + "` names \"" + wrong->str() +
                            "\", which is no name");
    }
    return {};
  }

  /// Some writers name a field of a set twice; the first counts, as in OpenUSD.
  static void keep_first_of_each(layer::FieldList& fields) {
    constexpr std::size_t kFew = 32;  // compared with each other
    const std::span<const layer::Field> items = fields.items();
    const auto is_met = [&](std::size_t i) {
      return std::any_of(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(i),
                         [&](const layer::Field& before) { return before.name == items[i].name; });
    };
    bool all_new = true;
    std::unordered_set<Token> met;
    for (std::size_t i = 0; i < items.size() && all_new; ++i) {
      all_new = items.size() <= kFew ? !is_met(i) : met.insert(items[i].name).second;
    }
    if (all_new) {
      return;
    }
    met.clear();
    layer::FieldList kept;
    for (const layer::Field& field : items) {
      if (met.insert(field.name).second) {
        kept.append(field.name, field.value);
      }
    }
    fields = std::move(kept);
  }

  crate::Tables tables_;
  crate::WorkBudget budget_;
  Diagnostics& diagnostics_;
  Diagnostics findings_;
  layer::Layer layer_;
  std::vector<layer::Spec*> specs_;                // of tables_.specs
  std::vector<layer::Value> values_;               // by index of the field
  std::vector<layer::FieldList> field_lists_;      // of the sets that specs have
  crate::ZeroedArray<std::uint32_t> list_of_set_;  // by where the set starts: 1 + its list
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
