// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Nothing of a message is used before its type is known, so that no untrusted text reaches code
// that would end the program: fields that the table does not have are refused, and with them
// everything that could be deep.
#include "tenon/live/messages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace tenon::live {
namespace {

constexpr std::size_t kLongestText = 32 << 10;
constexpr std::size_t kMostNumbers = 64;
constexpr std::size_t kMostRows = 256;
constexpr std::string_view kRequestTag = "do";
constexpr auto kText = FieldType::Text;
constexpr auto kObject = FieldType::Object;
constexpr auto kList = FieldType::List;
constexpr auto kNumber = FieldType::Number;
constexpr auto kInteger = FieldType::Integer;
constexpr auto kFlag = FieldType::Flag;

constexpr std::array kHello{
    Field{"protocol", kInteger, true, "of these messages"},
    Field{"version", kText, true, "of tenon"},
    Field{"client", kInteger, true, "number of this page"},
    Field{"asset", kText, true, "the file that is shown"},
    Field{"readOnly", kFlag, true, "edits are refused"},
};
constexpr std::array kScene{
    Field{"revision", kInteger, true, "of scene.glb: another number is another picture"},
    Field{"why", kText, true,
          "`open`, `variant`, `engine`, `reset`, `edit`, `undo`, `redo` or `file`"},
    Field{"engine", kText, true, "that simulates, or would"},
    Field{"engines", kList, true, "rows {`name`, `available`, `howToGet`}"},
    Field{"simulates", kFlag, true, "there is a model of the engine; else `problem` says why not"},
    Field{"problem", kObject, false, "a finding"},
    Field{"opening", kList, true, "findings that came up while the asset was opened, at most 50"},
    Field{"timeStep", kNumber, false, "[s]"},
    Field{"variants", kList, true, "rows {`prim`, `set`, `selection`, `options`}"},
    Field{"bodies", kList, true, "paths, in the order of pose frames"},
    Field{"joints", kList, true,
          "rows {`path`, `kind`, `enabled`, `follows`, `leader`: the first joint that it follows, "
          "or null, `dofs`: rows {`dof`, `angular`, `lower`, `upper`}, `position`, `drives`: rows "
          "{`dof`, `position`, `velocity`, `stiffness`, "
          "`damping`, `maxForce`}}"},
    Field{"canUndo", kFlag, true, "there is an edit to take back"},
    Field{"canRedo", kFlag, true, "there is one to make again"},
};
constexpr std::array kState{
    Field{"playing", kFlag, true, "time goes on"},
    Field{"time", kNumber, true, "[s] since the start"},
    Field{"speed", kNumber, true, "simulated seconds for each second that is wanted"},
    Field{"rate", kNumber, true, "the rate that is reached"},
    Field{"contacts", kInteger, true, "how many there are"},
    Field{"pulled", kInteger, true, "bodies being pulled"},
    Field{"events", kList, true,
          "what happened once since the start, the first 50: rows {`time`, `prim`, `what`}"},
    Field{"stopped", kObject, false,
          "a finding: the step that failed; the last poses before it stay until a reset"},
    Field{"outdated", kObject, false,
          "a finding: why changed files cannot be opened; what is shown is older than they are"},
};
constexpr std::array kPlots{
    Field{"time", kNumber, true, "[s]"},
    Field{"joints", kList, true, "positions of each joint, in the order of `scene` [rad, m]"},
    Field{"velocities", kList, true, "of each joint, likewise [rad/s, m/s]"},
    Field{"efforts", kList, true,
          "of each joint those of its drives [N m, N]; null where the engine does not tell"},
    Field{"targets", kList, true,
          "of each joint those of its drives: rows [position, velocity] in the same units"},
    Field{"bodies", kList, true,
          "of the first 256 bodies: linear velocity of the centre of mass [m/s], angular velocity "
          "[rad/s], world axes, as six numbers"},
    Field{"kinetic", kNumber, true, "[J]"},
    Field{"potential", kNumber, true, "[J]"},
};
constexpr std::array kContacts{
    Field{"time", kNumber, true, "[s]"},
    Field{"count", kInteger, true, "how many there are; `rows` has the first 1,000"},
    Field{"rows", kList, true,
          "{`collider0`, `collider1`, `body0`, `body1` (null: static), `point`, `normal`, `depth`, "
          "`force`: on collider1}"},
};
constexpr std::array kProgress{
    Field{"of", kText, true, "the request"},
    Field{"what", kText, true, "is being done"},
    Field{"done", kNumber, true, "of all of it, from 0 to 1"},
};
constexpr std::array kTested{
    Field{"engine", kText, true, "that ran the test"},
    Field{"test", kText, true, "`snap`, `step` or `sine`"},
    Field{"result", kObject, true,
          "as a row of `results` of `tenon tune --test --json`, and `signal`: {`time`, `command`, "
          "`position`, `velocity`, `effort`}, at most 500 points of each"},
};
constexpr std::array kAnswer{
    Field{"to", kText, true, "the request's name"},
    Field{"id", FieldType::Any, false, "the request's"},
    Field{"result", kObject, true, "the result of the request"},
};
constexpr std::array kError{
    Field{"to", kText, true, "the request's name, as far as it could be read"},
    Field{"id", FieldType::Any, false, "the request's"},
    Field{"error", kObject, true, "a finding"},
};
constexpr std::array kProblem{
    Field{"problem", kObject, true, "a finding: why a changed file is not shown, why time stopped"},
};

constexpr std::array kNotices{
    MessageInfo{"hello", kHello, "The first message to a page", ""},
    MessageInfo{"scene", kScene, "What there is to see and to steer; comes again when it changes",
                ""},
    MessageInfo{"state", kState, "Time, when it changes, four times a second while it goes on", ""},
    MessageInfo{"plots", kPlots, "A point of the plots, twenty times a second for who observes",
                ""},
    MessageInfo{"contacts", kContacts, "Where colliders touch, likewise", ""},
    MessageInfo{"progress", kProgress, "How far a long request of this page is, ten times a second",
                ""},
    MessageInfo{"tested", kTested, "What came of one drive, while `testDrives` goes on", ""},
    MessageInfo{"answer", kAnswer, "A request was done", ""},
    MessageInfo{"error", kError, "A request was not done", ""},
    MessageInfo{"problem", kProblem, "Something went wrong, not in a request", ""},
};

Error bad_field(const MessageInfo& info, std::string_view field, std::string_view why) {
  return Error(ErrorCode::Invalid, "`" + std::string(field) + "` of the request `" +
                                       std::string(info.name) + "` " + std::string(why))
      .with_rule("live.bad-field")
      .with_fix("docs/viewer.md lists the fields of every request");
}

bool is_text(const Json& value) {
  return value.is_string() && value.get_ref<const std::string&>().size() <= kLongestText;
}

bool is_prim_path(const Json& value) {
  if (!is_text(value)) {
    return false;
  }
  const auto path = Path::parse(value.get_ref<const std::string&>());
  return path && path->is_absolute() && path->is_prim_or_root() && !path->has_variants();
}

bool is_number(const Json& value) {
  return value.is_number() && std::isfinite(value.get<double>());
}

bool are_numbers(const Json& value) {
  return value.is_array() && value.size() <= kMostNumbers &&
         std::all_of(value.begin(), value.end(), is_number);
}

bool are_paths(const Json& value) {
  return value.is_array() && value.size() <= kMostRows &&
         std::all_of(value.begin(), value.end(), is_prim_path);
}

bool are_rows(const Json& value) {
  return value.is_array() && value.size() <= kMostRows &&
         std::all_of(value.begin(), value.end(), [](const Json& row) { return row.is_object(); });
}

/// What values of a type are, and whether one is.
struct TypeRule {
  std::string_view wanted;
  bool (*holds)(const Json& value);
};

TypeRule rule_of_type(FieldType type) {
  switch (type) {
    case FieldType::Text:
      return {"must be a string", is_text};
    case FieldType::Path:
      return {"must be the absolute path of a prim", is_prim_path};
    case FieldType::Number:
      return {"must be a finite number", is_number};
    case FieldType::Integer:
      return {"must be a whole number",
              [](const Json& value) { return value.is_number_unsigned(); }};
    case FieldType::Flag:
      return {"must be true or false", [](const Json& value) { return value.is_boolean(); }};
    case FieldType::Point:
      return {"must be three finite numbers",
              [](const Json& value) { return are_numbers(value) && value.size() == 3; }};
    case FieldType::Numbers:
      return {"must be a list of at most 64 finite numbers", are_numbers};
    case FieldType::Paths:
      return {"must be a list of at most 256 absolute paths of prims", are_paths};
    case FieldType::Rows:
      return {"must be a list of at most 256 objects", are_rows};
    case FieldType::Object:
    case FieldType::List:
    case FieldType::Any:
      break;
  }
  return {"is not a type of requests", [](const Json&) { return false; }};
}

/// What is wrong with a value of a field; empty: nothing.
std::string fault_of(const Field& field, const Json& value) {
  if (value.is_null() && !field.required) {
    return {};
  }
  const TypeRule rule = rule_of_type(field.type);
  const bool counts = field.type == FieldType::Integer;
  if (rule.holds(value) && !(counts && value.get<std::uint64_t>() > field.most)) {
    return {};
  }
  return std::string(rule.wanted) + (counts ? " from 0 to " + std::to_string(field.most) : "");
}

/// The first fault of the rows of a field: "has a row whose `joint` is missing".
std::string fault_of_rows(const Field& field, const Json& rows) {
  const std::string begin = "has a row whose `";
  for (const Json& row : rows) {
    for (const auto& [key, value] : row.items()) {
      const auto known =
          std::find_if(field.row.begin(), field.row.end(),
                       [&wanted = key](const Field& one) { return one.name == wanted; });
      if (known == field.row.end()) {
        return begin + key.substr(0, 64) + "` is not known";
      }
      if (const std::string fault = fault_of(*known, value); !fault.empty()) {
        return begin + key + "` " + fault;
      }
    }
    for (const Field& one : field.row) {
      if (one.required && !row.contains(std::string(one.name))) {
        return begin + std::string(one.name) + "` is missing";
      }
    }
  }
  return {};
}

Result<void> check_fields(const MessageInfo& info, const Json& message) {
  for (const auto& [key, value] : message.items()) {
    const auto field =
        std::find_if(info.fields.begin(), info.fields.end(),
                     [&wanted = key](const Field& one) { return one.name == wanted; });
    if (key == "do" || key == "id") {
      continue;
    }
    if (field == info.fields.end()) {
      return bad_field(info, key.substr(0, 64), "is not known");
    }
    if (const std::string fault = fault_of(*field, value); !fault.empty()) {
      return bad_field(info, key, fault);
    }
    if (field->type == FieldType::Rows && value.is_array()) {
      if (const std::string fault = fault_of_rows(*field, value); !fault.empty()) {
        return bad_field(info, key, fault);
      }
    }
  }
  for (const Field& field : info.fields) {
    if (field.required && !message.contains(std::string(field.name))) {
      return bad_field(info, field.name, "is missing");
    }
  }
  return {};
}

Json schema_of(FieldType type) {
  const Json number = {{"type", "number"}};
  switch (type) {
    case FieldType::Text:
      return {{"type", "string"}, {"maxLength", kLongestText}};
    case FieldType::Path:
      return {{"type", "string"}, {"pattern", "^/"}};
    case FieldType::Number:
      return {{"type", "number"}};
    case FieldType::Integer:
      return {{"type", "integer"}, {"minimum", 0}};
    case FieldType::Flag:
      return {{"type", "boolean"}};
    case FieldType::Point:
      return {{"type", "array"}, {"items", number}, {"minItems", 3}, {"maxItems", 3}};
    case FieldType::Numbers:
      return {{"type", "array"}, {"items", number}, {"maxItems", kMostNumbers}};
    case FieldType::Paths:
      return {{"type", "array"}, {"items", schema_of(FieldType::Path)}, {"maxItems", kMostRows}};
    case FieldType::Rows:
      return {{"type", "array"}, {"items", {{"type", "object"}}}, {"maxItems", kMostRows}};
    case FieldType::Object:
      return {{"type", "object"}};
    case FieldType::List:
      return {{"type", "array"}};
    case FieldType::Any:
      break;
  }
  return Json::object();
}

Json row_schema(const Field& rows) {
  Json properties = Json::object();
  Json required = Json::array();
  for (const Field& field : rows.row) {
    Json schema = schema_of(field.type);
    if (!field.required) {
      schema["type"] = Json::array({schema["type"], "null"});
    } else {
      required.push_back(field.name);
    }
    schema["description"] = field.meaning;
    properties[std::string(field.name)] = std::move(schema);
  }
  return {{"type", "object"},
          {"properties", std::move(properties)},
          {"required", std::move(required)},
          {"additionalProperties", false}};
}

Json message_schema(const MessageInfo& info, std::string_view tag) {
  Json properties = {{std::string(tag), {{"const", info.name}}}};
  Json required = Json::array({tag});
  for (const Field& field : info.fields) {
    Json schema = schema_of(field.type);
    if (field.type == FieldType::Integer && tag == kRequestTag) {
      schema["maximum"] = field.most;
    }
    if (!field.row.empty()) {
      schema["items"] = row_schema(field);
    }
    if (!field.required && schema.contains("type")) {
      schema["type"] = Json::array({schema["type"], "null"});
    }
    schema["description"] = field.meaning;
    properties[std::string(field.name)] = std::move(schema);
    if (field.required) {
      required.push_back(field.name);
    }
  }
  return {{"type", "object"},
          {"properties", std::move(properties)},
          {"required", std::move(required)},
          {"additionalProperties", false}};
}

}  // namespace

std::span<const MessageInfo> notices() { return kNotices; }

Json messages_json(std::span<const MessageInfo> requests) {
  Json asked = Json::array();
  for (const MessageInfo& info : requests) {
    Json schema = message_schema(info, kRequestTag);
    schema["properties"]["id"] = {{"description", "any number or text; comes back in the answer"}};
    asked.push_back({{"name", info.name},
                     {"meaning", info.meaning},
                     {"answer", info.answer},
                     {"schema", std::move(schema)}});
  }
  Json told = Json::array();
  for (const MessageInfo& info : kNotices) {
    told.push_back(
        {{"name", info.name}, {"meaning", info.meaning}, {"schema", message_schema(info, "is")}});
  }
  return {{"protocol", kProtocol}, {"requests", std::move(asked)}, {"notices", std::move(told)}};
}

bool Asked::has(std::string_view field) const {
  const auto found = fields_.find(std::string(field));
  return found != fields_.end() && !found->is_null();
}
std::string Asked::text(std::string_view field) const {
  return has(field) ? fields_[std::string(field)].get<std::string>() : std::string();
}
double Asked::number(std::string_view field, double otherwise) const {
  return has(field) ? fields_[std::string(field)].get<double>() : otherwise;
}
std::uint32_t Asked::integer(std::string_view field, std::uint32_t otherwise) const {
  return has(field) ? fields_[std::string(field)].get<std::uint32_t>() : otherwise;
}
bool Asked::flag(std::string_view field, bool otherwise) const {
  return has(field) ? fields_[std::string(field)].get<bool>() : otherwise;
}
Vec3d Asked::point(std::string_view field) const {
  const std::vector<double> list = numbers(field);
  return list.size() == 3 ? Vec3d{{list[0], list[1], list[2]}} : Vec3d();
}
std::vector<double> Asked::numbers(std::string_view field) const {
  std::vector<double> list;
  if (has(field)) {
    for (const Json& item : fields_[std::string(field)]) {
      list.push_back(item.get<double>());
    }
  }
  return list;
}
Path Asked::path(std::string_view field) const { return Path::parse(text(field)).value_or(Path()); }
std::vector<Path> Asked::paths(std::string_view field) const {
  std::vector<Path> list;
  if (has(field)) {
    for (const Json& item : fields_[std::string(field)]) {
      list.push_back(Path::parse(item.get<std::string>()).value_or(Path()));
    }
  }
  return list;
}
std::vector<Asked> Asked::rows(std::string_view field) const {
  std::vector<Asked> list;
  if (has(field)) {
    for (const Json& item : fields_[std::string(field)]) {
      list.emplace_back().fields_ = item;
    }
  }
  return list;
}

Result<std::size_t> Listener::read(std::string_view text, Asked& asked) const {
  asked.fields_ = answers::parsed(text);
  const Json& message = asked.fields_;
  if (!message.is_object() || !message.contains("do") || !message["do"].is_string()) {
    return Error(ErrorCode::Parse, "a message must be a JSON object with `do`, the request's name")
        .with_rule("live.bad-message");
  }
  if (message.contains("id") && (message["id"].is_number() || message["id"].is_string())) {
    asked.id_ = message["id"];
  }
  asked.name_ = message["do"].get<std::string>().substr(0, 64);
  const auto known = std::find_if(requests_.begin(), requests_.end(), [&](const MessageInfo& info) {
    return info.name == asked.name_;
  });
  if (known == requests_.end()) {
    return Error(ErrorCode::NotFound, "there is no request `" + asked.name_ + "`")
        .with_rule("live.unknown-request")
        .with_fix("the request `messages` tells which there are");
  }
  TENON_CHECK(check_fields(*known, message));
  return static_cast<std::size_t>(known - requests_.begin());
}

}  // namespace tenon::live
