// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/base/diagnostics.h"
#include "tenon/convert/convert_robot.h"
#include "tenon/convert/layer_builder.h"
#include "tenon/convert/legal_names.h"
#include "tenon/math/transform.h"
#include "tenon/robot/kinematic_tree.h"

/// Internal to this folder.
namespace tenon::convert {

/// What is converted. All of it outlives the conversion.
struct Source {
  const robot::RobotModel& model;
  const robot::KinematicTree& tree;  ///< of the model
  const ConvertOptions& options;
};

/// The layer of a robot while it is made: what all parts of a conversion write to, and where they
/// say what is wrong with the description.
class RobotLayer {
 public:
  /// A layer with the robot's prim. All references outlive this.
  RobotLayer(const robot::RobotModel& model, Diagnostics& diagnostics);

  LayerBuilder& builder() { return builder_; }
  Diagnostics& diagnostics() { return diagnostics_; }
  Path robot() const { return robot_; }

  /// A new prim with a free name of `names`, as near to `wanted` as prims can have; one that is
  /// named otherwise shows `wanted`.
  Path define(Path parent, NameScope& names, const std::string& wanted, Token type);
  /// Lets a prim show the name that the description has for it, where that is another; empty: none.
  void show_name(Path prim, const std::string& wanted);
  /// Transforms a prim: `scale`, then `pose` in its parent [m].
  void set_pose(Path prim, const Pose& pose, const Vec3d& scale = {{1, 1, 1}});
  /// The same with all three operations and the types that the tutorial has.
  void set_tutorial_pose(Path prim, const Pose& pose);

  /// Adds a finding about a place in the description.
  void report(const robot::Place& place, Severity severity, const char* rule, std::string message,
              std::string fix);

  /// The layer, when everything is written.
  layer::Layer take() { return builder_.take(); }

 private:
  const robot::RobotModel& model_;
  Diagnostics& diagnostics_;
  LayerBuilder builder_;
  Path robot_;
};

/// The scope of joints and of what stands among them.
class PhysicsScope {
 public:
  explicit PhysicsScope(RobotLayer& layer)
      : layer_(layer), path_(layer.builder().define(layer.robot(), "Physics", "Scope")) {}

  RobotLayer& layer() { return layer_; }
  LayerBuilder& builder() { return layer_.builder(); }
  Path path() const { return path_; }

  /// A new prim in the scope, named as RobotLayer::define does.
  Path define(const std::string& wanted, Token type) {
    return layer_.define(path_, names_, wanted, type);
  }
  /// A free name for a prim that the description does not name.
  Token free_name(const std::string& wanted) { return names_.make(wanted); }

 private:
  RobotLayer& layer_;
  Path path_;
  NameScope names_;
};

}  // namespace tenon::convert
