// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The physics is made into a model first, with actuators and keyframes. Visuals come last, as geoms
// that touch nothing and weigh nothing. When MuJoCo refuses the whole, it is written again without
// them, so that a bad picture or mesh never costs the physics. Images go to the compiler from
// memory under the names that the text has. Meshes that are alike become one.
//
// The exporter has no builder of its own: what a scene means for MuJoCo is in one place, the passes
// of engines/mujoco, which know that text is wanted (Purpose::Text) where a run needs something
// that no other reader has. An actuator of the asset that runs take as a drive of its joint is
// written as it is, in the drive's place. MuJoCo's writer makes the text, and what it does not do
// (names, digits) is done to the text (text/write_text.h): so a new element of MuJoCo comes out
// with its first line in a pass.
#include "tenon/mjcf/write_model.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "tenon/base/file_finding.h"
#include "tenon/engines/mujoco/build/sensor_fields.h"
#include "tenon/engines/mujoco/error_hook.h"
#include "tenon/engines/mujoco/model.h"
#include "tenon/engines/mujoco/mujoco_library.h"
#include "tenon/engines/mujoco/writable_model.h"
#include "tenon/mjcf/seen/write_cameras.h"
#include "tenon/mjcf/sensors/write_kept_sensors.h"
#include "tenon/mjcf/sensors/write_sensors.h"
#include "tenon/mjcf/text/write_text.h"
#include "tenon/mjcf/write_actuators.h"
#include "tenon/mjcf/write_elements.h"
#include "tenon/mjcf/write_keyframes.h"

namespace tenon::mjcf {
namespace {

using engines::mujoco::guarded;
using engines::mujoco::read_quaternion;
using engines::mujoco::write_quaternion;
using engines::mujoco::write_vector;
using robot::GeometryKind;
using robot::ImageUse;

constexpr int kVisualGroup = 2;
constexpr int kColliderGroup = 3;         // hidden by viewers unless asked for
constexpr double kGrid = 0.1;             // spacing of the lines that viewers draw on planes [m]
constexpr std::size_t kFewestPoints = 4;  // of a mesh
constexpr double kSame = 1e-9;            // [m], and of a turn

/// Files for MuJoCo's compiler that need not be on the disk.
class Files {
 public:
  explicit Files(const std::map<std::string, std::string>& images) {
    mj_defaultVFS(&files_);
    for (const auto& [name, bytes] : images) {
      mj_addBufferVFS(&files_, name.c_str(), bytes.data(), static_cast<int>(bytes.size()));
    }
  }
  Files(const Files&) = delete;
  Files& operator=(const Files&) = delete;
  ~Files() { mj_deleteVFS(&files_); }
  mjVFS* get() { return &files_; }

 private:
  mjVFS files_;
};

mjtTextureRole role_of(ImageUse use) {
  switch (use) {
    case ImageUse::Occlusion:
      return mjTEXROLE_OCCLUSION;
    case ImageUse::Roughness:
      return mjTEXROLE_ROUGHNESS;
    case ImageUse::Metallic:
      return mjTEXROLE_METALLIC;
    case ImageUse::Normal:
      return mjTEXROLE_NORMAL;
    case ImageUse::Opacity:
      return mjTEXROLE_OPACITY;
    case ImageUse::Emission:
      return mjTEXROLE_EMISSIVE;
    case ImageUse::RoughnessMetallic:
    case ImageUse::OcclusionRoughnessMetallic:
      return mjTEXROLE_ORM;
  }
  return mjTEXROLE_USER;
}

class VisualWriter {
 public:
  VisualWriter(const robot::RobotModel& visuals, const engines::mujoco::Model& model, mjSpec& spec,
               Diagnostics& diagnostics)
      : visuals_(visuals), model_(model), spec_(spec), diagnostics_(diagnostics) {}

  /// Prims that geoms show, by the names of these geoms.
  const std::map<std::string, std::string, std::less<>>& names() const { return names_; }
  /// The geoms that show prims, by the paths of these.
  const std::map<std::string, mjsGeom*>& geoms() const { return geoms_; }

  void run(const scene::PhysicsScene& scene) {
    for (mjsElement* at = mjs_firstElement(&spec_, mjOBJ_GEOM); at != nullptr;
         at = mjs_nextElement(&spec_, at)) {
      mjs_asGeom(at)->group = kColliderGroup;
    }
    for (const robot::Material& material : visuals_.materials) {
      add_material(material);
    }
    for (std::size_t i = 0; i < visuals_.links.size(); ++i) {
      const bool is_body = i < scene.bodies.size();
      mjsBody* body = mjs_findBody(&spec_, is_body ? scene.bodies[i].path.str().c_str() : "world");
      const Pose frame = is_body ? inverse(model_.bodies[i].engine_frame) : Pose{};
      for (const robot::Visual& visual : visuals_.links[i].visuals) {
        add_visual(body, !is_body, frame, visual);
      }
    }
  }

 private:
  void report(const std::string& message) {
    diagnostics_.add(file_finding(Severity::Warning, "mjcf.left-out", message, "", 0));
  }

  std::string texture_of(const robot::Material& material, const std::string& file, bool color) {
    const bool mirrored_u = material.texture_scale[0] < 0;
    const bool mirrored_v = material.texture_scale[1] < 0;
    const std::string name =
        file + (mirrored_u ? ".u" : "") + (mirrored_v ? ".v" : "") + (color ? "" : ".data");
    if (mjs_findElement(&spec_, mjOBJ_TEXTURE, name.c_str()) == nullptr) {
      mjsTexture* texture = mjs_addTexture(&spec_, nullptr);
      mjs_setName(texture->element, name.c_str());
      texture->type = mjTEXTURE_2D;
      mjs_setString(texture->file, file.c_str());
      texture->hflip = mirrored_u;
      texture->vflip = mirrored_v;
      texture->colorspace =
          color && !material.texture_linear ? mjCOLORSPACE_SRGB : mjCOLORSPACE_LINEAR;
      if (color && material.texture_opacity) {
        texture->nchannel = 4;
      }
    }
    return name;
  }

  /// Rows of images are counted from the top, so that repetitions begin there.
  void check_offset(const robot::Material& material) {
    const double scale = material.texture_scale[1];
    const double usual = scale < 0 ? -scale : 1 - scale;
    const auto off = [](double a) { return std::fabs(a - std::round(a)) > 1e-5; };
    if (off(material.texture_offset[1] - usual) || off(material.texture_offset[0])) {
      report("the images of material \"" + material.name + "\" are moved; the offset is skipped");
    }
  }

  void add_material(const robot::Material& material) {
    mjsMaterial* result = mjs_addMaterial(&spec_, nullptr);
    mjs_setName(result->element, material.name.c_str());
    const Vec4d color = material.color.value_or(Vec4d{{1, 1, 1, 1}});
    for (std::size_t k = 0; k < 4; ++k) {
      result->rgba[k] = static_cast<float>(color[k]);
    }
    result->emission = static_cast<float>(material.emission);
    result->roughness = static_cast<float>(material.roughness.value_or(-1));
    result->metallic = static_cast<float>(material.metallic.value_or(-1));
    if (material.texture.empty() && material.images.empty()) {
      return;
    }
    check_offset(material);
    for (std::size_t k = 0; k < 2; ++k) {
      result->texrepeat[k] = static_cast<float>(std::fabs(material.texture_scale[k]));
    }
    if (!material.texture.empty()) {
      mjs_setInStringVec(result->textures,
                         material.texture_opacity ? mjTEXROLE_RGBA : mjTEXROLE_RGB,
                         texture_of(material, material.texture, true).c_str());
    }
    for (const robot::MaterialImage& image : material.images) {
      const bool is_color = image.use == ImageUse::Emission;
      mjs_setInStringVec(result->textures, role_of(image.use),
                         texture_of(material, image.file, is_color).c_str());
    }
  }

  void set_shape(const robot::Geometry& from, mjsGeom& geom) {
    const double h = from.half_height;
    switch (from.kind) {
      case GeometryKind::Box:
        geom.type = mjGEOM_BOX;
        write_vector(geom.size, from.half_extents);
        break;
      case GeometryKind::Sphere:
        geom.type = mjGEOM_SPHERE;
        write_vector(geom.size, {{from.radius, 0, 0}});
        break;
      case GeometryKind::Ellipsoid:
        geom.type = mjGEOM_ELLIPSOID;
        write_vector(geom.size, from.half_extents);
        break;
      case GeometryKind::Cylinder:
        geom.type = mjGEOM_CYLINDER;
        write_vector(geom.size, {{from.radius, h, 0}});
        break;
      case GeometryKind::Capsule:
        geom.type = mjGEOM_CAPSULE;
        write_vector(geom.size, {{from.radius, h, 0}});
        break;
      case GeometryKind::Mesh:
        geom.type = mjGEOM_MESH;
        mjs_setString(geom.meshname, mesh_of(from.mesh).c_str());
        break;
      case GeometryKind::Plane:
        geom.type = mjGEOM_PLANE;
        write_vector(geom.size, {{from.half_extents[0], from.half_extents[1], kGrid}});
        break;
    }
  }

  /// Meshes that are alike are one.
  std::string mesh_of(robot::Index number) {
    const robot::MeshFile& mesh = visuals_.meshes[number];
    for (std::size_t i = 0; i < made_.size(); ++i) {
      const robot::MeshFile& other = visuals_.meshes[made_[i]];
      if (mesh.points == other.points && mesh.triangles == other.triangles &&
          mesh.texture_coordinates == other.texture_coordinates) {
        return "visual_" + std::to_string(i);
      }
    }
    const std::string name = "visual_" + std::to_string(made_.size());
    made_.push_back(number);
    mjsMesh* result = mjs_addMesh(&spec_, nullptr);
    mjs_setName(result->element, name.c_str());
    result->inertia = mjMESH_INERTIA_SHELL;  // it may be open or flat
    set_faces(mesh, *result);
    return name;
  }

  /// MuJoCo's text has one place in images for each point, so points are repeated for each of
  /// theirs.
  static void set_faces(const robot::MeshFile& mesh, mjsMesh& result) {
    std::vector<float> points;
    std::vector<float> places;
    std::vector<int> faces;
    std::map<std::tuple<int, float, float>, int> known;  // the point, then its place
    for (std::size_t corner = 0; corner < 3 * mesh.triangles.size(); ++corner) {
      const int point = mesh.triangles[corner / 3][corner % 3];
      const bool has_place = !mesh.texture_coordinates.empty();
      const Vec2f st = has_place ? mesh.texture_coordinates[corner] : Vec2f{};
      const auto [at, is_new] =
          known.try_emplace({point, st[0], st[1]}, static_cast<int>(points.size() / 3));
      faces.push_back(at->second);
      if (is_new) {
        const Vec3f& p = mesh.points[static_cast<std::size_t>(point)];
        points.insert(points.end(), p.v.begin(), p.v.end());
        places.insert(places.end(), {st[0], 1 - st[1]});
      }
    }
    mjs_setFloat(result.uservert, points.data(), static_cast<int>(points.size()));
    mjs_setInt(result.userface, faces.data(), static_cast<int>(faces.size()));
    if (!mesh.texture_coordinates.empty()) {
      mjs_setFloat(result.usertexcoord, places.data(), static_cast<int>(places.size()));
    }
  }

  void add_visual(mjsBody* body, bool is_world, const Pose& frame, const robot::Visual& visual) {
    const robot::Geometry& geometry = visual.geometry;
    const bool is_mesh = geometry.kind == GeometryKind::Mesh;
    const bool small = is_mesh && (visuals_.meshes[geometry.mesh].points.size() < kFewestPoints ||
                                   visuals_.meshes[geometry.mesh].triangles.empty());
    const bool moves = geometry.kind == GeometryKind::Plane && !is_world;
    if (body == nullptr || small || moves) {
      report("the shape \"" + visual.name +
             "\" has too few points or is a plane that moves; it is skipped");
      return;
    }
    const Pose pose = frame * visual.pose;
    if (!is_mesh && show_collider(body, visual, pose)) {
      return;
    }
    mjsGeom* geom = mjs_addGeom(body, nullptr);
    set_shape(geometry, *geom);
    set_place(pose, *geom);
    geom->contype = 0;
    geom->conaffinity = 0;
    geom->group = kVisualGroup;
    geom->mass = 0;
    if (visual.material) {
      mjs_setString(geom->material, visuals_.materials[*visual.material].name.c_str());
    }
    geoms_[visual.name] = geom;
  }

  static void set_place(const Pose& pose, mjsGeom& geom) {
    write_vector(geom.pos, pose.position);
    write_quaternion(geom.quat, normalized(pose.orientation));
  }

  /// A collider of the same shape in the same place becomes the visual itself, as in models.
  bool show_collider(mjsBody* body, const robot::Visual& visual, const Pose& pose) {
    mjsGeom seen{};
    set_shape(visual.geometry, seen);
    set_place(pose, seen);
    const std::multimap<double, mjsGeom*>& colliders = colliders_of(body);
    const auto end = colliders.upper_bound(seen.pos[0] + kSame);
    for (auto at = colliders.lower_bound(seen.pos[0] - kSame); at != end; ++at) {
      mjsGeom* geom = at->second;
      if (geom->group != kColliderGroup || !is_same_shape(*geom, seen)) {
        continue;
      }
      geom->group = 0;
      std::copy_n(seen.size, geom->type == mjGEOM_PLANE ? 3 : 0, geom->size);
      if (visual.material) {
        mjs_setString(geom->material, visuals_.materials[*visual.material].name.c_str());
      }
      names_.emplace(mjs_getString(mjs_getName(geom->element)), visual.name);
      geoms_[visual.name] = geom;
      return true;
    }
    return false;
  }

  /// By the first number of their places.
  const std::multimap<double, mjsGeom*>& colliders_of(mjsBody* body) {
    const auto [known, is_new] = colliders_.try_emplace(body);
    for (mjsElement* at = is_new ? mjs_firstChild(body, mjOBJ_GEOM, 0) : nullptr; at != nullptr;
         at = mjs_nextChild(body, at, 0)) {
      mjsGeom* geom = mjs_asGeom(at);
      known->second.emplace(geom->pos[0], geom);
    }
    return known->second;
  }

  static bool is_same_shape(const mjsGeom& a, const mjsGeom& b) {
    const auto near = [](const double* x, const double* y, int count) {
      return std::equal(x, x + count, y,
                        [](double p, double q) { return std::fabs(p - q) <= kSame; });
    };
    const double turn = std::fabs(dot(read_quaternion(a.quat), read_quaternion(b.quat)));
    const int sizes = a.type == mjGEOM_PLANE                               ? 0
                      : a.type == mjGEOM_SPHERE                            ? 1
                      : a.type == mjGEOM_BOX || a.type == mjGEOM_ELLIPSOID ? 3
                                                                           : 2;
    return a.type == b.type && near(a.pos, b.pos, 3) && near(a.size, b.size, sizes) &&
           turn >= 1 - kSame * kSame;
  }

  const robot::RobotModel& visuals_;
  const engines::mujoco::Model& model_;
  mjSpec& spec_;
  Diagnostics& diagnostics_;
  std::map<std::string, std::string, std::less<>> names_;
  std::map<std::string, mjsGeom*> geoms_;
  std::map<mjsBody*, std::multimap<double, mjsGeom*>> colliders_;
  std::vector<robot::Index> made_;  // meshes, by the number in their names
};

/// One whose kind or size MuJoCo does not support is left as it is.
void set_site_volume(mjsSite& site, const robot::MujocoVolume& volume) {
  const std::optional<mjtGeom> shape = engines::mujoco::site_shape(volume.type);
  if (shape && volume.size[0] > 0) {
    site.type = *shape;
    std::copy(volume.size.begin(), volume.size.end(), site.size);
  }
}

/// Named frames, those that nothing in the physics has made a site of too.
void add_sites(const robot::RobotModel& visuals, const scene::PhysicsScene& scene,
               const engines::mujoco::Model& model, mjSpec& spec) {
  for (std::size_t i = 0; i < visuals.links.size(); ++i) {
    const bool is_body = i < scene.bodies.size();
    mjsBody* body = mjs_findBody(&spec, is_body ? scene.bodies[i].path.str().c_str() : "world");
    const Pose frame = is_body ? inverse(model.bodies[i].engine_frame) : Pose{};
    for (const robot::Site& site : visuals.links[i].sites) {
      if (body == nullptr) {
        continue;
      }
      mjsSite& made = named_site(spec, body, site.name, frame * site.pose);
      if (site.volume) {
        set_site_volume(made, *site.volume);
      }
    }
  }
}

/// The scene without the parts that are written separately, in the order of the stage: actuators,
/// and their drives.
scene::PhysicsScene without_actuators(const scene::PhysicsScene& scene,
                                      const scene::MujocoParts& parts) {
  scene::PhysicsScene result = scene;
  result.actuators.clear();
  for (const scene::MujocoActuator& actuator : parts.actuators) {
    if (actuator.drive) {
      scene::Drive& drive = result.joints[actuator.target].drives[*actuator.drive];
      drive.stiffness = 0;
      drive.damping = 0;
      drive.max_force = scene::kUnlimited;
    }
  }
  return result;
}

Result<engines::mujoco::SpecAndModel> make_model(const scene::PhysicsScene& scene,
                                                 const scene::MujocoParts& parts,
                                                 Diagnostics& diagnostics) {
  if (parts.actuators.empty() && scene.actuators.empty()) {
    return engines::mujoco::writable_model(scene, {}, diagnostics);
  }
  return engines::mujoco::writable_model(without_actuators(scene, parts), {}, diagnostics);
}

/// Findings that are not there yet.
void append_new(const Diagnostics& from, Diagnostics& to) {
  for (const Diagnostic& finding : from) {
    const bool known = std::any_of(to.begin(), to.end(), [&](const Diagnostic& other) {
      return other.prim == finding.prim && other.message == finding.message;
    });
    if (!known) {
      to.add(finding);
    }
  }
}

}  // namespace

Result<std::string> write_model(const scene::PhysicsScene& scene, const robot::RobotModel& visuals,
                                const std::map<std::string, std::string>& images,
                                const scene::MujocoParts& parts, const NameOf& name_of,
                                Diagnostics& diagnostics) {
  TENON_TRY(engines::mujoco::SpecAndModel built, make_model(scene, parts, diagnostics));
  engines::mujoco::report_choices_of_runs(scene, built, diagnostics);
  if (!visuals.name.empty()) {
    mjs_setString(built.spec->modelname, visuals.name.c_str());
  }
  TENON_TRY(const std::vector<mjsActuator*> made,
            write_actuators(scene, parts.actuators, built.model, *built.spec, diagnostics));
  add_sites(visuals, scene, built.model, *built.spec);
  TENON_CHECK(write_keyframes(scene, parts, made, built.model, *built.spec, diagnostics));
  const bool sees = !visuals.links.empty();
  Diagnostics seen;
  VisualWriter writer(visuals, built.model, *built.spec, seen);
  if (sees) {
    writer.run(scene);
    write_cameras_and_lights(visuals, scene, built.model, *built.spec, seen);
  }
  Diagnostics measured;
  KeptSensorWriter kept(scene, built.model, writer.geoms(), *built.spec, measured);
  write_sensors(scene, kept.add(parts.sensors), built.model, *built.spec, measured);
  Files files(images);
  const auto compiles = [&]() -> Result<bool> {
    mjModel* compiled = nullptr;
    TENON_CHECK(guarded([&] { compiled = mj_compile(built.spec.get(), files.get()); }));
    mj_deleteModel(compiled);
    return compiled != nullptr;
  };
  TENON_TRY(bool fits, compiles());
  if (!fits) {
    TENON_TRY(fits, kept.retry(compiles));
  }
  if (fits) {
    diagnostics.append(seen);
    diagnostics.append(measured);
    TENON_TRY(const std::string text, engines::mujoco::text_of(*built.spec));
    return finished_text(text, [&](std::string_view prim) {
      const auto shown = writer.names().find(prim);
      return name_of(shown == writer.names().end() ? prim : std::string_view(shown->second));
    });
  }
  if (!sees) {
    return Error(ErrorCode::Invalid, mjs_getError(built.spec.get())).with_rule("mujoco.write");
  }
  diagnostics.add(
      file_finding(Severity::Warning, "mjcf.left-out",
                   std::string("the visuals are skipped, because MuJoCo refuses them: ") +
                       mjs_getError(built.spec.get()),
                   "", 0));
  Diagnostics again;
  robot::RobotModel nothing;
  nothing.name = visuals.name;
  auto text = write_model(scene, nothing, {}, parts, name_of, again);
  append_new(again, diagnostics);
  return text;
}

}  // namespace tenon::mjcf
