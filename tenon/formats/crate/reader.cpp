// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Most values hold no paths. In a large file they are read on one thread while paths and specs are
// made on another; values with paths follow. Specs are made in the order of the tree, so that a
// walk down it moves forward in memory. An error of the structure goes before one of the values, so
// the outcome does not depend on the threads. Each field is read once; specs pick theirs out of one
// table. A budget in proportion to the file's size bounds what references to the same data could
// multiply.
#include "tenon/formats/crate/reader.h"

#include <algorithm>
#include <span>
#include <string_view>
#include <unordered_map>
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
    tables_.fields = {};
    tables_.paths = {};
    tables_.file->bytes->let_go(tables_.file->bytes->span());
    report_findings();
    TENON_CHECK(add_fields());
    layer_.set_may_lack_text();
    return std::move(layer_);
  }

 private:
  /// Paths, and specs without their fields.
  Result<void> make_specs() {
    TENON_CHECK(read_paths(tables_));
    TENON_CHECK(read_specs(tables_));
    tables_.file->bytes->let_go(tables_.path_section.span());
    tables_.file->bytes->let_go(tables_.spec_section.span());
    for (const std::uint32_t at : tables_.path_order) {
      if (tables_.specs[at].kind != SpecKind::None) {
        TENON_CHECK(make_spec(tables_.paths[at], tables_.specs[at].kind));
      }
    }
    return {};
  }

  Result<void> make_spec(Path path, SpecKind kind) {
    if (!kind_fits(kind, path)) {
      return crate::corrupt("the spec at " + path.str() + " is of a kind that cannot be there");
    }
    // Each layer has a root.
    if (kind != SpecKind::PseudoRoot && layer_.create_new(path, kind) == nullptr) {
      return crate::corrupt("there are two specs at " + path.str());
    }
    return {};
  }

  /// Each field is read once; specs share it. Those that may hold paths are read after the others.
  Result<void> read_values(bool with_paths) {
    crate::ValueReader reader(tables_, budget_, findings_);
    fields_.resize(tables_.fields.size());
    for (std::size_t i = 0; i < fields_.size(); ++i) {
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
      fields_[i].name = field.name;
      fields_[i].value = payload ? as_payload_list(*std::move(value)) : *std::move(value);
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
  Result<void> add_fields() {
    TENON_TRY(checked_, crate::ZeroedArray<SetForm>::make(tables_.field_sets.size()));
    for (const std::uint32_t at : tables_.path_order) {
      const crate::SpecRow& row = tables_.specs[at];
      if (row.kind != SpecKind::None && checked_[row.field_set] == SetForm::Unknown) {
        TENON_CHECK(check_set(row.field_set));
      }
    }
    layer::FieldTable* const table =
        layer::FieldTable::make(std::move(fields_), tables_.field_sets);
    tables_.field_sets = {};
    std::uint32_t number = 1;  // of the root's spec; the others follow as they were made
    for (const std::uint32_t at : tables_.path_order) {
      const crate::SpecRow& row = tables_.specs[at];
      if (row.kind == SpecKind::None) {
        continue;
      }
      const bool is_root = row.kind == SpecKind::PseudoRoot;
      layer::Spec& spec = is_root ? layer_.root() : layer_.numbered_spec(++number);
      spec.set_field_list(checked_[row.field_set] == SetForm::InTable
                              ? table->list(row.field_set)
                              : own_lists_.at(row.field_set));
    }
    table->release();
    return {};
  }

  /// Sets are lists of the table as they are, except in some damaged files and those of old
  /// writers.
  Result<void> check_set(std::uint32_t set) {
    const std::vector<std::uint32_t>& sets = tables_.field_sets;
    std::size_t end = set;
    bool as_it_is = (set == 0 || sets[set - 1] == crate::kEndOfSet) &&
                    sets.size() < layer::FieldTable::kEnd - 1;
    for (; sets[end] != crate::kEndOfSet; ++end) {
      as_it_is = as_it_is && !fields_[sets[end]].value.empty();
      TENON_CHECK(check_children(fields_[sets[end]].name, fields_[sets[end]].value));
    }
    TENON_CHECK(budget_.spend(end - set));
    if (as_it_is && are_all_new({sets.data() + set, end - set})) {
      checked_[set] = SetForm::InTable;
      return {};
    }
    layer::FieldList fields;
    std::unordered_set<Token> met;
    for (std::size_t i = set; i < end; ++i) {
      const layer::Field& field = fields_[sets[i]];
      if (!field.value.empty() && met.insert(field.name).second) {
        fields.append(field.name, field.value);
      }
    }
    own_lists_.emplace(set, std::move(fields));
    checked_[set] = SetForm::OwnList;
    return {};
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
                            "\", which is not a name");
    }
    return {};
  }

  /// Some writers name a field of a set twice; the first counts, as in OpenUSD.
  bool are_all_new(std::span<const std::uint32_t> set) const {
    constexpr std::size_t kFew = 32;  // compared with each other
    if (set.size() > kFew) {
      std::unordered_set<Token> met;
      return std::all_of(set.begin(), set.end(),
                         [&](std::uint32_t i) { return met.insert(fields_[i].name).second; });
    }
    for (std::size_t i = 1; i < set.size(); ++i) {
      const auto is_same = [&](std::uint32_t other) {
        return fields_[other].name == fields_[set[i]].name;
      };
      if (std::any_of(set.begin(), set.begin() + static_cast<std::ptrdiff_t>(i), is_same)) {
        return false;
      }
    }
    return true;
  }

  enum class SetForm : std::uint8_t { Unknown, InTable, OwnList };

  crate::Tables tables_;
  crate::WorkBudget budget_;
  Diagnostics& diagnostics_;
  Diagnostics findings_;
  layer::Layer layer_;
  std::vector<layer::Field> fields_;
  std::unordered_map<std::uint32_t, layer::FieldList> own_lists_;  // of sets, by where they start
  crate::ZeroedArray<SetForm> checked_;                            // the same
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
