// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Requirements on bodies, colliders and contact materials, of any engine and of Newton and MuJoCo.
// What a validator reads of a schema that it does not know counts as authored here as well: vendor
// attributes are judged by what the file says, not by fallbacks.
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "tenon/check/simready/judges.h"
#include "tenon/check/simready/reading.h"
#include "tenon/layer/field_values.h"
#include "tenon/stage/transform_at.h"

namespace tenon::check::simready {
namespace {

bool is_body(const stage::Prim& prim) { return has_api(prim, "PhysicsRigidBodyAPI"); }
bool is_collider(const stage::Prim& prim) { return has_api(prim, "PhysicsCollisionAPI"); }
bool is_mesh(const stage::Prim& prim) { return prim.is_a(Token("Mesh")); }
bool is_gprim(const stage::Prim& prim) { return prim.is_a(Token("Gprim")); }

bool is_round(const stage::Prim& prim) {
  for (const char* type : {"Sphere", "Capsule", "Cylinder", "Cone", "Points"}) {
    if (prim.is_a(Token(type))) {
      return true;
    }
  }
  return false;
}

/// Bodies end at nested bodies.
std::vector<stage::Prim> own_prims(const stage::Prim& body, bool shared) {
  std::vector<stage::Prim> found;
  std::vector<stage::Prim> pending{body};
  while (!pending.empty()) {
    const stage::Prim at = pending.back();
    pending.pop_back();
    found.push_back(at);
    if (at.is_instance() && !shared) {
      continue;
    }
    for (const stage::Prim& child : at.children()) {
      if (child.is_active() && child.is_loaded() && child.is_defined() && !child.is_abstract() &&
          !is_body(child)) {
        pending.push_back(child);
      }
    }
  }
  return found;
}

void report_number(const stage::Prim& prim, const std::string& name, bool good, const char* wanted,
                   Report& report) {
  if (!good) {
    report.at(prim, Token(name), name + " is not " + wanted, std::string("give ") + wanted);
  }
}

bool is_whole(const std::optional<double>& value) {
  return value && std::isfinite(*value) && *value == std::floor(*value);
}

bool is_finite_number(const std::optional<double>& value) { return value && std::isfinite(*value); }

}  // namespace

void judge_rb_001(const Judged& judged, Report& report) {
  const auto& prims = judged.stage.below_root;
  if (judged.stage.root && std::none_of(prims.begin(), prims.end(), is_body)) {
    report.at_root(judged, "no body is below the default prim", "apply PhysicsRigidBodyAPI");
  }
}

void judge_rb_mb_001(const Judged& judged, Report& report) {
  const auto& prims = judged.stage.below_root;
  if (judged.stage.root && std::count_if(prims.begin(), prims.end(), is_body) < 2) {
    report.at_root(judged, "fewer than two bodies are below the default prim",
                   "join bodies, or judge the asset as a prop");
  }
}

void judge_rb_007(const Judged& judged, Report& report) {
  for (const stage::Prim& body : judged.stage.below_root) {
    if (!is_body(body) || has_api(body, "PhysicsMassAPI")) {
      continue;
    }
    for (const stage::Prim& prim : own_prims(body, false)) {
      if (is_collider(prim) && !has_api(prim, "PhysicsMassAPI")) {
        report.at(prim, "neither this collider nor its body has PhysicsMassAPI",
                  "author the body's mass");
      }
    }
  }
}

void judge_rb_011(const Judged& judged, Report& report) {
  for (const stage::Prim& body : judged.stage.with_shared) {
    if (!is_body(body) || !judged.stage.root || !body.path().has_prefix(judged.stage.root.path())) {
      continue;
    }
    bool good = false;
    bool negative = false;
    for (const stage::Prim& prim : own_prims(body, true)) {
      if (!has_api(prim, "PhysicsMassAPI")) {
        continue;
      }
      const double mass = number(prim, "physics:mass").value_or(0);
      if (mass < 0) {
        report.at(prim, Token("physics:mass"), "the mass is negative", "give one above 0");
        negative = true;
      }
      good = good || (mass > 0 && (prim == body || is_collider(prim)));
    }
    if (!good && !negative) {
      report.at(body, "neither the body nor one of its colliders has a mass above 0",
                "author physics:mass");
    }
  }
}

void judge_rb_012(const Judged& judged, Report& report) {
  std::set<std::pair<Path, Path>> joined;
  const auto body_of = [&](Path path) {
    const stage::Prim prim = judged.stage.stage->prim(path);
    return prim && is_mesh(prim) && is_collider(prim) ? path.parent() : path;
  };
  for (const stage::Prim& prim : judged.stage.below_root) {
    if (is_joint(prim)) {
      const std::vector<Path> from = targets(prim, "physics:body0");
      const std::vector<Path> to = targets(prim, "physics:body1");
      if (!from.empty() && !to.empty()) {
        joined.emplace(body_of(from.front()), body_of(to.front()));
        joined.emplace(body_of(to.front()), body_of(from.front()));
      }
    }
  }
  for (const stage::Prim& prim : judged.stage.below_root) {
    if (!is_body(prim)) {
      continue;
    }
    stage::Prim above = prim.parent();
    while (above && !above.is_pseudo_root() && !is_body(above)) {
      above = above.parent();
    }
    if (above && !above.is_pseudo_root() && !joined.contains({prim.path(), above.path()})) {
      report.at(prim,
                "no joint connects this body with " + named(above.path(), RelatedRole::Body) +
                    ", below which it is",
                "connect them, or put the bodies side by side");
    }
  }
}

void judge_rb_003(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (is_body(prim) && !prim.is_a(Token("Xformable"))) {
      report.at(prim, "a body that is no Xform", "apply PhysicsRigidBodyAPI to an Xform");
    }
  }
}

void judge_rb_005(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (is_body(prim) && prim.is_instance_proxy() &&
        !flag(prim, "physics:kinematicEnabled", false) &&
        flag(prim, "physics:rigidBodyEnabled", true)) {
      report.at(prim, "a body inside of an instance cannot move",
                "make the instance itself the body, or no instance of it");
    }
  }
}

void judge_rb_009(const Judged& judged, Report& report) {
  stage::TransformCache transforms{stage::Time()};
  constexpr double kRelative = 1e-12;
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (!is_body(prim) || !prim.is_a(Token("Xformable"))) {
      continue;
    }
    const Mat4d& world = transforms.local_to_world(prim);
    if (is_uniform(stretches(world))) {
      continue;
    }
    const Mat3d linear = upper_left(world);
    const Mat3d squares = linear * transpose(linear);
    const double size = std::max({squares[0][0], squares[1][1], squares[2][2]});
    const double skew =
        std::max({std::fabs(squares[0][1]), std::fabs(squares[0][2]), std::fabs(squares[1][2])});
    if (skew > kRelative * size) {
      report.at(prim, "the body is scaled along directions other than its axes",
                "scale it evenly, or its shapes alone");
    }
  }
}

void judge_rb_col_001(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (is_collider(prim) && !is_gprim(prim)) {
      report.at(prim, "a collider that is no shape", "apply PhysicsCollisionAPI to the shapes");
    }
  }
}

void judge_rb_col_002(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (!has_api(prim, "PhysicsMeshCollisionAPI")) {
      continue;
    }
    if (!is_mesh(prim)) {
      report.at(prim, "PhysicsMeshCollisionAPI on what is no mesh", "remove it");
    }
    if (!is_collider(prim)) {
      report.at(prim, "PhysicsMeshCollisionAPI without PhysicsCollisionAPI", "apply both");
    }
  }
}

void judge_rb_col_003(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (!is_collider(prim) || !is_round(prim)) {
      continue;
    }
    bool even = true;
    const layer::Value scale = prim.attribute(Token("xformOp:scale")).get();
    if (const auto* s = scale.get<Vec3f>()) {
      even = (*s)[0] == (*s)[1] && (*s)[1] == (*s)[2];
    } else if (const auto* d = scale.get<Vec3d>()) {
      even = (*d)[0] == (*d)[1] && (*d)[1] == (*d)[2];
    }
    const auto x = number(prim, "xformOp:scaleX");
    const auto y = number(prim, "xformOp:scaleY");
    const auto z = number(prim, "xformOp:scaleZ");
    even = even && x.has_value() == y.has_value() && y.has_value() == z.has_value() && x == y &&
           y == z;
    if (!even) {
      report.at(prim, "a round collider is scaled unevenly", "scale it evenly, or use a mesh");
    }
  }
}

void judge_rb_col_004(const Judged& judged, Report& report) {
  stage::TransformCache transforms{stage::Time()};
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (is_collider(prim) && is_round(prim) &&
        !is_uniform(stretches(transforms.local_to_world(prim)))) {
      report.at(prim, "a round collider is scaled unevenly by itself or what it is below",
                "scale evenly, or use a mesh");
    }
  }
}

namespace {

/// A member of the collection "collisionmeshes" is a shape or has one below it.
bool merges_shapes(const Judged& judged, const stage::Prim& prim) {
  for (const Path& path : targets(prim, "collection:collisionmeshes:includes")) {
    const stage::Prim member = judged.stage.stage->prim(path);
    std::vector<stage::Prim> pending;
    if (member) {
      pending.push_back(member);
    }
    while (!pending.empty()) {
      const stage::Prim at = pending.back();
      pending.pop_back();
      if (is_gprim(at)) {
        return true;
      }
      const std::vector<stage::Prim> children = at.children();
      pending.insert(pending.end(), children.begin(), children.end());
    }
  }
  return false;
}

bool is_merge(const stage::Prim& prim) { return has_api(prim, "PhysxMeshMergeCollisionAPI"); }

}  // namespace

void judge_physx_col_001(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (!is_collider(prim) || is_gprim(prim)) {
      continue;
    }
    if (!(prim.is_a(Token("Xformable")) && is_merge(prim) && merges_shapes(judged, prim))) {
      report.at(prim, "a collider that is neither a shape nor merges some",
                "apply PhysicsCollisionAPI to the shapes");
    }
  }
}

void judge_physx_col_002(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (!has_api(prim, "PhysicsMeshCollisionAPI")) {
      continue;
    }
    if (!is_mesh(prim) && !is_merge(prim)) {
      report.at(prim, "PhysicsMeshCollisionAPI on what is no mesh and merges none", "remove it");
    }
    if (!is_collider(prim)) {
      report.at(prim, "PhysicsMeshCollisionAPI without PhysicsCollisionAPI", "apply both");
    }
  }
}

void judge_newton_col_001(const Judged& judged, Report& report) {
  if (!judged.stage.root) {
    report.at_root(judged, "there is no default prim", "author defaultPrim");
  }
  for (const stage::Prim& prim : judged.stage.below_root) {
    const bool collision = has_api(prim, "NewtonCollisionAPI");
    const bool mesh = has_api(prim, "NewtonMeshCollisionAPI");
    const bool sdf = has_api(prim, "NewtonSDFCollisionAPI");
    if (mesh && sdf) {
      report.at(prim, "both Newton's mesh and its distance field", "apply one of them");
    }
    if ((collision || sdf) && !is_gprim(prim)) {
      report.at(prim, "Newton's collision schema on what is no shape", "apply it to a shape");
    }
    if (mesh && !is_mesh(prim)) {
      report.at(prim, "NewtonMeshCollisionAPI on what is no mesh", "remove it");
    }
    if (is_mesh(prim) && (has_api(prim, "PhysicsMeshCollisionAPI") || collision) && !mesh && !sdf) {
      report.at(prim, "a mesh collider without NewtonMeshCollisionAPI or NewtonSDFCollisionAPI",
                "apply one of them");
    }
  }
}

void judge_newton_col_002(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (!has_api(prim, "NewtonSDFCollisionAPI") || !is_gprim(prim)) {
      continue;
    }
    for (const char* name : {"newton:contactMargin", "newton:contactGap", "newton:sdfPadding"}) {
      const auto value = number(prim, name);
      report_number(prim, name,
                    !is_authored(prim, name) || (is_finite_number(value) && *value >= 0),
                    "a number of at least 0", report);
    }
    for (const char* name : {"newton:sdfTargetVoxelSize", "newton:hydroelasticStiffness"}) {
      const auto value = number(prim, name);
      report_number(prim, name, !is_authored(prim, name) || (is_finite_number(value) && *value > 0),
                    "a number above 0", report);
    }
    const auto most = number(prim, "newton:sdfMaxResolution");
    report_number(prim, "newton:sdfMaxResolution",
                  !is_authored(prim, "newton:sdfMaxResolution") ||
                      (is_whole(most) && *most >= 1 && std::fmod(*most, 8) == 0),
                  "a multiple of 8", report);
    const auto inner = authored_number_of(prim, "newton:sdfNarrowBandInner");
    const auto outer = authored_number_of(prim, "newton:sdfNarrowBandOuter");
    if (is_finite_number(inner) && is_finite_number(outer) && *inner >= *outer) {
      report.at(prim, Token("newton:sdfNarrowBandInner"), "the narrow band ends before it begins",
                "give an inner one below the outer one");
    }
    static const std::set<std::string> kFormats{"uint8", "uint16", "float32"};
    if (is_authored(prim, "newton:sdfTextureFormat") &&
        !kFormats.contains(text(prim, "newton:sdfTextureFormat"))) {
      report.at(prim, Token("newton:sdfTextureFormat"), "an unknown format",
                "give uint8, uint16 or float32");
    }
    if (is_authored(prim, "newton:hydroelasticEnabled") &&
        !prim.attribute(Token("newton:hydroelasticEnabled")).get().holds<bool>()) {
      report.at(prim, Token("newton:hydroelasticEnabled"), "no bool", "give true or false");
    }
  }
}

namespace {

/// Not authored, empty, or six finite numbers, the first three at least 0.
bool is_inertia(const stage::Prim& prim, const std::string& name) {
  const layer::Value value = prim.attribute(Token(name)).get();
  std::vector<double> moments;
  if (const auto* floats = value.get<layer::Array<float>>()) {
    moments.assign(floats->begin(), floats->end());
  } else if (const auto* doubles = value.get<layer::Array<double>>()) {
    moments.assign(doubles->begin(), doubles->end());
  }
  return !is_authored(prim, name) || moments.empty() ||
         (moments.size() == 6 && holds_numbers(value) && moments[0] >= 0 && moments[1] >= 0 &&
          moments[2] >= 0);
}

}  // namespace

void judge_newton_mas_001(const Judged& judged, Report& report) {
  static const std::string kInertia = "newton:inertia";
  static const std::string kModel = "newton:massModel";
  static const std::string kThickness = "newton:shellThickness";
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (!has_api(prim, "NewtonMassAPI") && !is_authored(prim, kInertia) &&
        !is_authored(prim, kModel) && !is_authored(prim, kThickness)) {
      continue;
    }
    if (!prim.is_a(Token("Xformable"))) {
      report.at(prim, "Newton's mass on what is no Xform", "author it on the body");
      continue;
    }
    report_number(prim, kInertia, is_inertia(prim, kInertia),
                  "six numbers Ixx, Iyy, Izz, Ixy, Ixz, Iyz", report);
    if (is_authored(prim, kModel)) {
      const std::string model = text(prim, kModel);
      report_number(prim, kModel, model == "solid" || model == "shell", "solid or shell", report);
    }
    if (is_authored(prim, kThickness)) {
      const auto value = number(prim, kThickness);
      const bool deferred = value && *value == -std::numeric_limits<double>::infinity();
      report_number(prim, kThickness, deferred || (is_finite_number(value) && *value > 0),
                    "a number above 0", report);
    }
  }
}

void judge_newton_mat_001(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (has_api(prim, "NewtonMaterialAPI") &&
        !(prim.is_a(Token("Material")) && has_api(prim, "PhysicsMaterialAPI"))) {
      report.at(prim, "NewtonMaterialAPI on what is no contact material",
                "apply PhysicsMaterialAPI to a Material as well");
    }
  }
}

void judge_mujoco_col_001(const Judged& judged, Report& report) {
  if (!judged.stage.root) {
    report.at_root(judged, "there is no default prim", "author defaultPrim");
  }
  for (const stage::Prim& prim : judged.stage.below_root) {
    const bool mujoco = has_api(prim, "MjcCollisionAPI");
    if (is_collider(prim) && !mujoco) {
      report.at(prim, "a collider without MjcCollisionAPI", "apply it");
    }
    if (!mujoco) {
      continue;
    }
    if (!is_collider(prim) || !is_gprim(prim)) {
      report.at(prim, "MjcCollisionAPI on what is no shape that collides", "remove it");
    }
    for (const char* name : {"mjc:group", "mjc:priority", "mjc:condim"}) {
      const auto value = number(prim, name);
      const bool low_enough = std::string_view(name) == "mjc:priority" || value.value_or(0) >= 0;
      report_number(prim, name, !is_authored(prim, name) || (is_whole(value) && low_enough),
                    "a whole number", report);
    }
    for (const char* name : {"mjc:solmix", "mjc:margin", "mjc:gap"}) {
      const auto value = number(prim, name);
      report_number(prim, name,
                    !is_authored(prim, name) || (is_finite_number(value) && *value >= 0),
                    "a number of at least 0", report);
    }
    for (const char* name : {"mjc:solref", "mjc:solimp"}) {
      report_number(prim, name,
                    !is_authored(prim, name) || holds_numbers(prim.attribute(Token(name)).get()),
                    "an array of numbers", report);
    }
  }
}

void judge_mujoco_col_002(const Judged& judged, Report& report) {
  static const std::set<std::string> kInertias{"legacy", "convex", "exact", "shell"};
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (has_api(prim, "MjcMeshCollisionAPI")) {
      if (!is_mesh(prim)) {
        report.at(prim, "MjcMeshCollisionAPI on what is no mesh", "remove it");
        continue;
      }
      report_number(
          prim, "mjc:inertia",
          !is_authored(prim, "mjc:inertia") || kInertias.contains(text(prim, "mjc:inertia")),
          "legacy, convex, exact or shell", report);
      const auto most = number(prim, "mjc:maxhullvert");
      report_number(prim, "mjc:maxhullvert",
                    !is_authored(prim, "mjc:maxhullvert") || (is_whole(most) && *most >= -1),
                    "a whole number of at least -1", report);
    }
    if (has_api(prim, "PhysicsMeshCollisionAPI") && has_api(prim, "MjcCollisionAPI") &&
        text(prim, "physics:approximation") != "convexHull") {
      report.at(prim, Token("physics:approximation"), "MuJoCo collides with the convex hull alone",
                "author convexHull");
    }
  }
}

void judge_pmt_001(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.below_root) {
    if (!is_collider(prim)) {
      continue;
    }
    const std::vector<Path> bound = targets(prim, "material:binding:physics");
    const stage::Prim material =
        bound.empty() ? stage::Prim() : judged.stage.stage->prim(bound.front());
    if (!material || !material.is_a(Token("Material"))) {
      report.at(prim, "no material is bound to this collider by material:binding:physics",
                "bind one with friction and restitution");
    }
  }
}

void judge_gsp_001(const Judged& judged, Report& report) {
  if (!judged.stage.root) {
    return;
  }
  std::size_t lines = 0;
  for (const stage::Prim& prim : judged.stage.below_root) {
    if (prim.type_name() == "BasisCurves" && prim.name().str().starts_with("grasp_identifier")) {
      ++lines;
      if (prim.attribute(Token("points")).get().size() < 2) {
        report.at(prim, "a line to grasp at of fewer than two points", "give two points");
      }
    }
  }
  if (lines == 0) {
    report.at(judged.stage.root, "no BasisCurves grasp_identifier says where to grasp the asset",
              "add one through the part to grasp");
  }
}

}  // namespace tenon::check::simready
