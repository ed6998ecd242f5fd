// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/authoring/matched_prims.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tenon/asset/authoring/requested_kinds.h"
#include "tenon/base/text/name_pattern.h"

namespace tenon {
namespace {

/// All prims below the root that are not inside of instances.
std::vector<stage::Prim> prims_of(const stage::Stage& stage) {
  std::vector<stage::Prim> prims;
  std::vector<stage::Prim> pending = stage.pseudo_root().children();
  while (!pending.empty()) {
    const stage::Prim prim = pending.back();
    pending.pop_back();
    if (!prim.is_active() || !prim.is_defined() || prim.is_abstract()) {
      continue;
    }
    prims.push_back(prim);
    if (!prim.is_instance()) {
      const std::vector<stage::Prim> children = prim.children();
      pending.insert(pending.end(), children.begin(), children.end());
    }
  }
  return prims;
}

/// A prim that a kind can be put on, and that has it not.
bool takes_kind(const stage::Prim& prim, const AuthoringKind& kind,
                const std::map<std::string, std::string>& options) {
  if (!kind.on.empty() && !prim.is_a(Token(kind.on))) {
    return false;
  }
  if (kind.name == "collider" && !prim.is_a("Gprim")) {
    return false;
  }
  if (kind.apis.empty()) {
    return true;
  }
  const bool instanced = kind.apis.front().find('*') != std::string_view::npos;
  if (instanced && prim.is_a("PhysicsFixedJoint")) {
    return false;  // no degree of freedom
  }
  const std::string instance = instanced ? instance_of(prim.type_name(), kind, options) : "";
  // Which degree of freedom of several is meant is asked where the kind is put on.
  return (instanced && instance.empty()) ||
         !prim.has_api(Token(with_instance(kind.apis.front(), instance)));
}

Error makes_prims(const AuthoringKind& kind) {
  return Error(ErrorCode::Invalid,
               "--match is for what is put on prims, and " + std::string(kind.name) + " makes one")
      .with_rule("edit.bad-argument")
      .with_fix("leave --match out, and name the path of the prim to make");
}

Result<std::vector<std::string>> matched(const Stages& stages, const std::string& text,
                                         const std::map<std::string, std::string>& options) {
  const std::size_t equals = text.rfind('=');
  const std::string names = equals == std::string::npos ? "" : text.substr(equals);
  TENON_TRY(const RequestedKinds asked, read_requested("/prim" + names, true));
  for (const AuthoringKind* kind : asked.kinds) {
    if (kind->makes_prim()) {
      return makes_prims(*kind);
    }
  }
  TENON_TRY(const NamePattern pattern, NamePattern::parse(text.substr(0, equals)));
  std::set<Path> found;
  bool any = false;
  for (const auto& stage : stages) {
    for (const stage::Prim& prim : prims_of(*stage)) {
      if (!pattern.matches(prim.path())) {
        continue;
      }
      any = true;
      if (std::all_of(asked.kinds.begin(), asked.kinds.end(), [&](const AuthoringKind* kind) {
            return takes_kind(prim, *kind, options);
          })) {
        found.insert(prim.path());
      }
    }
  }
  if (found.empty()) {
    return Error(ErrorCode::NotFound,
                 any ? "what \"" + pattern.text() + "\" means has it already, or cannot have it"
                     : "there is no prim that \"" + pattern.text() + "\" means")
        .with_rule("edit.no-prim")
        .with_fix(
            "give a name, a path, or a regular expression for the whole of either, as in "
            "'.*_collision=collider'");
  }
  std::vector<std::string> requests;
  for (const Path& path : found) {
    requests.push_back(path.str() + names);
  }
  return requests;
}

}  // namespace

Result<AuthoringRequest> matched_request(const Stages& stages, const AuthoringRequest& request) {
  AuthoringRequest made = request;
  made.match = false;
  made.what.clear();
  for (const std::string& text : request.what) {
    TENON_TRY(const std::vector<std::string> requests, matched(stages, text, request.options));
    made.what.insert(made.what.end(), requests.begin(), requests.end());
  }
  return made;
}

}  // namespace tenon
