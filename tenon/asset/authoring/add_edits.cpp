// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A kind becomes plain edits: the prim, its schemas, then the properties, whose types are known by
// these. What a kind means beyond its row of the table has a function here: places, arcs, joints
// with their frames, gravity's ground, limits of hinges, mimics of PhysX, variants.
#include "tenon/asset/authoring/add_edits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "tenon/asset/authoring/joint_placement.h"
#include "tenon/asset/authoring/matched_prims.h"
#include "tenon/asset/authoring/mesh_file.h"
#include "tenon/asset/authoring/requested_kinds.h"
#include "tenon/asset/typed_edits.h"
#include "tenon/base/assignment.h"
#include "tenon/base/text/text_number.h"
#include "tenon/bytes/asset_resolver.h"
#include "tenon/schema/registry.h"

namespace tenon {
namespace {

using AddedEdits = std::vector<AssetEdit>;
using Verdict = AssetEdit::Kind;

Error bad_option(Path prim, const Message& message, const std::string& fix,
                 const std::string& rule = "edit.bad-argument") {
  return Error(ErrorCode::Invalid, message).with_prim(prim.str()).with_rule(rule).with_fix(fix);
}

std::string float_text(double value) { return shortest(static_cast<float>(value)); }

std::string vector_text(const Vec3d& v) {
  return "(" + float_text(v[0]) + ", " + float_text(v[1]) + ", " + float_text(v[2]) + ")";
}

std::string quaternion_text(const Quatd& q) {
  return "(" + float_text(q.w) + ", " + float_text(q.x) + ", " + float_text(q.y) + ", " +
         float_text(q.z) + ")";
}

/// "1,2,3" means "(1, 2, 3)".
std::string tuple_text(const std::string& text) {
  const bool number = !text.empty() && (text.front() == '-' || text.front() == '.' ||
                                        (text.front() >= '0' && text.front() <= '9'));
  return number && text.find(',') != std::string::npos ? "(" + text + ")" : text;
}

/// Errors: edit.bad-argument.
Result<MeshFileRequest> mesh_request(const AuthoringRequest& request, Path prim) {
  const auto given = [&](const char* option) {
    const auto found = request.options.find(option);
    return found == request.options.end() ? std::string() : found->second;
  };
  MeshFileRequest mesh{given("file"), {}, given("file-up")};
  const std::string meters = given("file-meters");
  if (meters.empty()) {
    return mesh;
  }
  mesh.meters = parse_double(meters);
  if (!mesh.meters || !(*mesh.meters > 0) || !std::isfinite(*mesh.meters)) {
    return bad_option(prim, "--file-meters " + meters + " is no unit of length",
                      "write the metres in a unit: 0.001 for millimetres");
  }
  return mesh;
}

/// Makes the edits of one PATH=KIND,KIND.
class Addition {
 public:
  Addition(const Stages& stages, const AuthoringRequest& request, const EditOptions& options,
           const RequestedKinds& wanted, AddedEdits& edits, Diagnostics& diagnostics)
      : stages_(stages),
        request_(request),
        options_(options),
        wanted_(wanted),
        edits_(edits),
        diagnostics_(diagnostics) {}

  Result<void> make() {
    const AuthoringKind& first = *wanted_.kinds.front();
    wish_ = edits_.size();
    if (first.makes_prim()) {
      TENON_CHECK(make_prim(first));
    } else {
      TENON_TRY(there_, need_in(stages_, wanted_.prim));
    }
    for (const AuthoringKind* kind : wanted_.kinds) {
      if (kind->makes_prim() && kind != &first) {
        return bad_option(
            wanted_.prim,
            "one prim cannot be " + std::string(first.name) + " and " + std::string(kind->name),
            "name one kind of prim first, then what is put on it");
      }
      wish_ = first.makes_prim() ? wish_ : edits_.size();
      kind_ = kind;
      TENON_CHECK(put_on());
    }
    return add_properties();
  }

 private:
  void push(AssetEdit edit) {
    edit.wish = wish_;
    edit.may_rest = kind_ == nullptr || kind_->rests;
    edits_.push_back(std::move(edit));
  }

  void apply(const std::string& api) {
    AssetEdit edit;
    edit.kind = Verdict::ApplyApi;
    edit.object = wanted_.prim;
    edit.api = Token(api);
    push(std::move(edit));
  }

  void set(const std::string& property, std::string value, const char* type = "") {
    AssetEdit edit;
    edit.object = wanted_.prim.property(Token(property));
    edit.value = std::move(value);
    edit.type_name = Token(type);
    push(std::move(edit));
  }

  const std::string* given(std::string_view option) const {
    const auto found = request_.options.find(std::string(option));
    return found == request_.options.end() || !kind_->takes(option) ? nullptr : &found->second;
  }

  const stage::Stage& stage() const { return *stages_.front(); }
  Token type() const {
    return there_ ? there_.type_name() : Token(std::string(wanted_.kinds.front()->type));
  }

  Result<void> make_prim(const AuthoringKind& kind) {
    kind_ = &kind;
    AssetEdit edit;
    edit.kind = Verdict::DefinePrim;
    edit.object = wanted_.prim;
    edit.type_name = Token(std::string(kind.type));
    if (kind.name == "mesh") {
      TENON_TRY(const MeshFileRequest mesh, mesh_request(request_, wanted_.prim));
      TENON_TRY(edit.mesh, read_mesh_file(mesh, stage(), options_.open, diagnostics_));
    } else if (const std::string* file = given("file")) {
      edit.arc =
          AssetArc{kind.name == "payload" ? AssetArc::Kind::Payload : AssetArc::Kind::Reference,
                   bytes::absolute_file_path(*file)};
      if (const std::string* prim = given("prim")) {
        TENON_TRY(edit.arc->prim, Path::parse(*prim));
      }
    }
    push(std::move(edit));
    return kind.takes_pose() ? place() : Result<void>();
  }

  Result<void> place() {
    std::string order;
    const auto op = [&](const std::string& name, const std::string& text, const char* type) {
      set("xformOp:" + name, tuple_text(text), type);
      order += (order.empty() ? "\"xformOp:" : ", \"xformOp:") + name + "\"";
    };
    if (const std::string* at = given("at")) {
      op("translate", *at, "double3");
    }
    if (const std::string* turn = given("rotate")) {
      const bool quaternion = std::count(turn->begin(), turn->end(), ',') == 3;
      op(quaternion ? "orient" : "rotateXYZ", *turn, quaternion ? "quatf" : "float3");
    }
    if (const std::string* scale = given("scale")) {
      op("scale", *scale, "float3");
    }
    if (!order.empty()) {
      set("xformOpOrder", "[" + order + "]");
    }
    return {};
  }

  /// Schemas and properties of the kind.
  Result<void> put_on() {
    const bool joint =
        schema::Registry::instance().is_a(Token(std::string(kind_->type)), Token("PhysicsJoint"));
    if (!kind_->on.empty()) {
      TENON_CHECK(check_type());
    }
    if (kind_->name == "variant" || kind_->name == "engine") {
      return kind_->name == "variant" ? add_variant() : Result<void>();
    }
    if (kind_->name == "mimic" && options_.engine == "physx") {
      return add_physx_mimic();
    }
    if (kind_->name == "limit" && has_own_limits(type())) {
      return add_own_limits();
    }
    instance_ = kind_->on.empty() ? "" : instance_of(type(), *kind_, request_.options);
    TENON_CHECK(apply_schemas());
    if (joint) {
      TENON_CHECK(add_frames());
      join_robot(kRobotJoints);
    } else if (kind_->name == "body") {
      join_robot(kRobotLinks);
    }
    if (kind_->name == "ground") {
      set("axis", stage().metadata(Token("upAxis")).get_or(Token("Y")).str());
    }
    for (const KindOption& option : kind_->options) {
      if (const std::string* value = option.property.empty() ? nullptr : given(option.name)) {
        TENON_CHECK(set_option(option, *value));
      }
    }
    return {};
  }

  /// A joint or a body below a robot is one of its joints or links.
  void join_robot(const char* list) {
    AssetEdit edit;
    edit.kind = Verdict::AddTargets;
    edit.object = robot_list(stages_, wanted_.prim, list);
    if (edit.object.empty()) {
      return;
    }
    edit.value = wanted_.prim.str();
    push(std::move(edit));
    edits_.back().may_rest = true;
  }

  Result<void> check_type() const {
    if (schema::Registry::instance().is_a(type(), Token(std::string(kind_->on)))) {
      return {};
    }
    return bad_option(wanted_.prim,
                      std::string(kind_->name) + " is put on prims of type " +
                          std::string(kind_->on) + ", and <" + wanted_.prim.str() +
                          "> is of type " + type().str(),
                      "tenon tree lists the prims with their types", "edit.wrong-type");
  }

  Result<void> apply_schemas() {
    for (const std::string_view pattern : kind_->apis) {
      if (pattern == "PhysicsMeshCollisionAPI" && given("approximation") == nullptr) {
        continue;
      }
      const bool instanced = pattern.find('*') != std::string_view::npos;
      if (instanced && instance_.empty() && type() == Token("PhysicsFixedJoint")) {
        return bad_option(wanted_.prim,
                          "<" + wanted_.prim.str() + "> is fixed: it has no degree of freedom",
                          "name another joint");
      }
      if (instanced && instance_.empty()) {
        return bad_option(wanted_.prim,
                          "<" + wanted_.prim.str() + "> has several degrees of freedom",
                          "say which one: --dof rotX, or transX, transY, transZ, rotY, rotZ");
      }
      const Token api(with_instance(pattern, instance_));
      const bool has = there_ && there_.has_api(api);
      const bool shared = kind_->name == "binding" || kind_->name == "filtered-pair";
      if (has && !shared && pattern == kind_->apis.front()) {
        return bad_option(wanted_.prim,
                          "<" + wanted_.prim.str() + "> has " + api.str() + " already",
                          "change it with tenon set, or remove it first: tenon remove ASSET " +
                              wanted_.prim.str() + "=" + std::string(kind_->name),
                          "edit.has-it-already");
      }
      if (!has) {
        apply(api.str());
      }
    }
    return {};
  }

  Result<void> set_option(const KindOption& option, const std::string& value) {
    const std::string property = with_instance(option.property, instance_);
    if (option.name == "mass") {
      const auto kilograms = parse_double(value);
      if (!kilograms || !(*kilograms > 0)) {
        return bad_option(wanted_.prim, "--mass " + value + " is not a mass",
                          "a mass is a number of kilograms above 0");
      }
      const double unit = stage().metadata(Token("kilogramsPerUnit")).get_or(1.0);
      set(property, float_text(unit > 0 ? *kilograms / unit : *kilograms));
      return {};
    }
    if (option.name == "with") {
      AssetEdit edit;
      edit.kind = Verdict::AddTargets;
      edit.object = wanted_.prim.property(Token(property));
      edit.value = value;
      push(std::move(edit));
      return {};
    }
    set(property, tuple_text(value), property.starts_with("material:binding:") ? "rel" : "");
    return {};
  }

  Result<void> add_variant() {
    const std::string& value = *given("variant");
    TENON_TRY(const auto parts, split_assignment(value));
    const auto names = there_ ? there_.variant_names(parts.first) : std::vector<std::string>();
    if (std::find(names.begin(), names.end(), parts.second) != names.end()) {
      return bad_option(wanted_.prim,
                        "<" + wanted_.prim.str() + "> has the variant " + value + " already",
                        "choose another name", "edit.has-it-already");
    }
    AssetEdit edit;
    edit.kind = Verdict::AddVariant;
    edit.object = wanted_.prim;
    edit.value = value;
    push(std::move(edit));
    return {};
  }

  Result<void> add_physx_mimic() {
    const auto value_of = [&](const char* option, const char* otherwise) {
      const std::string* value = given(option);
      return value == nullptr ? std::string(otherwise) : *value;
    };
    TENON_TRY(AddedEdits made,
              mimic_edits(wanted_.prim.str() + "=" + value_of("leader", "") + "," +
                              value_of("multiplier", "1") + "," + value_of("offset", "0"),
                          options_.engine));
    for (AssetEdit& edit : made) {
      push(std::move(edit));
    }
    return {};
  }

  Result<void> add_own_limits() {
    for (const auto& [option, property] :
         {std::pair("low", "physics:lowerLimit"), std::pair("high", "physics:upperLimit")}) {
      const std::string* value = given(option);
      if (value != nullptr && there_ && there_.attribute(Token(property)).has_authored_value()) {
        return bad_option(
            wanted_.prim, "<" + wanted_.prim.str() + "> has a limit already",
            "change it: tenon set ASSET " + wanted_.prim.str() + "." + property + "=" + *value,
            "edit.has-it-already");
      }
      if (value != nullptr) {
        set(property, *value);
      }
    }
    return {};
  }

  Result<stage::Prim> body_of(const char* option) const {
    const std::string* text = given(option);
    if (text == nullptr) {
      return stage::Prim();
    }
    TENON_TRY(const Path path, Path::parse(*text));
    return need_in(stages_, path);
  }

  /// At least one side has to move, and the sides have to be two things.
  Result<void> check_bodies(const stage::Prim& body0, const stage::Prim& body1) const {
    const std::string none = "--body1 PRIM, and --body0 PRIM unless it is the world";
    if (!body0 && !body1) {
      return bad_option(wanted_.prim, "a joint joins a body to another one or to the world",
                        "name its bodies: " + none, "edit.no-body");
    }
    if (body0 == body1) {
      return bad_option(wanted_.prim,
                        "both sides of the joint are " + named(body0.path(), RelatedRole::Body),
                        "name two bodies: " + none, "edit.no-body");
    }
    const auto moves = [](const stage::Prim& prim) {
      stage::Prim at = prim;
      while (at && !at.has_api(Token("PhysicsRigidBodyAPI"))) {
        at = at.parent();
      }
      return bool(at);
    };
    if (moves(body0) || moves(body1)) {
      return {};
    }
    const Path fixed = (body1 ? body1 : body0).path();
    return bad_option(
        wanted_.prim, named(fixed) + " is not a body: the joint would connect two static objects",
        "make it one first: tenon add ASSET " + fixed.str() + "=body", "edit.no-body");
  }

  Result<void> add_frames() {
    JointWish wish;
    TENON_TRY(wish.body0, body_of("body0"));
    TENON_TRY(wish.body1, body_of("body1"));
    TENON_CHECK(check_bodies(wish.body0, wish.body1));
    if (const std::string* at = given("at")) {
      TENON_TRY(wish.at, read_vector(*at, "at"));
    }
    const std::string* axis = given("axis");
    wish.axis = axis == nullptr ? "" : *axis;
    wish.own_origins = kind_->name == "distance";
    TENON_TRY(const JointPlacement placed, place_joint(wish, stage().start_time_code()));
    set("physics:localPos0", vector_text(placed.position0));
    set("physics:localPos1", vector_text(placed.position1));
    set("physics:localRot0", quaternion_text(placed.rotation0));
    set("physics:localRot1", quaternion_text(placed.rotation1));
    const schema::PrimDefinition definition(Token(std::string(kind_->type)), {});
    if (definition.find(Token("physics:axis")) != nullptr) {
      set("physics:axis", placed.axis);
    } else if (placed.axis != "X") {
      return bad_option(wanted_.prim, "this joint has no axis of its own",
                        "give a direction, which becomes X of its frames: --axis 0,0,1");
    }
    return {};
  }

  Result<void> add_properties() {
    for (const std::string& text : request_.properties) {
      TENON_TRY(const auto parts, split_assignment(text));
      set(parts.first, tuple_text(parts.second));
    }
    return {};
  }

  const Stages& stages_;
  const AuthoringRequest& request_;
  const EditOptions& options_;
  const RequestedKinds& wanted_;
  AddedEdits& edits_;
  Diagnostics& diagnostics_;
  stage::Prim there_;  // invalid: it is made
  const AuthoringKind* kind_ = nullptr;
  std::size_t wish_ = 0;
  std::string instance_;
};

}  // namespace

Result<std::vector<AssetEdit>> add_edits(const Stages& stages, const AuthoringRequest& request,
                                         const EditOptions& options, Diagnostics& diagnostics) {
  if (request.match) {
    TENON_TRY(const AuthoringRequest matched, matched_request(stages, request));
    return add_edits(stages, matched, options, diagnostics);
  }
  std::vector<RequestedKinds> requested;
  for (const std::string& text : request.what) {
    TENON_TRY(RequestedKinds one, read_requested(text, true));
    requested.push_back(std::move(one));
  }
  TENON_CHECK(check_options(request, requested));
  AddedEdits edits;
  for (const RequestedKinds& one : requested) {
    TENON_CHECK(Addition(stages, request, options, one, edits, diagnostics).make());
  }
  return edits;
}

}  // namespace tenon
