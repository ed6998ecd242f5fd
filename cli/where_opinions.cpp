// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/where_opinions.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "cli/opinions.h"
#include "tenon/compose/arc_name.h"
#include "tenon/formats/text/value_text.h"
#include "tenon/layer/child_lists.h"
#include "tenon/layer/fields.h"
#include "tenon/schema/registry.h"
#include "tenon/stage/opinion_sources.h"

namespace tenon::cli {
namespace {

namespace fields = layer::fields;
using stage::OpinionSource;

Json optional_number(std::uint32_t number) { return number == 0 ? Json(nullptr) : Json(number); }

Json arc_json(const stage::ArcStep& step) {
  Json arc = {{"arc", std::string(compose::arc_name(step.kind))},
              {"from", step.from.str()},
              {"file", step.layer.empty() ? Json(nullptr) : Json(shown_path(step.layer))},
              {"line", optional_number(step.line)},
              {"to", step.to.str()},
              {"layer", shown_path(step.to_layer)}};
  if (step.kind == compose::ArcKind::Variant) {
    arc["set"] = step.to.name().str();
    arc["variant"] = step.to.variant().str();
  }
  return arc;
}

Json row_of(const OpinionSource& source, const std::string& what, const layer::Value* value) {
  const std::string& identifier = source.layer->identifier();
  Json row = {
      {"file", shown_path(identifier)},
      {"line", optional_number(source.spec->line)},
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

/// Rows with the place of the opinion that decided before each.
class Rows {
 public:
  void add(Json row, const char* verdict, const std::string& why = {}) {
    row["verdict"] = verdict;
    row["why"] = why.empty() ? Json(nullptr) : Json(why);
    rows_.push_back(std::move(row));
  }
  Json take() { return std::move(rows_); }

 private:
  Json rows_ = Json::array();
};

std::string stronger(const std::string& place) { return place + " is stronger"; }

/// Core Spec 1.0.1 section 12: per layer samples, spline, default; the default time sees defaults
/// alone; a block ends the search, an animation block that for samples.
class ValueJudge {
 public:
  void add(const OpinionSource& source) {
    bool said = false;
    for (const Token field : {fields::timeSamples, fields::spline}) {
      if (const layer::Value* value = source.spec->find(field)) {
        add_samples(row_of(source, field.str(), value));
        said = true;
      }
    }
    if (const layer::Value* value = source.spec->find(fields::default_value)) {
      add_default(row_of(source, "default", value), *value);
      said = true;
    }
    if (!said && !source.spec->has(fields::connectionPaths)) {
      rows_.add(row_of(source, "declaration", nullptr), "declares");
    }
  }

  void add_fallback(const layer::Value& value, const std::string& schema) {
    Json row = {{"file", nullptr},
                {"line", nullptr},
                {"column", nullptr},
                {"path", nullptr},
                {"sublayerOf", nullptr},
                {"arcs", Json::array()},
                {"what", "fallback"},
                {"value", short_value_text(value)},
                {"schema", schema.empty() ? Json(nullptr) : Json(schema)}};
    const bool open = plain_.empty() || blocked_;
    const bool open_at_times = timed_.empty() || blocked_;
    rows_.add(std::move(row),
              open ? (open_at_times ? "wins" : "wins at the default time") : "loses",
              open ? "" : stronger(plain_));
  }
  Json take() { return rows_.take(); }

 private:
  void add_samples(Json row) {
    const std::string place = place_text(row);
    if (!timed_.empty()) {
      rows_.add(std::move(row), "loses", blocked_ ? plain_ + " blocks it" : stronger(timed_));
    } else if (!animation_block_.empty()) {
      rows_.add(std::move(row), "loses", animation_block_ + " blocks samples");
    } else {
      timed_ = place;
      rows_.add(std::move(row), "wins at times");
    }
  }

  void add_default(Json row, const layer::Value& value) {
    const std::string place = place_text(row);
    if (!plain_.empty()) {
      rows_.add(std::move(row), "loses", blocked_ ? plain_ + " blocks it" : stronger(plain_));
      return;
    }
    if (value.holds<layer::AnimationBlock>()) {
      animation_block_ = timed_.empty() ? place : animation_block_;
      rows_.add(std::move(row), "combined", "blocks weaker samples, lets a weaker default through");
      return;
    }
    if (value.holds<layer::ArrayEdit>()) {
      rows_.add(std::move(row), "combined", "edits the weaker array");
      return;
    }
    blocked_ = value.is_block();
    plain_ = place;
    const bool at_times = timed_.empty();
    const std::string samples = "at all other times the samples of " + timed_ + " count";
    timed_ = at_times ? place : timed_;
    rows_.add(std::move(row), at_times ? "wins" : "wins at the default time",
              !at_times  ? samples
              : blocked_ ? "blocks all that is weaker"
                         : "");
  }

  Rows rows_;
  std::string timed_;  // place of what counts at times, and at the default time
  std::string plain_;
  std::string animation_block_;
  bool blocked_ = false;  // plain_ is a block
};

template <class T>
std::optional<bool> explicit_list(const layer::Value& value) {
  const auto* op = value.get<layer::ListOp<T>>();
  return op == nullptr ? std::nullopt : std::optional<bool>(op->is_explicit);
}

/// Nothing for what is no list edit, else whether it replaces the weaker list.
std::optional<bool> replaces_list(const layer::Value& value) {
  for (const std::optional<bool>& answer :
       {explicit_list<Path>(value), explicit_list<Token>(value), explicit_list<std::string>(value),
        explicit_list<layer::Reference>(value), explicit_list<layer::Payload>(value),
        explicit_list<std::int64_t>(value), explicit_list<int>(value)}) {
    if (answer) {
      return answer;
    }
  }
  return std::nullopt;
}

/// Rows of fields of which the strongest counts or all do together, by the type of the value.
class FieldJudge {
 public:
  void add(const OpinionSource& source, const layer::Field& field) {
    Json row = row_of(source, field.name.str(), &field.value);
    const std::string place = place_text(row);
    const std::string known = decided_[field.name];
    const std::optional<bool> list = replaces_list(field.value);
    const bool merges =
        field.value.holds<layer::Dictionary>() || field.value.holds<layer::VariantSelections>();
    if (!known.empty()) {
      rows_.add(std::move(row), "loses",
                list ? known + " replaces the whole list" : stronger(known));
      return;
    }
    if (merges || (list && !*list)) {
      rows_.add(std::move(row), "combined", list ? "edits the weaker list" : "key by key");
      return;
    }
    const auto* specifier = field.value.get<layer::Specifier>();
    if (specifier != nullptr && *specifier == layer::Specifier::Over) {
      rows_.add(std::move(row), "declares");
      return;
    }
    decided_[field.name] = place;
    rows_.add(std::move(row), "wins", list ? "replaces weaker lists" : "");
  }
  Json take() { return rows_.take(); }

 private:
  Rows rows_;
  std::map<Token, std::string> decided_;  // place of what counts, by field
};

Json prim_rows(const std::vector<OpinionSource>& sources) {
  FieldJudge judge;
  for (const OpinionSource& source : sources) {
    for (const layer::Field& field : source.spec->fields()) {
      if (!layer::is_child_list(field.name)) {
        judge.add(source, field);
      }
    }
  }
  return judge.take();
}

/// The rows of one list-edited field.
Json list_rows(const std::vector<OpinionSource>& sources, Token field, bool declarations) {
  FieldJudge judge;
  for (const OpinionSource& source : sources) {
    if (const layer::Value* value = source.spec->find(field)) {
      judge.add(source, {field, *value});
    } else if (declarations) {
      judge.add(source, {Token("declaration"), layer::Value(layer::Specifier::Over)});
    }
  }
  return judge.take();
}

/// The schema, built-in ones of the type included, that declares a property of the prim.
std::string declaring_schema(const stage::Prim& prim, Token property) {
  const schema::Registry& registry = schema::Registry::instance();
  const schema::PrimDefinition* definition = prim.definition();
  std::vector<Token> names = definition->applied();
  if (definition->schema() != nullptr) {
    names.insert(names.end(), definition->schema()->chain.begin(),
                 definition->schema()->chain.end());
  }
  for (const Token name : names) {
    const auto [base, instance] = schema::split_api_name(name);
    const schema::Schema* schema = registry.find(base);
    for (std::size_t i = 0; schema != nullptr && i < schema->properties.size(); ++i) {
      std::string declared = schema->properties[i].name.str();
      constexpr std::string_view kInstance = "__INSTANCE_NAME__";
      if (const std::size_t at = declared.find(kInstance); at != std::string::npos) {
        declared.replace(at, kInstance.size(), instance.str());
      }
      if (property.str() == declared) {
        return name.str();
      }
    }
  }
  return {};
}

void add_attribute(const stage::Prim& prim, Token property,
                   const std::vector<OpinionSource>& sources, Json& answer) {
  const stage::Attribute attribute = prim.attribute(property);
  static constexpr const char* kSources[] = {"none",        "fallback",   "default",
                                             "timeSamples", "valueClips", "spline"};
  const layer::Value value = attribute.get();
  answer["type"] = attribute.type_name().str();
  answer["value"] = value.empty() ? Json(nullptr) : Json(short_value_text(value));
  answer["source"] = kSources[static_cast<std::size_t>(attribute.value_source())];
  answer["sourceAtTimes"] =
      kSources[static_cast<std::size_t>(attribute.value_source(stage::Time(0.0)))];
  ValueJudge judge;
  for (const OpinionSource& source : sources) {
    judge.add(source);
  }
  if (const layer::Value fallback = attribute.fallback(); !fallback.empty()) {
    judge.add_fallback(fallback, declaring_schema(prim, property));
  }
  answer["opinions"] = judge.take();
  for (Json& row : list_rows(sources, fields::connectionPaths, false)) {
    answer["opinions"].push_back(std::move(row));
  }
}

void add_relationship(const stage::Prim& prim, Token property,
                      const std::vector<OpinionSource>& sources, Json& answer) {
  const stage::Relationship relationship = prim.relationship(property);
  answer["type"] = "rel";
  answer["value"] = Json::array();
  for (const Path& target : relationship.targets()) {
    answer["value"].push_back(target.str());
  }
  answer["source"] = relationship.has_authored_targets() ? "targets" : "none";
  answer["opinions"] = list_rows(sources, fields::targetPaths, true);
}

void add_ignored(const stage::Stage& stage, Path prim, Token property, Json& answer) {
  for (const OpinionSource& source : stage::ignored_below_instance(stage, prim, property)) {
    const layer::Value* value = source.spec->find(fields::default_value);
    value = value == nullptr ? source.spec->find(fields::targetPaths) : value;
    Json row = row_of(source, property.empty() ? "spec" : "value", value);
    row["verdict"] = "ignored";
    row["why"] = "it is authored below an instance, whose content is shared";
    answer["opinions"].push_back(std::move(row));
  }
}

/// "through variant Physics=physx (hand.usda:12), payload @payloads/Physics/physx.usda@".
std::string way_text(const Json& row) {
  std::string text;
  for (const Json& arc : row["arcs"]) {
    text += text.empty() ? "through " : ", ";
    text += arc["arc"].get<std::string>();
    text += arc.contains("set")
                ? " " + arc["set"].get<std::string>() + "=" + arc["variant"].get<std::string>()
                : " of <" + arc["to"].get<std::string>() + ">";
    if (!arc["file"].is_null()) {
      text += " (" + arc["file"].get<std::string>();
      text += arc["line"].is_null() ? ")" : ":" + std::to_string(arc["line"].get<unsigned>()) + ")";
    }
  }
  if (!row["sublayerOf"].is_null()) {
    text += (text.empty() ? "a sublayer of " : ", a sublayer of ") +
            row["sublayerOf"].get<std::string>();
  }
  return text;
}

/// The way there is said once for rows of one place.
std::string row_text(const Json& row, std::string& last_way) {
  const bool fallback = row["what"] == "fallback";
  const std::string verdict = row["verdict"].get<std::string>();
  const bool counts = verdict.starts_with("wins") || verdict == "combined";
  std::string text = counts ? "  > " : "    ";
  if (fallback) {
    text += "schema" + (row["schema"].is_null() ? "" : " " + row["schema"].get<std::string>());
  } else {
    text += place_text(row);
  }
  text += "  " + row["what"].get<std::string>();
  text += row["value"].is_null() ? "" : " = " + row["value"].get<std::string>();
  text += "  [" + verdict;
  text += row["why"].is_null() ? "]\n" : ": " + row["why"].get<std::string>() + "]\n";
  const std::string place = fallback ? "" : place_text(row);
  const std::string way = way_text(row);
  const bool known = last_way == place + way;
  last_way = place + way;
  return way.empty() || known ? text : text + "        " + way + "\n";
}

std::string value_line(const Json& answer) {
  if (!answer.contains("value")) {
    return "";
  }
  std::string text = "  value ";
  if (answer["value"].is_array()) {
    for (const Json& item : answer["value"]) {
      text += "<" + item.get<std::string>() + "> ";
    }
    return (answer["value"].empty() ? text + "none" : text) + "\n";
  }
  text += answer["value"].is_null() ? "none" : answer["value"].get<std::string>();
  return text + "  (" + answer["source"].get<std::string>() + ")\n";
}

}  // namespace

Json where_json(const stage::Stage& stage, const stage::Prim& prim, Token property) {
  Json answer = {{"prim", prim.path().str()},
                 {"property", property.empty() ? Json(nullptr) : Json(property.str())}};
  const auto sources = stage::opinion_sources(stage, prim.path(), property);
  if (property.empty()) {
    answer["type"] = prim.type_name().str();
    answer["opinions"] = prim_rows(sources);
  } else if (prim.is_relationship(property)) {
    add_relationship(prim, property, sources, answer);
  } else {
    add_attribute(prim, property, sources, answer);
  }
  add_ignored(stage, prim.path(), property, answer);
  return answer;
}

void add_other_variant(Json& answer, const Json& other, const std::string& selection) {
  const auto place = [](const Json& row) {
    return std::tuple(row["file"].dump(), row["path"].dump(), row["what"].dump());
  };
  std::set<std::tuple<std::string, std::string, std::string>> known;
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

std::string where_text(const Json& answer) {
  std::string text = answer["prim"].get<std::string>();
  text += answer["property"].is_null() ? "" : "." + answer["property"].get<std::string>();
  text += "  " + answer["type"].get<std::string>() + "\n" + value_line(answer);
  text += answer["opinions"].empty() ? "  no opinion\n" : "  opinions, strongest first\n";
  std::string last_way;
  for (const Json& row : answer["opinions"]) {
    text += row_text(row, last_way);
  }
  return text;
}

}  // namespace tenon::cli
