// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The steps of value_search.h, taken to the end: the judge that resolves says what becomes of each
// statement until one decides; what comes after it loses. Then the value is read as always, with a
// record of which sources it was made of: array edits and path expressions read more than one, and
// which ones depends on the time.
#include "tenon/stage/values/trace_value.h"

#include <algorithm>

#include "tenon/stage/values/value_search.h"

namespace tenon::stage {
namespace {

using Use = ReadTrace::Use;

/// An opinion with what joins it to what was read.
struct Row {
  TracedOpinion opinion;
  std::uint32_t node = 0;
  const layer::Layer* layer = nullptr;
  std::optional<std::size_t> source;  ///< its index among the sources of the value
};

/// What the search says about a clip set: the prim spec that names it and the clip in force.
void add_clips(const ClipSet& set, Path attribute, Time time, TracedOpinion& traced) {
  traced.clip = TracedClip{set.name(), {}, {}, 0};
  if (time.is_default()) {
    return;
  }
  const ClipSet::Active active = set.active_at(attribute, time.code());
  traced.clip->path = active.attribute;
  traced.clip->time = active.time;
  if (active.layer != nullptr) {
    traced.clip->layer = active.layer->identifier();
    const layer::Spec* spec = active.layer->find(active.attribute);
    traced.value = spec == nullptr ? nullptr : spec->find(layer::fields::timeSamples);
  }
}

/// Is shown every statement and makes a row of each.
class TracingSearch {
 public:
  static constexpr bool kSeesAll = true;
  TracingSearch(const compose::PrimIndex& index, Time time)
      : index_(index), time_(time), judge_(asked_at(time), last_, &passed_) {}
  bool looks_at_animation() const { return true; }
  std::vector<Row> take_rows() { return std::move(rows_); }

  /// What it answers keeps the search going.
  Verdict take(const Statement& statement) {
    Row row = row_of(statement);
    if (statement.kind == ValueSource::None) {
      row.opinion.role = OpinionRole::Declares;
    } else if (decided_ || is_hidden_by_taken(statement)) {
      row.opinion.reason = OpinionReason::Weaker;
      row.opinion.decided_by = taken_;
    } else {
      judge(statement, row);
    }
    rows_.push_back(std::move(row));
    return Verdict::SaysNothing;
  }

 private:
  /// The spec has given a source already; a plain search goes on with the next layer.
  bool is_hidden_by_taken(const Statement& statement) const {
    return taken_ && statement.kind != ValueSource::ValueClips &&
           statement.opinion.spec == taken_spec_ && statement.opinion.node == rows_[*taken_].node;
  }

  Row row_of(const Statement& statement) const {
    Row row{{}, statement.opinion.node, statement.opinion.layer, std::nullopt};
    row.opinion.kind = statement.kind;
    row.opinion.value = statement.value;
    compose::Opinion opinion = statement.opinion;
    if (statement.clips != nullptr) {
      opinion.path = statement.clips->site();
      opinion.spec = opinion.layer->find(opinion.path);
      opinion.offset = statement.clips->offset();
      add_clips(*statement.clips, statement.opinion.path, time_, row.opinion);
    }
    row.opinion.source = source_of(index_, opinion);
    return row;
  }

  void judge(const Statement& statement, Row& row) {
    TracedOpinion& traced = row.opinion;
    const std::size_t source = passed_.size();
    const Verdict verdict = judge_.take(statement);
    if (verdict == Verdict::SaysNothing) {
      traced.reason = OpinionReason::Empty;
    } else if (verdict == Verdict::Hidden) {
      traced.reason =
          time_.is_default() ? OpinionReason::DefaultTime : OpinionReason::AnimationBlocked;
      traced.decided_by = animation_block_;
    } else if (verdict == Verdict::BlocksAnimation) {
      animation_block_ = animation_block_ ? animation_block_ : rows_.size();
      traced.role = OpinionRole::Combined;
      traced.reason = OpinionReason::BlocksAnimation;
    } else {
      decided_ = verdict == Verdict::Decides;
      taken_ = rows_.size();
      taken_spec_ = statement.opinion.spec;
      row.source = source;
    }
  }

  const compose::PrimIndex& index_;
  Time time_;
  ValueSources passed_;
  ResolvedValue last_;
  ValueJudge judge_;
  std::vector<Row> rows_;
  std::optional<std::size_t> taken_;  ///< the last row that is a source
  const layer::Spec* taken_spec_ = nullptr;
  std::optional<std::size_t> animation_block_;
  bool decided_ = false;
};

/// Gives the rows the roles that reading the value gave their opinions.
class RoleAssigner {
 public:
  RoleAssigner(std::vector<Row>& rows, const ReadTrace& read) : rows_(rows), read_(read) {}

  void assign() {
    for (std::size_t i = 0; i < rows_.size() && !ended_by_; ++i) {
      if (rows_[i].source) {
        assign_source(i);
      } else if (rows_[i].opinion.kind == ValueSource::Fallback) {
        wins(i);
      }
    }
    for (std::size_t i = ended_by_.value_or(rows_.size()) + 1; i < rows_.size(); ++i) {
      assign_weaker(i);
    }
  }

 private:
  void wins(std::size_t row) {
    rows_[row].opinion.role = OpinionRole::Wins;
    ended_by_ = row;
  }

  void combined(std::size_t row, OpinionReason reason) {
    rows_[row].opinion.role = OpinionRole::Combined;
    rows_[row].opinion.reason = reason;
    rows_[row].opinion.decided_by.reset();
  }

  Use use_of(const Row& row) const {
    if (read_.sources.empty()) {
      return *row.source == 0 ? Use::Gives : Use::NotRead;
    }
    return read_.sources[*row.source];
  }

  /// A row down to the one that ends the search.
  void assign_source(std::size_t row) {
    const Use use = use_of(rows_[row]);
    if (use == Use::Edits) {
      first_edit_ = first_edit_ ? first_edit_ : row;
      combined(row, OpinionReason::EditsArray);
    } else if (use == Use::Gives) {
      wins(row);
    } else if (use == Use::OtherType) {
      rows_[row].opinion.reason = OpinionReason::OtherType;
      rows_[row].opinion.decided_by = first_edit_;
      ended_by_ = row;
    } else {  // a block below an edit
      combined(row, OpinionReason::HidesWeaker);
      ended_by_ = row;
    }
  }

  void assign_weaker(std::size_t row) {
    TracedOpinion& traced = rows_[row].opinion;
    const bool fallback = traced.kind == ValueSource::Fallback;
    const bool over_fallback = rows_[*ended_by_].opinion.role != OpinionRole::Wins;
    if (fallback && over_fallback) {
      traced.role = OpinionRole::Wins;
    } else if (is_put_in(rows_[row])) {
      combined(row, OpinionReason::PutIn);
    } else if ((fallback && read_.fallback) ||
               (rows_[row].source && use_of(rows_[row]) == Use::MovedTowards)) {
      combined(row, OpinionReason::MovedTowards);
    } else if (traced.role != OpinionRole::Declares) {
      const bool blocked = rows_[*ended_by_].opinion.is_block();
      traced.role = OpinionRole::Loses;
      traced.reason = blocked ? OpinionReason::Blocked : OpinionReason::Weaker;
      traced.decided_by = ended_by_;
    }
  }

  bool is_put_in(const Row& row) const {
    return std::any_of(read_.put_in.begin(), read_.put_in.end(), [&](const auto& weaker) {
      return weaker.kind == row.opinion.kind && weaker.opinion.layer == row.layer &&
             weaker.opinion.node == row.node;
    });
  }

  std::vector<Row>& rows_;
  const ReadTrace& read_;
  std::optional<std::size_t> first_edit_;
  std::optional<std::size_t> ended_by_;  ///< nothing weaker was looked at
};

void add_fallback(const schema::PrimDefinition& definition, Token name, std::vector<Row>& rows) {
  const schema::PropertyDefinition* declared = definition.find(name);
  if (declared != nullptr && !declared->fallback.empty()) {
    Row& row = rows.emplace_back();
    row.opinion.kind = ValueSource::Fallback;
    row.opinion.value = &declared->fallback;
    row.opinion.schema = definition.declaring_schema(name);
  }
}

}  // namespace

const TracedOpinion* ValueTrace::winner() const {
  const auto found = std::find_if(opinions.begin(), opinions.end(), [](const TracedOpinion& one) {
    return one.role == OpinionRole::Wins;
  });
  return found == opinions.end() ? nullptr : &*found;
}

ValueTrace trace_value(const StageData& stage, const PrimData& prim, Path proxy_path, Token name,
                       Time time) {
  ReadTrace read;
  ValueTrace trace;
  trace.time = time;
  trace.value = read_attribute(stage, prim, proxy_path, name, time, &read);
  trace.source = resolve_value(prim, name, asked_at(time)).source;
  TracingSearch search(*prim.index, time);
  visit_statements(prim, name, asked_at(time), search);
  std::vector<Row> rows = search.take_rows();
  add_fallback(*prim.definition, name, rows);
  RoleAssigner(rows, read).assign();
  for (Row& row : rows) {
    trace.opinions.push_back(std::move(row.opinion));
  }
  return trace;
}

}  // namespace tenon::stage
