// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/view/view_camera.h"

#include <cmath>

#include "tenon/stage/transform_at.h"

namespace tenon::view {
namespace {

Error no_view_from(const std::string& path, const std::string& why) {
  return Error(ErrorCode::Unsupported, "this prim cannot be looked from: " + why)
      .with_prim(path)
      .with_rule("view.camera")
      .with_fix("name a prim of type Camera, or choose angles (--azimuth, --elevation)");
}

/// The rotation of a matrix whose axes may be scaled.
std::optional<Pose> pose_of(const Mat4d& m) {
  const Vec3d scale = row_scale(m);
  Mat3d rotation;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      rotation[i][j] = m[i][j] / scale[i];
    }
  }
  const Pose pose{{{m[3][0], m[3][1], m[3][2]}}, normalized(rotation_of(rotation))};
  return is_finite(pose) ? std::optional(pose) : std::nullopt;
}

}  // namespace

Result<ViewCamera> find_camera(const stage::Stage& stage, const scene::PhysicsScene& scene,
                               const std::string& path) {
  TENON_TRY(const Path place, Path::parse(path));
  const stage::Prim prim = stage.prim(place);
  if (!prim) {
    return Error(ErrorCode::NotFound, "there is no such prim to look from")
        .with_prim(path)
        .with_rule("view.camera")
        .with_fix("tenon tree lists the prims of an asset");
  }
  std::optional<Index> body;
  Pose frame;
  for (Path above = place; above.is_prim() && !body; above = above.parent()) {
    for (std::size_t i = 0; i < scene.bodies.size() && !body; ++i) {
      if (scene.bodies[i].path == above) {
        body = static_cast<Index>(i);
        frame = scene.bodies[i].pose;
      }
    }
  }
  const stage::Time time(scene.start_time_code);
  const double unit = scene.meters_per_unit;
  return read_camera(prim, time,
                     stage::local_to_world(prim, time) * scale_matrix({{unit, unit, unit}}) *
                         inverse(pose_matrix(frame)),
                     body);
}

Result<ViewCamera> read_camera(const stage::Prim& prim, stage::Time time, const Mat4d& in_frame,
                               std::optional<Index> body) {
  const std::string path = prim.path().str();
  const auto number = [&](const char* name) -> double {
    return prim.attribute(Token(name)).get_as<float>(time).value_or(0);
  };
  if (!prim.is_a("Camera")) {
    return no_view_from(
        path, "its type is " +
                  (prim.type_name().str().empty() ? std::string("none") : prim.type_name().str()));
  }
  if (prim.attribute("projection").get_as<Token>(time) == Token("orthographic")) {
    return no_view_from(path, "its projection is orthographic");
  }
  ViewCamera camera;
  camera.path = prim.path();
  camera.body = body;
  const double focal = number("focalLength");
  camera.half_width = number("horizontalAperture") / 2 / focal;
  camera.half_height = number("verticalAperture") / 2 / focal;
  if (!(focal > 0) || !(camera.half_width > 0) || !(camera.half_height > 0) ||
      !is_finite(camera.half_width) || !is_finite(camera.half_height)) {
    return no_view_from(path, "its focal length and apertures have to be more than zero");
  }
  const std::optional<Pose> pose = pose_of(in_frame);
  if (!pose) {
    return no_view_from(path, "its place is not finite");
  }
  camera.pose = *pose;
  return camera;
}

}  // namespace tenon::view
