// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// An attribute is traced twice, at the default time and at another one. A trace is shown every
// statement about the value, whichever decides, so both list the same opinions in the same order:
// row i of one is row i of the other, and its two roles make one verdict. A reason names the place
// of the opinion that decided, which is in a stronger row. Connections and targets are traced as
// fields. Composition ignores opinions authored below an instance; they are searched for
// separately.
#include "tenon/answers/where_opinions.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "tenon/answers/opinions.h"
#include "tenon/answers/or_null.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/compose/arcs/arc_name.h"
#include "tenon/layer/fields.h"
#include "tenon/stage/sources/opinion_sources.h"
#include "tenon/stage/values/field_trace.h"
#include "tenon/stage/values/value_trace.h"

namespace tenon::answers {
namespace {

namespace fields = layer::fields;
using stage::OpinionReason;
using stage::OpinionRole;
using stage::OpinionSource;
using stage::ValueSource;

Json arc_json(const stage::ArcStep& step) {
  Json arc = {{"arc", std::string(compose::arc_name(step.kind))},
              {"from", step.from.str()},
              {"file", file_or_null(step.layer)},
              {"line", or_null(step.line)},
              {"to", step.to.str()},
              {"layer", shown_path(step.to_layer)}};
  if (step.kind == compose::ArcKind::Variant) {
    arc["set"] = step.to.name().str();
    arc["variant"] = step.to.variant().str();
  }
  return arc;
}

Json traced_row(const OpinionSource& source, const std::string& what, const layer::Value* value) {
  const std::string& identifier = source.layer->identifier();
  Json row = {
      {"file", shown_path(identifier)},
      {"line", or_null(source.spec->line)},
      {"column", source.spec->line == 0 ? Json(nullptr) : Json(source.spec->column)},
      {"path", source.path.str()},
      {"sublayerOf", source.stack == identifier ? Json(nullptr) : Json(shown_path(source.stack))}};
  row["arcs"] = Json::array();
  for (const stage::ArcStep& step : source.arcs) {
    row["arcs"].push_back(arc_json(step));
  }
  row["what"] = what;
  row["value"] = value == nullptr ? Json(nullptr) : Json(short_value_text(*value));
  return row;
}

const char* verdict_of(OpinionRole role) {
  static constexpr const char* kVerdicts[] = {"wins", "combined", "loses", "declares"};
  return kVerdicts[static_cast<std::size_t>(role)];
}

/// Why an opinion has its role, `by` being the place of the one that decided.
std::string reason_text(OpinionReason reason, const std::string& by) {
  switch (reason) {
    case OpinionReason::EditsArray:
      return "edits the weaker array";
    case OpinionReason::MovedTowards:
      return "part of the value at the next sample";
    case OpinionReason::PutIn:
      return "the value of %_ in a stronger expression";
    case OpinionReason::HidesWeaker:
      return "blocks all that is weaker but the fallback";
    case OpinionReason::BlocksAnimation:
      return "blocks weaker samples, lets a weaker default through";
    case OpinionReason::EditsList:
      return "edits the weaker list";
    case OpinionReason::MergesKeys:
      return "key by key";
    case OpinionReason::ReplacesList:
      return "replaces weaker lists";
    case OpinionReason::Weaker:
      return by + " is stronger";
    case OpinionReason::ListReplaced:
      return by + " replaces the whole list";
    case OpinionReason::Blocked:
      return by + " blocks it";
    case OpinionReason::AnimationBlocked:
      return by + " blocks samples";
    case OpinionReason::DefaultTime:
      return "it does not count at the default time";
    case OpinionReason::OtherType:
      return by + " edits an array of another type";
    case OpinionReason::Empty:
      return "it is empty";
    case OpinionReason::None:
      break;
  }
  return {};
}

void conclude(Json& row, const char* verdict, const std::string& why = {}) {
  row["verdict"] = verdict;
  row["why"] = or_null(why);
}

/// The rows of fields, each with its role and reason.
Json field_rows(const std::vector<stage::TracedField>& opinions) {
  Json rows = Json::array();
  for (const stage::TracedField& opinion : opinions) {
    const std::string what = opinion.value == nullptr ? "declaration" : opinion.field.str();
    Json row = traced_row(opinion.source, what, opinion.value);
    const std::string by = opinion.decided_by ? place_text(rows[*opinion.decided_by]) : "";
    conclude(row, verdict_of(opinion.role), reason_text(opinion.reason, by));
    rows.push_back(std::move(row));
  }
  return rows;
}

Json traced_row(const stage::TracedOpinion& opinion) {
  if (opinion.kind != ValueSource::Fallback) {
    Json row = traced_row(opinion.source, what_of(opinion), opinion.value);
    add_clip(opinion, row);
    return row;
  }
  return {{"file", nullptr},
          {"line", nullptr},
          {"column", nullptr},
          {"path", nullptr},
          {"sublayerOf", nullptr},
          {"arcs", Json::array()},
          {"what", "fallback"},
          {"value", short_value_text(*opinion.value)},
          {"schema", or_null(opinion.schema)}};
}

/// The traces of one attribute at the default time and at another one, opinion by opinion.
class ValueRows {
 public:
  ValueRows(const stage::Attribute& attribute, stage::Time time)
      : plain_(attribute.trace()), timed_(attribute.trace(time)) {
    for (const stage::TracedOpinion& opinion : timed_.opinions) {
      rows_.push_back(traced_row(opinion));
    }
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      conclude_row(plain_.opinions[i], timed_.opinions[i], rows_[i]);
    }
  }

  /// Without specs that are there for connections alone.
  Json take() {
    Json rows = Json::array();
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const stage::TracedOpinion& opinion = plain_.opinions[i];
      if (opinion.role != OpinionRole::Declares ||
          !opinion.source.spec->has(fields::connectionPaths)) {
        rows.push_back(std::move(rows_[i]));
      }
    }
    return rows;
  }

 private:
  void conclude_row(const stage::TracedOpinion& plain, const stage::TracedOpinion& timed,
                    Json& row) const {
    if (plain.role == OpinionRole::Wins && timed.role == OpinionRole::Wins) {
      conclude(row, "wins", plain.is_block() ? "blocks all that is weaker" : "");
    } else if (plain.role == OpinionRole::Wins) {
      const bool combined = timed.role == OpinionRole::Combined;
      const bool fallback = plain.kind == ValueSource::Fallback;
      conclude(row, "wins at the default time",
               combined   ? "at other times " + why(timed)
               : fallback ? ""
                          : what_counts_at_times());
    } else if (timed.role == OpinionRole::Wins) {
      const bool combined = plain.role == OpinionRole::Combined;
      conclude(row, "wins at times", combined ? "at the default time " + why(plain) : "");
    } else {
      // Samples, splines and clips count at times alone; defaults and fallbacks at both.
      const bool at_both =
          plain.kind == ValueSource::Default || plain.kind == ValueSource::Fallback;
      const bool combined_at_times =
          timed.role == OpinionRole::Combined && plain.role != OpinionRole::Combined;
      const stage::TracedOpinion& telling = !at_both || combined_at_times ? timed : plain;
      conclude(row, verdict_of(telling.role), why(telling));
    }
  }

  std::string why(const stage::TracedOpinion& opinion) const {
    const std::string by = opinion.decided_by ? place_text(rows_[*opinion.decided_by]) : "";
    return reason_text(opinion.reason, by);
  }

  std::string what_counts_at_times() const {
    const stage::TracedOpinion* winner = timed_.winner();
    if (winner == nullptr || winner->kind == ValueSource::Fallback) {
      return {};
    }
    const auto index = static_cast<std::size_t>(winner - timed_.opinions.data());
    const char* const what = winner->kind == ValueSource::TimeSamples  ? "samples"
                             : winner->kind == ValueSource::Spline     ? "spline"
                             : winner->kind == ValueSource::ValueClips ? "clips"
                                                                       : "value";
    return std::string("at all other times the ") + what + " of " + place_text(rows_[index]) +
           " count";
  }

  stage::ValueTrace plain_;
  stage::ValueTrace timed_;
  std::vector<Json> rows_;
};

void add_attribute(const stage::Stage& stage, const stage::Attribute& attribute,
                   std::optional<double> time, Json& answer) {
  const stage::Time at(time.value_or(0.0));
  const layer::Value value = attribute.get();
  answer["type"] = attribute.type_name().str();
  answer["value"] = value.empty() ? Json(nullptr) : Json(short_value_text(value));
  answer["source"] = source_name(attribute.value_source());
  answer["sourceAtTimes"] = source_name(attribute.value_source(at));
  if (time) {
    const layer::Value then = attribute.get(at);
    answer["time"] = *time;
    answer["valueAtTime"] = then.empty() ? Json(nullptr) : Json(short_value_text(then));
  }
  answer["opinions"] = ValueRows(attribute, at).take();
  const Path path = attribute.path();
  for (Json& row : field_rows(stage::trace_targets(stage, path.parent(), path.name()))) {
    if (row["what"] == fields::connectionPaths.str()) {
      answer["opinions"].push_back(std::move(row));
    }
  }
}

void add_relationship(const stage::Stage& stage, const stage::Relationship& relationship,
                      Json& answer) {
  answer["type"] = "rel";
  answer["value"] = Json::array();
  for (const Path& target : relationship.targets()) {
    answer["value"].push_back(target.str());
  }
  answer["source"] = relationship.has_authored_targets() ? "targets" : "none";
  const Path path = relationship.path();
  answer["opinions"] = field_rows(stage::trace_targets(stage, path.parent(), path.name()));
}

void add_ignored(const stage::Stage& stage, Path prim, Token property, Json& answer) {
  for (const OpinionSource& source : stage::ignored_below_instance(stage, prim, property)) {
    const layer::Value* value = source.spec->find(fields::default_value);
    value = value == nullptr ? source.spec->find(fields::targetPaths) : value;
    Json row = traced_row(source, property.empty() ? "spec" : "value", value);
    row["verdict"] = "ignored";
    row["why"] = "it is authored below an instance, whose content is shared";
    answer["opinions"].push_back(std::move(row));
  }
}

}  // namespace

Json where_json(const stage::Stage& stage, const stage::Prim& prim, Token property,
                std::optional<double> time) {
  Json answer = {{"prim", prim.path().str()}, {"property", or_null(property)}};
  if (property.empty()) {
    answer["type"] = prim.type_name().str();
    answer["opinions"] = field_rows(stage::trace_fields(stage, prim.path()));
  } else if (prim.is_relationship(property)) {
    add_relationship(stage, prim.relationship(property), answer);
  } else {
    add_attribute(stage, prim.attribute(property), time, answer);
  }
  add_ignored(stage, prim.path(), property, answer);
  return answer;
}

Result<void> check_property(const stage::Prim& prim, Token property) {
  const bool known = prim.has_property(property) || prim.is_relationship(property) ||
                     prim.attribute(property).definition() != nullptr;
  if (known) {
    return {};
  }
  return Error(ErrorCode::NotFound, "<" + prim.path().str() + "> has no property " + property.str())
      .with_fix("tenon tree --attributes lists all properties");
}

void add_other_variant(Json& answer, const Json& other, const std::string& selection) {
  const auto place = [](const Json& row) {
    return Json::array({row["file"], row["path"], row["what"]});
  };
  std::set<Json> known;
  for (const Json& row : answer["opinions"]) {
    known.insert(place(row));
  }
  for (const Json& row : other["opinions"]) {
    if (!row["file"].is_null() && !known.contains(place(row))) {
      Json added = row;
      added["verdict"] = "not in force";
      added["why"] = "only with " + selection;
      answer["opinions"].push_back(std::move(added));
    }
  }
}

}  // namespace tenon::answers
