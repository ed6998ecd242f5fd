// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What a command line names is looked for in the table of kinds and in the stage of each selection,
// so that every mistake in it is reported before there is an edit.
#include "tenon/asset/authoring/requested_kinds.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "tenon/base/text/comma_list.h"
#include "tenon/base/text/nearest_name.h"
#include "tenon/property_value.h"
#include "tenon/schema/registry.h"

namespace tenon {
namespace {

std::string listed_kinds() { return comma_list(kind_names()); }

/// Other names of kinds, as other programs call them.
constexpr std::pair<std::string_view, std::string_view> kOtherNames[] = {
    {"box", "cube"},
    {"ball", "sphere"},
    {"hinge", "revolute"},
    {"slider", "prismatic"},
    {"linear", "prismatic"},
    {"continuous", "revolute"},
    {"ball-joint", "spherical"},
    {"weld", "fixed"},
    {"rigid-body", "body"},
    {"rigidbody", "body"},
    {"collision", "collider"},
    {"motor", "drive"},
    {"actuator", "drive"},
    {"ground", "plane"},
    {"group", "xform"},
};

/// Empty: none is near.
std::string kind_meant(const std::string& name) {
  for (const auto& [other, kind] : kOtherNames) {
    if (name == other && find_kind(kind) != nullptr) {
      return std::string(kind);
    }
  }
  const std::vector<std::string> names = kind_names();
  const std::vector<std::string_view> views(names.begin(), names.end());
  return std::string(nearest_name(name, views));
}

Error unknown_kind(const std::string& name) {
  const std::string meant = kind_meant(name);
  const bool known = !meant.empty();
  return Error(ErrorCode::Invalid,
               "unknown kind \"" + name + "\"" + (known ? "; did you mean \"" + meant + "\"?" : ""))
      .with_rule("edit.unknown-kind")
      .with_fix(known ? "write " + meant + "; `tenon help add` lists all kinds"
                      : "the kinds are: " + listed_kinds());
}

std::string options_of(const AuthoringKind& kind) {
  std::string text;
  for (const AuthoringOption& option : authoring_options()) {
    if (kind.takes(option.name)) {
      text += (text.empty() ? "--" : ", --") + std::string(option.name);
    }
  }
  return text.empty() ? "no options" : text;
}

/// The kind that takes an option and is put on a prim beside `kinds`; null where none or several
/// do.
const AuthoringKind* missing_kind(std::string_view option,
                                  const std::vector<const AuthoringKind*>& kinds) {
  const AuthoringKind* found = nullptr;
  for (const AuthoringKind& kind : authoring_kinds()) {
    const bool fits = std::any_of(kinds.begin(), kinds.end(), [&](const AuthoringKind* one) {
      return kind.on.empty() ? one->takes_pose() || !one->makes_prim() : one->type == kind.on;
    });
    if (!kind.makes_prim() && fits && kind.takes(option)) {
      if (found != nullptr) {
        return nullptr;
      }
      found = &kind;
    }
  }
  return found;
}

Error untaken(const std::string& option, const std::vector<const AuthoringKind*>& kinds) {
  std::string names;
  std::string list;
  for (const AuthoringKind* kind : kinds) {
    names += (names.empty() ? "" : kind == kinds.back() ? " and " : ", ") + std::string(kind->name);
    list += std::string(kind->name) + ",";
  }
  std::string fix = "leave it out";
  if (!kinds.empty()) {
    const AuthoringKind* missing = missing_kind(option, kinds);
    const std::string first(kinds.front()->name);
    fix = missing == nullptr ? first + " takes " + options_of(*kinds.front())
                             : "it belongs to " + std::string(missing->name) + ": write " + list +
                                   std::string(missing->name);
  }
  return Error(ErrorCode::Invalid, "--" + option + " is not an option of " + names)
      .with_rule("edit.bad-argument")
      .with_fix(fix);
}

}  // namespace

Result<RequestedKinds> read_requested(const std::string& text, bool kinds_needed) {
  const std::size_t equals = text.find('=');
  const std::string place = text.substr(0, equals);
  const auto path = Path::parse(place);
  if (!path || !path->is_absolute() || !path->is_prim() || path->has_variants()) {
    return not_a_path(place, "prim");
  }
  RequestedKinds requested{*path, {}};
  if (equals == std::string::npos) {
    if (!kinds_needed) {
      return requested;
    }
    return Error(ErrorCode::Invalid, "\"" + text + "\" does not say what to add")
        .with_rule("edit.bad-argument")
        .with_fix("write PATH=KIND, as in /World/box=cube; the kinds are: " + listed_kinds());
  }
  for (std::size_t begin = equals + 1; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string name = text.substr(begin, end - begin);
    const AuthoringKind* kind = find_kind(name);
    if (kind == nullptr) {
      return unknown_kind(name);
    }
    requested.kinds.push_back(kind);
    begin = end + 1;
  }
  return requested;
}

Result<void> check_options(const AuthoringRequest& request,
                           const std::vector<RequestedKinds>& requested) {
  std::vector<const AuthoringKind*> kinds;
  for (const RequestedKinds& one : requested) {
    kinds.insert(kinds.end(), one.kinds.begin(), one.kinds.end());
  }
  for (const auto& [name, value] : request.options) {
    const bool taken =
        std::any_of(kinds.begin(), kinds.end(),
                    [&, &option = name](const AuthoringKind* kind) { return kind->takes(option); });
    if (!taken) {
      return untaken(name, kinds);
    }
  }
  for (const AuthoringKind* kind : kinds) {
    for (const std::string_view need : kind->needs) {
      if (!request.options.contains(std::string(need))) {
        return Error(ErrorCode::Invalid, std::string(kind->name) + " needs --" + std::string(need))
            .with_rule("edit.bad-argument")
            .with_fix("it takes " + options_of(*kind));
      }
    }
  }
  return {};
}

Path robot_list(const Stages& stages, Path prim, const char* list) {
  for (Path at = prim.parent(); !at.empty() && !at.is_absolute_root(); at = at.parent()) {
    const stage::Prim robot = find_in(stages, at);
    if (robot && robot.has_api(Token("IsaacRobotAPI"))) {
      const bool has_list = !robot.relationship(Token(list)).targets().empty();
      return has_list ? at.property(Token(list)) : Path();
    }
  }
  return {};
}

stage::Prim find_in(const Stages& stages, Path prim) {
  for (const auto& stage : stages) {
    if (const stage::Prim found = stage->prim(prim)) {
      return found;
    }
  }
  return {};
}

Result<stage::Prim> need_in(const Stages& stages, Path prim) {
  if (const stage::Prim found = find_in(stages, prim)) {
    return found;
  }
  return Error(ErrorCode::NotFound, "there is no prim <" + prim.str() + ">, in no variant")
      .with_prim(prim.str())
      .with_rule("edit.no-prim")
      .with_fix("tenon tree lists all prims");
}

bool has_own_limits(Token joint) {
  const schema::Registry& registry = schema::Registry::instance();
  return registry.is_a(joint, Token("PhysicsRevoluteJoint")) ||
         registry.is_a(joint, Token("PhysicsPrismaticJoint"));
}

std::string instance_of(Token joint, const AuthoringKind& kind,
                        const std::map<std::string, std::string>& options) {
  if (const auto given = options.find("dof"); given != options.end()) {
    return given->second;
  }
  const schema::Registry& registry = schema::Registry::instance();
  if (kind.name == "limit") {
    return registry.is_a(joint, Token("PhysicsDistanceJoint")) ? "distance" : "";
  }
  return registry.is_a(joint, Token("PhysicsRevoluteJoint"))    ? "angular"
         : registry.is_a(joint, Token("PhysicsPrismaticJoint")) ? "linear"
                                                                : "";
}

std::string with_instance(std::string_view name, const std::string& instance) {
  std::string text(name);
  const std::size_t star = text.find('*');
  return star == std::string::npos ? text : text.replace(star, 1, instance);
}

}  // namespace tenon
