// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/opinions.h"

#include <optional>

#include "cli/list_item_text.h"
#include "tenon/formats/text/value_text.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"
#include "tenon/layer/value.h"

namespace tenon::cli {
namespace {

constexpr std::size_t kLongest = 120;  ///< characters of a value; longer ones are cut

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

/// One field of a spec that speaks about the value; the first opinion of all counts.
class Rows {
 public:
  explicit Rows(bool combined) : combined_(combined) {}

  void add(const stage::SpecSite& site, const char* what, const layer::Value& value) {
    Json row = place_json(site);
    row["what"] = what;
    row["value"] = short_value_text(value);
    row["used"] = combined_ || !used_;
    used_ = true;
    rows_.push_back(std::move(row));
  }
  void add_declaration(const stage::SpecSite& site) {
    Json row = place_json(site);
    row["what"] = "declaration";
    row["value"] = nullptr;
    row["used"] = false;
    rows_.push_back(std::move(row));
  }
  Json take() { return std::move(rows_); }

 private:
  bool combined_;  ///< list edits of all opinions count together
  bool used_ = false;
  Json rows_ = Json::array();
};

Json attribute_rows(const stage::Attribute& attribute) {
  Rows rows(false);
  for (const stage::SpecSite& site : attribute.spec_stack()) {
    bool said = false;
    for (const char* field : {"timeSamples", "spline", "default"}) {
      if (const layer::Value* value = site.spec->find(Token(field))) {
        rows.add(site, field, *value);
        said = true;
      }
    }
    if (!said) {
      rows.add_declaration(site);
    }
  }
  return rows.take();
}

Json relationship_rows(const stage::Relationship& relationship) {
  Rows rows(true);
  for (const stage::SpecSite& site : relationship.spec_stack()) {
    if (const layer::Value* value = site.spec->find(Token("targetPaths"))) {
      rows.add(site, "targets", *value);
    } else {
      rows.add_declaration(site);
    }
  }
  return rows.take();
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
  return text.size() <= kLongest ? text : text.substr(0, kLongest) + " ...";
}

Json opinions_json(const stage::Prim& prim, Token property) {
  return prim.is_relationship(property) ? relationship_rows(prim.relationship(property))
                                        : attribute_rows(prim.attribute(property));
}

Json specs_json(const stage::Prim& prim) {
  Json rows = Json::array();
  for (const stage::SpecSite& site : prim.spec_stack()) {
    Json row = place_json(site);
    const auto specifier = site.spec->get_or("specifier", layer::Specifier::Over);
    row["specifier"] = specifier == layer::Specifier::Def     ? "def"
                       : specifier == layer::Specifier::Class ? "class"
                                                              : "over";
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

std::string opinions_text(const Json& opinions, const std::string& indent) {
  std::string text;
  bool used = false;
  for (const Json& row : opinions) {
    const bool counts = row["used"].get<bool>();
    const std::string value = row["value"].is_null() ? "" : row["value"].get<std::string>();
    text += indent + (counts ? "> " : "  ") + place_text(row) + "  " +
            row["what"].get<std::string>() + (value.empty() ? "" : " " + value);
    text += counts || value.empty() ? "\n" : used ? "  (weaker)\n" : "\n";
    used = used || counts;
  }
  return text;
}

}  // namespace tenon::cli
