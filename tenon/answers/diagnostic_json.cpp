// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/answers/diagnostic_json.h"

#include <utility>

#include "tenon/answers/or_null.h"
#include "tenon/base/text/shown_path.h"

namespace tenon::answers {
namespace {

Json related_json(const RelatedPrim& prim) {
  return {{"path", prim.path},
          {"role", role_name(prim.role)},
          {"file", file_or_null(prim.file)},
          {"line", or_null(prim.line)},
          {"column", or_null(prim.column)}};
}

}  // namespace

Json diagnostic_json(const Diagnostic& d) {
  Json item = Json::object();
  item["severity"] = severity_name(d.severity);
  item["rule"] = or_null(d.rule);
  item["message"] = d.message;
  item["file"] = file_or_null(d.file);
  item["line"] = or_null(d.line);
  item["column"] = or_null(d.column);
  item["endLine"] = or_null(d.end_line);
  item["endColumn"] = or_null(d.end_column);
  item["prim"] = or_null(d.prim);
  item["property"] = or_null(d.property);
  item["fix"] = or_null(d.fix);
  item["related"] = Json::array();
  for (const RelatedPrim& prim : d.related) {
    item["related"].push_back(related_json(prim));
  }
  return item;
}

Json envelope_json(const Envelope& envelope, const Diagnostics& diagnostics, Json body) {
  Json json = Json::object();
  json["tool"] = "tenon";
  json["version"] = envelope.version;
  json["schema"] = "tenon." + envelope.verb + "/1";
  json["asset"] = or_null(envelope.asset);
  json["ok"] = envelope.ok;
  json["diagnostics"] = Json::array();
  for (const Diagnostic& d : diagnostics) {
    json["diagnostics"].push_back(diagnostic_json(d));
  }
  if (!envelope.settings.empty()) {
    json["settings"] = envelope.settings;
  }
  for (auto& [key, value] : body.get_ref<Json::object_t&>()) {
    json[key] = std::move(value);
  }
  return json;
}

void write_envelope(const Envelope& envelope, const Diagnostics& diagnostics,
                    const WriteMembers& body, JsonTextSink& sink) {
  const Json head = envelope_json(envelope, diagnostics, nothing());
  sink.begin_object();
  for (const auto& [key, value] : head.items()) {
    sink.key(key);
    sink.put(value);
  }
  body(sink);
  sink.end_object();
}

Json assets_json(std::vector<Json> answers) {
  Json list = Json::array();
  for (Json& answer : answers) {
    list.push_back(std::move(answer));
  }
  return {{"assets", std::move(list)}};
}

Json text_json(const std::string& text) { return {{"text", text}}; }

Json output_json(const std::string& output) { return {{"output", output}}; }

Json rule_page_json(const std::string& rule, std::string_view page) {
  return {{"rule", rule}, {"page", page}};
}

}  // namespace tenon::answers
