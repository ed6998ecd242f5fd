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

#include "tenon/live/shapes.h"

namespace tenon::live {
namespace {

constexpr std::size_t kLongestText = 32 << 10;
constexpr std::size_t kMostNumbers = 64;
constexpr std::size_t kMostRows = 256;
constexpr auto kObject = FieldType::Object;

constexpr std::array kHello{
    Field{"protocol", kInteger, true, "of these messages"},
    Field{"version", kText, true, "of tenon"},
    Field{"client", kInteger, true, "number of this page"},
    Field{"asset", kText, true, "the file that is shown"},
    Field{"readOnly", kFlag, true, "edits are refused"},
};
constexpr std::array kEngineChoice{
    Field{"name", kText},
    Field{"available", kFlag},
    Field{"howToGet", kText, false},
};
constexpr Shape kEngineRow{"EngineChoice", kEngineChoice};
constexpr std::array kVariantChoice{
    Field{"prim", kPath},
    Field{"set", kText},
    Field{"selection", kText},
    list("options", kEachText),
};
constexpr Shape kVariantRow{"VariantChoice", kVariantChoice};
constexpr std::array kLiveDofFields{
    Field{"dof", kText, true, "`transX` to `rotZ`"},
    Field{"angular", kFlag},
    Field{"lower", kNumber, false, "[rad, m]; null: no limit"},
    Field{"upper", kNumber, false, "likewise"},
};
constexpr Shape kLiveDof{"LiveDof", kLiveDofFields};
constexpr std::array kLiveDriveFields{
    Field{"dof", kText},
    Field{"position", kNumber, true, "its target [rad, m]"},
    Field{"velocity", kNumber, true, "likewise [rad/s, m/s]"},
    Field{"stiffness", kNumber, true, "[N m/rad, N/m]"},
    Field{"damping", kNumber, true, "[N m s/rad, N s/m]"},
    Field{"maxForce", kNumber, false, "[N m, N]; null: no limit"},
};
constexpr Shape kLiveDrive{"LiveDrive", kLiveDriveFields};
constexpr std::array kLiveJointFields{
    Field{"path", kPath},
    Field{"kind", kText},
    Field{"enabled", kFlag},
    Field{"follows", kFlag, true, "another joint"},
    Field{"leader", kPath, false, "the first joint that it follows"},
    rows("dofs", kLiveDof),
    Field{"position", kNumbers, true, "[rad, m]"},
    rows("drives", kLiveDrive),
};
constexpr Shape kLiveJoint{"LiveJoint", kLiveJointFields};
constexpr std::array kScene{
    Field{"revision", kInteger, true, "of scene.glb: another number is another picture"},
    Field{"why", kText, true,
          "`open`, `variant`, `engine`, `reset`, `edit`, `undo`, `redo` or `file`"},
    Field{"engine", kText, true, "that simulates, or would"},
    rows("engines", kEngineRow, "that there are"),
    Field{"simulates", kFlag, true, "there is a model of the engine; else `problem` says why not"},
    object("problem", kFinding, false, "why there is no model"),
    rows("opening", kFinding, "what came up while the asset was opened, at most 50"),
    Field{"timeStep", kNumber, false, "[s]"},
    rows("variants", kVariantRow, "that can be selected"),
    Field{"bodies", kPaths, true, "in the order of pose frames"},
    rows("joints", kLiveJoint, "of the asset"),
    Field{"canUndo", kFlag, true, "there is an edit to take back"},
    Field{"canRedo", kFlag, true, "there is one to make again"},
};
constexpr std::array kEventFields{
    Field{"time", kNumber, true, "[s]"},
    Field{"prim", kText},
    Field{"what", kText},
};
constexpr Shape kEvent{"EngineEvent", kEventFields};
constexpr std::array kState{
    Field{"playing", kFlag, true, "time goes on"},
    Field{"time", kNumber, true, "[s] since the start"},
    Field{"speed", kNumber, true, "simulated seconds for each second that is wanted"},
    Field{"rate", kNumber, true, "the rate that is reached"},
    Field{"contacts", kInteger, true, "how many there are"},
    Field{"pulled", kInteger, true, "bodies being pulled"},
    rows("events", kEvent, "what happened once since the start, the first 50"),
    object("stopped", kFinding, false,
           "the step that failed; the last poses before it stay until a reset"),
    object("outdated", kFinding, false,
           "why changed files cannot be opened; what is shown is older than they are"),
};
constexpr Field kEfforts{"", kNumbers, false};
constexpr Field kTargets = list("", kEachNumbers);
constexpr std::array kPlots{
    Field{"time", kNumber, true, "[s]"},
    list("joints", kEachNumbers, "positions of each joint, in the order of `scene` [rad, m]"),
    list("velocities", kEachNumbers, "of each joint, likewise [rad/s, m/s]"),
    list("efforts", kEfforts,
         "of each joint those of its drives [N m, N]; null where the engine does not tell"),
    list("targets", kTargets,
         "of each joint those of its drives: position and velocity in the same units"),
    list("bodies", kEachNumbers,
         "of the first 256 bodies: linear velocity of the centre of mass [m/s], angular velocity "
         "[rad/s], world axes, as six numbers"),
    Field{"kinetic", kNumber, true, "[J]"},
    Field{"potential", kNumber, true, "[J]"},
};
constexpr std::array kContactFields{
    Field{"collider0", kPath},
    Field{"collider1", kPath},
    Field{"body0", kPath, false, "null: static"},
    Field{"body1", kPath, false, "likewise"},
    Field{"point", kPoint, true, "[m]"},
    Field{"normal", kPoint},
    Field{"depth", kNumber, true, "[m]"},
    Field{"force", kPoint, true, "on collider1 [N]"},
};
constexpr Shape kContact{"ContactRow", kContactFields};
constexpr std::array kContacts{
    Field{"time", kNumber, true, "[s]"},
    Field{"count", kInteger, true, "how many there are; `rows` has the first 1,000"},
    rows("rows", kContact, "world axes"),
};
constexpr std::array kProgress{
    Field{"of", kText, true, "the request"},
    Field{"what", kText, true, "is being done"},
    Field{"done", kNumber, true, "of all of it, from 0 to 1"},
};
constexpr std::array kTestedFields{
    Field{"engine", kText, true, "that ran the test"},
    Field{"test", kText, true, "`snap`, `step` or `sine`"},
    object("result", kTested, true, "with `signal`, at most 500 points of each"),
};
constexpr std::array kAnswer{
    Field{"to", kText, true, "the request's name"},
    Field{"id", FieldType::Any, false, "the request's"},
    Field{"result", kObject, true, "the result of the request"},
};
constexpr std::array kError{
    Field{"to", kText, true, "the request's name, as far as it could be read"},
    Field{"id", FieldType::Any, false, "the request's"},
    object("error", kFinding, true, "why not"),
};
constexpr std::array kProblem{
    object("problem", kFinding, true, "why a changed file is not shown, why time stopped"),
};

constexpr std::array kNotices{
    MessageInfo{"hello", kHello, "The first message to a page"},
    MessageInfo{"scene", kScene, "What there is to see and to steer; comes again when it changes"},
    MessageInfo{"state", kState, "Time, when it changes, four times a second while it goes on"},
    MessageInfo{"plots", kPlots, "A point of the plots, twenty times a second for who observes"},
    MessageInfo{"contacts", kContacts, "Where colliders touch, likewise"},
    MessageInfo{"progress", kProgress,
                "How far a long request of this page is, ten times a second"},
    MessageInfo{"tested", kTestedFields, "What came of one drive, while `testDrives` goes on"},
    MessageInfo{"answer", kAnswer, "A request was done"},
    MessageInfo{"error", kError, "A request was not done"},
    MessageInfo{"problem", kProblem, "Something went wrong, not in a request"},
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
  const std::span<const Field> fields = field.shape->fields;
  for (const Json& row : rows) {
    for (const auto& [key, value] : row.items()) {
      const auto known =
          std::find_if(fields.begin(), fields.end(),
                       [&wanted = key](const Field& one) { return one.name == wanted; });
      if (known == fields.end()) {
        return begin + key.substr(0, 64) + "` is not known";
      }
      if (const std::string fault = fault_of(*known, value); !fault.empty()) {
        return begin + key + "` " + fault;
      }
    }
    for (const Field& one : fields) {
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

/// Requests have limits; notices and answers have every field that is required.
enum class Side : std::uint8_t { Asked, Told };

Json object_schema(const Shape& shape, Side side);
Json field_schema(const Field& field, Side side);

Json list_schema(Json items, std::size_t most, Side side) {
  Json schema = {{"type", "array"}, {"items", std::move(items)}};
  if (side == Side::Asked) {
    schema["maxItems"] = most;
  }
  return schema;
}

/// Without what null and the meaning of the field add.
Json value_schema(const Field& field, Side side) {
  Json number = {{"type", "number"}};
  Json path = {{"type", "string"}, {"pattern", "^/"}};
  switch (field.type) {
    case FieldType::Text:
      return side == Side::Told ? Json{{"type", "string"}}
                                : Json{{"type", "string"}, {"maxLength", kLongestText}};
    case FieldType::Path:
      return path;
    case FieldType::Number:
      return number;
    case FieldType::Integer:
      return side == Side::Told
                 ? Json{{"type", "integer"}, {"minimum", 0}}
                 : Json{{"type", "integer"}, {"minimum", 0}, {"maximum", field.most}};
    case FieldType::Flag:
      return {{"type", "boolean"}};
    case FieldType::Point:
      return {{"type", "array"}, {"items", number}, {"minItems", 3}, {"maxItems", 3}};
    case FieldType::Numbers:
      return list_schema(number, kMostNumbers, side);
    case FieldType::Paths:
      return list_schema(path, kMostRows, side);
    case FieldType::Rows:
      return list_schema(object_schema(*field.shape, side), kMostRows, side);
    case FieldType::Object:
      return field.shape == nullptr ? Json{{"type", "object"}} : object_schema(*field.shape, side);
    case FieldType::List:
      return list_schema(field_schema(*field.item, side), 0, side);
    case FieldType::Any:
      break;
  }
  return Json::object();
}

Json field_schema(const Field& field, Side side) {
  Json schema = value_schema(field, side);
  if (!field.required && schema.contains("type")) {
    schema["type"] = Json::array({schema["type"], "null"});
  }
  if (!field.meaning.empty()) {
    schema["description"] = field.meaning;
  }
  return schema;
}

Json object_schema(const Shape& shape, Side side) {
  Json properties = Json::object();
  Json required = Json::array();
  for (const Field& field : shape.fields) {
    properties[std::string(field.name)] = field_schema(field, side);
    if (side == Side::Told ? !field.may_miss : field.required) {
      required.push_back(field.name);
    }
  }
  Json schema = {{"type", "object"}};
  if (!shape.name.empty()) {
    schema["title"] = shape.name;
  }
  if (!shape.verb.empty()) {
    schema["$comment"] = "as `tenon " + std::string(shape.verb) + " --json`";
  }
  schema["properties"] = std::move(properties);
  schema["required"] = std::move(required);
  schema["additionalProperties"] = !shape.verb.empty();
  return schema;
}

/// Of a whole message, whose kind `tag` names.
Json message_schema(const MessageInfo& info, const char* tag, Side side) {
  Json schema = object_schema({.fields = info.fields}, side);
  schema["properties"][tag] = {{"const", info.name}};
  schema["required"].push_back(tag);
  return schema;
}

}  // namespace

std::span<const MessageInfo> notices() { return kNotices; }

Json messages_json(std::span<const MessageInfo> requests) {
  Json asked = Json::array();
  for (const MessageInfo& info : requests) {
    Json schema = message_schema(info, "do", Side::Asked);
    schema["properties"]["id"] = {{"description", "any number or text; comes back in the answer"}};
    const Shape result = info.answer == nullptr ? Shape() : *info.answer;
    asked.push_back({{"name", info.name},
                     {"meaning", info.meaning},
                     {"schema", std::move(schema)},
                     {"result", object_schema(result, Side::Told)}});
  }
  Json told = Json::array();
  for (const MessageInfo& info : kNotices) {
    told.push_back({{"name", info.name},
                    {"meaning", info.meaning},
                    {"schema", message_schema(info, "is", Side::Told)}});
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
