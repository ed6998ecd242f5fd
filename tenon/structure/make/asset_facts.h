// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/layer/dictionary.h"
#include "tenon/layer/layer.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/stage/stage.h"
#include "tenon/structure/make/robot_metadata.h"

namespace tenon::structure {

/// What SimReady wants to be said about an asset and no asset tells by itself; empty: not said.
struct AssetFacts {
  std::string author;
  std::string license;   ///< as SPDX names it, for one
  std::string category;  ///< "Manipulator"
  std::string qcode;     ///< of Wikidata, for what it is: "Q11012", a robot
  std::string name;
  std::string type;         ///< "robot"
  std::string source_file;  ///< without folders
  std::string date;         ///< on which it was made: "2026-11-29"
};

/// customLayerData as SimReady wants it: SimReady_Metadata with the facts and with what `content`,
/// composed as `stage` and read as `scene`, tells: count of bodies, size [m] of what is drawn, mass
/// [kg].
layer::Dictionary simready_metadata(const AssetFacts& facts, const layer::Layer& content,
                                    const stage::Stage& stage, const scene::PhysicsScene& scene);

/// Puts `data` over the customLayerData of the file that opens the asset: what was said before
/// stays where `data` says nothing.
void add_metadata(layer::Layer& interface, const layer::Dictionary& data);

/// What Isaac Sim knows robots as: "Manipulator", "Mobile Manipulators", ...
const std::vector<std::string>& known_robot_types();
/// Whether a robot of this kind stands on a base that does not move.
bool is_held(const std::string& robot_type);

/// Gives the robot's prim isaac:robotType where it has IsaacRobotAPI and `robot_type` is not empty,
/// and `for_simready` the kind "component" where it has none, and its parts in `order` their APIs.
void identify(layer::Layer& content, const KinematicOrder& order, const std::string& robot_type,
              bool for_simready);

}  // namespace tenon::structure
