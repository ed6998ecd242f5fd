// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Fields of which the strongest opinion counts, or several together. Metadata are composed as
// always (compose_field) and their rows told which specs were used; what composition itself reads
// (arcs, targets, selections) follows the effect of each opinion on weaker ones (field_effect).
#include "tenon/stage/values/field_trace.h"

#include <algorithm>
#include <map>
#include <utility>

#include "tenon/compose/targets.h"
#include "tenon/layer/child_lists.h"
#include "tenon/layer/fields.h"
#include "tenon/stage/composed_fields.h"
#include "tenon/stage/stage_data.h"

namespace tenon::stage {
namespace {

namespace fields = layer::fields;

/// Fields whose list edits combine within a layer stack: each of them brings in its own arcs.
bool is_of_one_stack(Token field) {
  return field == fields::references || field == fields::payload || field == fields::inheritPaths ||
         field == fields::specializes || field == fields::variantSetNames ||
         field == fields::relocates;
}

/// Rows of fields, strongest first.
class FieldRows {
 public:
  /// `used` are the specs that have a part in the composed field, where that is known.
  void add(OpinionSource source, std::uint32_t node, Token field, const UsedSpecs* used) {
    TracedField row;
    row.field = field;
    row.value = source.spec->find(field);
    const bool counts =
        used == nullptr || std::find(used->begin(), used->end(), source.spec) != used->end();
    row.source = std::move(source);
    judge(row, counts, known_[{field, is_of_one_stack(field) ? node : 0}]);
    rows_.push_back(std::move(row));
  }
  std::vector<TracedField> take() { return std::move(rows_); }

 private:
  struct Known {
    std::optional<std::size_t> decided_by;
    std::optional<std::size_t> strongest;
  };

  void judge(TracedField& row, bool counts, Known& known) const {
    const FieldEffect effect =
        row.value == nullptr ? FieldEffect::Declares : field_effect(*row.value);
    if (effect == FieldEffect::Declares && (row.value == nullptr || !known.decided_by)) {
      row.role = OpinionRole::Declares;
      return;
    }
    const bool is_list = effect == FieldEffect::EditsList || effect == FieldEffect::ReplacesList;
    if (known.decided_by || !counts) {
      row.reason =
          is_list && known.decided_by ? OpinionReason::ListReplaced : OpinionReason::Weaker;
      row.decided_by = known.decided_by ? known.decided_by : known.strongest;
      return;
    }
    known.strongest = known.strongest ? known.strongest : rows_.size();
    if (effect == FieldEffect::EditsList || effect == FieldEffect::MergesKeys) {
      row.role = OpinionRole::Combined;
      row.reason = is_list ? OpinionReason::EditsList : OpinionReason::MergesKeys;
      return;
    }
    row.role = OpinionRole::Wins;
    row.reason = is_list ? OpinionReason::ReplacesList : OpinionReason::None;
    known.decided_by = rows_.size();
  }

  std::vector<TracedField> rows_;
  std::map<std::pair<Token, std::uint32_t>, Known> known_;
};

/// The specs that compose the metadata of a prim, by field; asked for once each.
class UsedByField {
 public:
  UsedByField(const StageData& stage, const PrimData& prim) : stage_(stage), prim_(prim) {}

  /// nullptr for fields that are composed elsewhere.
  const UsedSpecs* of(Token field) {
    if (is_structure(field) || field == fields::apiSchemas || field == fields::specifier ||
        field == fields::typeName) {
      return nullptr;
    }
    const auto [at, inserted] = known_.try_emplace(field);
    if (inserted) {
      compose_field(stage_, prim_, prim_.index->opinions(), field, AssetForm::Resolved,
                    &at->second);
    }
    return &at->second;
  }

 private:
  const StageData& stage_;
  const PrimData& prim_;
  std::map<Token, UsedSpecs> known_;
};

}  // namespace

std::vector<TracedField> trace_fields(const Stage& stage, Path prim) {
  const PrimData* record = record_of(stage, prim);
  if (record == nullptr || record->index == nullptr) {
    return {};
  }
  UsedByField used(stage.data(), *record);
  FieldRows rows;
  for (const compose::Opinion& opinion : record->index->opinions()) {
    const OpinionSource source = source_of(*record->index, opinion);
    for (const layer::Field& field : opinion.spec->fields()) {
      if (!layer::is_child_list(field.name)) {
        rows.add(source, opinion.node, field.name, used.of(field.name));
      }
    }
  }
  return rows.take();
}

std::vector<TracedField> trace_targets(const Stage& stage, Path prim, Token property) {
  const PrimData* record = record_of(stage, prim);
  if (record == nullptr || record->index == nullptr) {
    return {};
  }
  const std::vector<compose::PropertyOpinion> counting =
      compose::property_opinions(*record->index, property, nullptr);
  UsedSpecs used;
  for (const compose::PropertyOpinion& opinion : counting) {
    used.push_back(opinion.spec);
  }
  const bool connects =
      !counting.empty() && counting.front().spec->kind == layer::SpecKind::Attribute;
  FieldRows rows;
  for (const compose::Opinion& opinion : property_opinions(*record, property)) {
    rows.add(source_of(*record->index, opinion), opinion.node,
             connects ? fields::connectionPaths : fields::targetPaths, &used);
  }
  return rows.take();
}

}  // namespace tenon::stage
