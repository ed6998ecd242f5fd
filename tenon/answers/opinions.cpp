// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The rows come from the traces in stage/values, strongest first, and not from a search of their
// own: "used" says what resolution did. A fallback is in no file and has no row. Values are put on
// one line of bounded length, list edits and selections in words.
#include "tenon/answers/opinions.h"

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "tenon/answers/list_item_text.h"
#include "tenon/answers/or_null.h"
#include "tenon/answers/specifier_word.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/formats/text/write/value_text.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/value.h"
#include "tenon/stage/values/field_trace.h"

namespace tenon::answers {
namespace {

constexpr std::size_t kLongestShown = 120;  ///< bytes of a value; longer ones are cut

Json place_json(const stage::SpecSite& site) {
  Json row = Json::object();
  row["file"] = shown_path(site.layer->identifier());
  row["line"] = site.spec->line == 0 ? Json(nullptr) : Json(site.spec->line);
  row["column"] = site.spec->line == 0 ? Json(nullptr) : Json(site.spec->column);
  row["path"] = site.path.str();
  return row;
}

/// "prepend </A>, append </B>" of a list edit; nothing for values that are none.
template <class T>
std::optional<std::string> list_text(const layer::Value& value) {
  const auto* op = value.get<layer::ListOp<T>>();
  if (op == nullptr) {
    return std::nullopt;
  }
  std::string text;
  const auto add = [&](const char* word, const std::vector<T>& items) {
    for (const T& item : items) {
      text += (text.empty() ? "" : ", ") + std::string(word) + item_text(item);
    }
  };
  add("", op->explicit_items);
  add("prepend ", op->prepended);
  add("append ", op->appended);
  add("add ", op->added);
  add("delete ", op->deleted);
  add("reorder ", op->ordered);
  return text.empty() ? "None" : text;
}

/// "Physics=physx" of variant selections; nothing for other values.
std::optional<std::string> selections_text(const layer::Value& value) {
  const auto* selections = value.get<layer::VariantSelections>();
  if (selections == nullptr) {
    return std::nullopt;
  }
  std::string text;
  for (const auto& [set, variant] : selections->items) {
    text += (text.empty() ? "" : ", ") + set + "=" + variant;
  }
  return text;
}

Json opinion_row(const stage::SpecSite& site, const std::string& what, const layer::Value* value,
                 stage::OpinionRole role) {
  Json row = place_json(site);
  row["what"] = what;
  row["value"] = value == nullptr ? Json(nullptr) : Json(short_value_text(*value));
  row["used"] = role == stage::OpinionRole::Wins || role == stage::OpinionRole::Combined;
  return row;
}

stage::SpecSite spec_site(const stage::OpinionSource& source) {
  return {source.layer, source.path, source.spec};
}

Json attribute_rows(const stage::Attribute& attribute, stage::Time time) {
  Json rows = Json::array();
  for (const stage::TracedOpinion& opinion : attribute.trace(time).opinions) {
    if (opinion.kind != stage::ValueSource::Fallback) {
      rows.push_back(
          opinion_row(spec_site(opinion.source), what_of(opinion), opinion.value, opinion.role));
      add_clip(opinion, rows.back());
    }
  }
  return rows;
}

Json relationship_rows(const stage::Stage& stage, const stage::Relationship& relationship) {
  Json rows = Json::array();
  const Path path = relationship.path();
  for (const auto& opinion : stage::trace_targets(stage, path.parent(), path.name())) {
    const char* const what = opinion.value == nullptr ? "declaration" : "targets";
    rows.push_back(opinion_row(spec_site(opinion.source), what, opinion.value, opinion.role));
  }
  return rows;
}

}  // namespace

std::string short_value_text(const layer::Value& value) {
  std::optional<std::string> list = selections_text(value);
  for (auto* text : {list_text<Path>, list_text<Token>, list_text<std::string>,
                     list_text<layer::Reference>, list_text<layer::Payload>}) {
    list = list ? list : text(value);
  }
  std::string text = list ? *list : formats::value_text(value);
  for (char& c : text) {
    c = c == '\n' ? ' ' : c;
  }
  if (text.size() <= kLongestShown) {
    return text;
  }
  std::size_t end = kLongestShown;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0u) == 0x80u) {
    --end;  // a character of several bytes stays whole or goes
  }
  return text.substr(0, end) + " ...";
}

const char* source_name(stage::ValueSource source) {
  static constexpr const char* kSources[] = {"none",        "fallback",   "default",
                                             "timeSamples", "valueClips", "spline"};
  return kSources[static_cast<std::size_t>(source)];
}

std::string what_of(const stage::TracedOpinion& opinion) {
  return opinion.kind == stage::ValueSource::None ? "declaration" : source_name(opinion.kind);
}

void add_clip(const stage::TracedOpinion& opinion, Json& row) {
  if (opinion.clip) {
    const std::string& layer = opinion.clip->layer;
    row["clipSet"] = opinion.clip->set;
    row["clip"] = file_or_null(layer);
    row["value"] = opinion.clip->set + (layer.empty() ? "" : " @" + shown_path(layer) + "@");
  }
}

Json opinions_json(const stage::Stage& stage, const stage::Prim& prim, Token property,
                   stage::Time time) {
  return prim.is_relationship(property) ? relationship_rows(stage, prim.relationship(property))
                                        : attribute_rows(prim.attribute(property), time);
}

Json specs_json(const stage::Prim& prim) {
  Json rows = Json::array();
  for (const stage::SpecSite& site : prim.spec_stack()) {
    Json row = place_json(site);
    const auto specifier = site.spec->get_or("specifier", layer::Specifier::Over);
    row["specifier"] = specifier_word(specifier);
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string place_text(const Json& row) {
  std::string text = row["file"].get<std::string>();
  if (!row["line"].is_null()) {
    text += ":" + std::to_string(row["line"].get<unsigned>()) + ":" +
            std::to_string(row["column"].get<unsigned>());
  }
  return text;
}

}  // namespace tenon::answers
