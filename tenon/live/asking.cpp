// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Requests that change nothing: what they answer is what the verbs of the command answer. A check
// opens the asset by itself and takes long, so it is a late answer.
#include <algorithm>
#include <utility>

#include "tenon/answers/opinions.h"
#include "tenon/answers/or_null.h"
#include "tenon/answers/tree_json.h"
#include "tenon/answers/where_opinions.h"
#include "tenon/asset/checking/check_assets.h"
#include "tenon/asset/checking/checked_json.h"
#include "tenon/live/session_state.h"

namespace tenon::live {
namespace {

/// A relationship's targets on one line, as an attribute's value is.
std::string targets_text(const stage::Prim& prim, Token name) {
  constexpr std::size_t kLongest = 400;
  std::string text;
  for (const Path& target : prim.relationship(name).targets()) {
    if (text.size() > kLongest) {
      return text + ", ...";
    }
    text += (text.empty() ? "<" : ", <") + target.str() + ">";
  }
  return text;
}

Json property_row(const stage::Prim& prim, Token name, bool authored) {
  if (prim.is_relationship(name)) {
    return {{"name", name.str()},
            {"type", "rel"},
            {"value", targets_text(prim, name)},
            {"authored", authored},
            {"source", authored ? "targets" : "none"}};
  }
  const stage::Attribute attribute = prim.attribute(name);
  const layer::Value value = attribute.get();
  return {{"name", name.str()},
          {"type", attribute.type_name().str()},
          {"value", value.empty() ? Json(nullptr) : Json(answers::short_value_text(value))},
          {"authored", authored},
          {"source", answers::source_name(attribute.value_source())}};
}

Json all_properties(const stage::Prim& prim) {
  std::vector<Token> authored = prim.authored_property_names();
  Json rows = Json::array();
  for (const Token name : authored) {
    rows.push_back(property_row(prim, name, true));
  }
  for (const Token name : prim.property_names()) {
    if (std::find(authored.begin(), authored.end(), name) == authored.end()) {
      rows.push_back(property_row(prim, name, false));
    }
  }
  return rows;
}

Result<stage::Prim> prim_at(const Session::State& state, Path path) {
  const stage::Prim prim = state.asset.stage->prim(path);
  if (!prim) {
    return Error(ErrorCode::NotFound, "there is no prim <" + path.str() + ">")
        .with_rule("live.not-found")
        .with_prim(path.str());
  }
  return prim;
}

}  // namespace

Result<Json> ask_tree(Session::State& state, ClientNumber, const Asked&, Outbox&) {
  return answers::prims_json(*state.asset.stage);
}

Result<Json> ask_inspect(Session::State& state, ClientNumber, const Asked& asked, Outbox&) {
  TENON_TRY(const stage::Prim prim, prim_at(state, asked.path("prim")));
  Json answer = answers::explain_prim(*state.asset.explained, prim);
  answer["all"] = all_properties(prim);
  return answer;
}

Result<Json> ask_where(Session::State& state, ClientNumber, const Asked& asked, Outbox&) {
  TENON_CHECK(answers::check_object(*state.asset.stage, asked.text("object")));
  TENON_TRY(const Path object, Path::parse(asked.text("object")));
  const Path owner = object.is_property() ? object.parent() : object;
  const Token property = object.is_property() ? object.name() : Token();
  TENON_TRY(const stage::Prim prim, prim_at(state, owner));
  const auto time = asked.has("time") ? std::optional<double>(asked.number("time")) : std::nullopt;
  return answers::where_json(*state.asset.stage, prim, property, time);
}

Result<Json> ask_explain(Session::State& state, ClientNumber, const Asked& asked, Outbox&) {
  return answers::explain_object(*state.asset.explained, asked.text("object"), asked.text("other"));
}

Result<Json> ask_findings(Session::State& state, ClientNumber, const Asked&, Outbox&) {
  CheckAssetsOptions options;
  options.check.open = state.options.asset.open;
  options.check.readings = state.options.asset.readings;
  state.later = [options, path = state.options.asset.path]() -> Result<Json> {
    TENON_TRY(const CheckedAssets checked, check_assets({path}, options));
    return checked_json(checked, "");
  };
  return Json();
}

}  // namespace tenon::live
