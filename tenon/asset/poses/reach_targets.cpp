// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A frame is a prim on a body: the body's own, or one below it that is on no other body, such as a
// site at a finger tip. It is named by its path, or by the name of a body where one body has it.
// Places are in the world of the stage at its start, in its units unless a unit follows the
// number.
#include "tenon/asset/poses/reach_targets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "tenon/base/text/nearest_name.h"
#include "tenon/base/text/quoted_text.h"
#include "tenon/base/text/text_number.h"
#include "tenon/stage/transform_at.h"

namespace tenon {
namespace {

constexpr const char* kPlaceForm = "write FRAME=X,Y,Z, as in /hand/tip=0.1,0,25mm";
constexpr const char* kTurnForm =
    "write W,X,Y,Z of a quaternion or X,Y,Z of angles in degrees, with FRAME= in front where "
    "several frames are placed";

Error bad_target(const std::string& text, const std::string& what, const char* form) {
  return Error(ErrorCode::Invalid, quoted_text(text.substr(0, 100)) + " " + what)
      .with_rule("pose.bad-target")
      .with_fix(form);
}

Error no_frame(const std::string& message, const std::string& fix) {
  return Error(ErrorCode::NotFound, message).with_rule("pose.no-frame").with_fix(fix);
}

/// Metres of a number with m, cm or mm behind it, else of a number of units.
std::optional<double> length_of_text(std::string_view text, double meters_per_unit) {
  constexpr std::array<std::pair<std::string_view, double>, 3> kUnits{
      {{"mm", 0.001}, {"cm", 0.01}, {"m", 1}}};
  double unit = meters_per_unit;
  for (const auto& [name, size] : kUnits) {
    if (text.ends_with(name)) {
      text.remove_suffix(name.size());
      unit = size;
      break;
    }
  }
  const std::optional<double> number = parse_double(text);
  return number && std::isfinite(*number) ? std::optional(*number * unit) : std::nullopt;
}

std::vector<std::string_view> numbers_of(std::string_view text) {
  std::vector<std::string_view> parts;
  std::size_t begin = 0;
  while (begin <= text.size() && parts.size() < 6) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

/// "FRAME=NUMBERS"; the frame is empty where there is no '='.
std::pair<std::string, std::string> frame_and_numbers(const std::string& text) {
  const std::size_t equals = text.rfind('=');
  return equals == std::string::npos ? std::pair(std::string(), text)
                                     : std::pair(text.substr(0, equals), text.substr(equals + 1));
}

/// Finds prims on bodies.
class FrameNames {
 public:
  FrameNames(const stage::Stage& stage, const scene::PhysicsScene& scene)
      : stage_(stage), scene_(scene) {
    for (scene::Index i = 0; i < scene.bodies.size(); ++i) {
      bodies_.emplace(scene.bodies[i].path, i);
      names_[scene.bodies[i].path.name().str()].push_back(scene.bodies[i].path);
    }
  }

  Result<PlacedPrim> find(const std::string& text) const {
    TENON_TRY(const Path path, path_of(text));
    PlacedPrim placed{path, {}};
    const stage::Prim prim = stage_.prim(path);
    if (!prim) {
      return no_frame("there is no prim " + path.str(), "tenon tree ASSET lists the prims");
    }
    for (Path above = path; above.is_prim(); above = above.parent()) {
      const auto body = bodies_.find(above);
      if (body == bodies_.end()) {
        continue;
      }
      placed.target.body = body->second;
      TENON_TRY(placed.target.frame, frame_in(prim, body->second));
      return placed;
    }
    return no_frame(
        path.str() + " is on no body, so no joint moves it",
        "name a link, or a prim below one: tenon tree ASSET --show physics lists links");
  }

 private:
  Result<Path> path_of(const std::string& text) const {
    const auto path = Path::parse(text);
    if (path && path->is_absolute() && path->is_prim()) {
      return *path;
    }
    const auto found = names_.find(text);
    if (found == names_.end()) {
      std::vector<std::string_view> names;
      for (const auto& [name, paths] : names_) {
        names.push_back(name);
      }
      const std::string_view near =
          text.size() < 200 ? nearest_name(text, names) : std::string_view();
      return no_frame("no link is called " + quoted_text(text.substr(0, 100)),
                      near.empty() ? "tenon tree ASSET --show physics lists the links"
                                   : "did you mean " + std::string(near) + "?");
    }
    if (found->second.size() > 1) {
      return no_frame("several links are called " + quoted_text(text),
                      "give its path, such as " + found->second.front().str());
    }
    return found->second.front();
  }

  Result<Pose> frame_in(const stage::Prim& prim, scene::Index body) const {
    const Pose& world = scene_.bodies[body].pose;
    if (prim.path() == scene_.bodies[body].path) {
      return Pose{};
    }
    const Mat4d matrix = stage::local_to_world(prim, stage::Time(scene_.start_time_code));
    const Vec3d scale = row_scale(matrix);
    Mat3d rotation;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        rotation[i][j] = matrix[i][j] / scale[i];
      }
    }
    const double unit = scene_.meters_per_unit;
    const Pose frame = inverse(world) *
                       Pose{Vec3d{{matrix[3][0] * unit, matrix[3][1] * unit, matrix[3][2] * unit}},
                            normalized(rotation_of(rotation))};
    if (!is_finite(frame)) {
      return no_frame(prim.path().str() + " has no finite place", "correct its transform");
    }
    return frame;
  }

  const stage::Stage& stage_;
  const scene::PhysicsScene& scene_;
  std::map<Path, scene::Index> bodies_;
  std::map<std::string, std::vector<Path>> names_;
};

Result<PlacedPrim> read_place(const FrameNames& frames, const scene::PhysicsScene& scene,
                              const std::string& text) {
  const auto [frame, numbers] = frame_and_numbers(text);
  if (frame.empty()) {
    return bad_target(text, "names no frame and place", kPlaceForm);
  }
  TENON_TRY(PlacedPrim placed, frames.find(frame));
  const std::vector<std::string_view> parts = numbers_of(numbers);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto number = parts.size() == 3 ? length_of_text(parts[i], scene.meters_per_unit)
                                          : std::optional<double>();
    if (!number) {
      return bad_target(text, "has no place of three numbers", kPlaceForm);
    }
    placed.target.position[i] = *number;
  }
  return placed;
}

/// About x first, then y, then z, as xformOp:rotateXYZ turns.
Quatd turned_by_degrees(const std::vector<double>& degrees) {
  Quatd turn = kIdentityRotation;
  for (std::size_t i = 0; i < 3; ++i) {
    Vec3d axis;
    axis[i] = 1;
    turn = rotation_about(axis, degrees[i] * M_PI / 180) * turn;
  }
  return normalized(turn);
}

Result<Quatd> read_turn(const std::string& text, std::string_view numbers) {
  std::vector<double> values;
  for (const std::string_view part : numbers_of(numbers)) {
    const std::optional<double> number = parse_double(part);
    if (!number || !std::isfinite(*number)) {
      return bad_target(text, "is no rotation", kTurnForm);
    }
    values.push_back(*number);
  }
  if (values.size() == 3) {
    return turned_by_degrees(values);
  }
  const bool is_quaternion =
      values.size() == 4 &&
      std::any_of(values.begin(), values.end(), [](double value) { return value != 0; });
  if (!is_quaternion) {
    return bad_target(text, "is no rotation", kTurnForm);
  }
  return normalized(Quatd{values[1], values[2], values[3], values[0]});
}

Result<void> add_turn(const FrameNames& frames, const std::string& text,
                      std::vector<PlacedPrim>& placed) {
  const auto [frame, numbers] = frame_and_numbers(text);
  TENON_TRY(const Quatd turn, read_turn(text, numbers));
  if (frame.empty() && placed.size() == 1) {
    placed.front().target.orientation = turn;
    return {};
  }
  if (frame.empty()) {
    return bad_target(text, "does not say which frame is meant", kTurnForm);
  }
  TENON_TRY(const PlacedPrim named, frames.find(frame));
  const auto found = std::find_if(placed.begin(), placed.end(),
                                  [&](const PlacedPrim& one) { return one.prim == named.prim; });
  if (found == placed.end()) {
    return bad_target(text, "turns a frame that no place is given for",
                      "give its place, too: --ik FRAME=X,Y,Z");
  }
  found->target.orientation = turn;
  return {};
}

}  // namespace

Result<std::vector<PlacedPrim>> reach_targets(const stage::Stage& stage,
                                              const scene::PhysicsScene& scene,
                                              const PoseRequest& request) {
  const FrameNames frames(stage, scene);
  std::vector<PlacedPrim> placed;
  for (const std::string& text : request.ik) {
    TENON_TRY(PlacedPrim one, read_place(frames, scene, text));
    placed.push_back(one);
  }
  for (const std::string& text : request.rotation) {
    TENON_CHECK(add_turn(frames, text, placed));
  }
  return placed;
}

Result<PlacedPrim> placed_prim(const stage::Stage& stage, const scene::PhysicsScene& scene,
                               const std::string& text) {
  return FrameNames(stage, scene).find(text);
}

}  // namespace tenon
