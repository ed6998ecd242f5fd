// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/sdf/model_files.h"
#include "tenon/sdf/sdf_file.h"

/// Internal to this folder.
namespace tenon::sdf {

using robot::Index;

enum class NodeKind : std::uint8_t { World, Model, Link, Frame, Joint };

/// A thing with a frame of its own, which others may name.
struct SdfNode {
  NodeKind kind = NodeKind::World;
  std::string name;  ///< with the names of the models that nest it: "arm::hand"
  Index model = 0;   ///< into ModelTree::models
  SdfFile* file = nullptr;
  pugi::xml_node element;
  WrittenPose pose{};           ///< of a model with a placement frame: of that
  Index reference = 0;          ///< the node that `pose` is relative to
  Index attached = 0;           ///< of Frame: what it moves with; of Joint: the child
  Index parent = 0;             ///< of Joint
  std::optional<Index> link{};  ///< the node of the link that it moves with; none: the world
  Pose in_reference{};          ///< of the node
  Pose in_world{};
};

struct SdfModel {
  std::string name;
  std::string prefix;  ///< of the names of what it holds: "arm::", empty of the chosen model
  Index node = 0;      ///< into ModelTree::nodes
  Index parent = 0;    ///< into ModelTree::models; of the world 0
  Index scope = 0;  ///< the model whose names its elements use: itself, or what it is merged into
  SdfFile* file = nullptr;
  pugi::xml_node element;  ///< <model>, <world>; none
  bool is_static = false;  ///< or nested in one that is
  std::string placement_frame;
  std::map<std::string, Index> nodes;     ///< by name, one level; models too
  std::map<std::string, Index> children;  ///< nested models, into ModelTree::models
  std::optional<Index> first_link;        ///< the canonical one, into ModelTree::nodes
};

/// A model with all that it nests. The first model and the first node are the world, the second
/// ones the model that was asked for. Each model comes after the one that nests it.
struct ModelTree {
  std::vector<SdfModel> models;
  std::vector<SdfNode> nodes;

  /// What a name, "a::b", means for the elements of a model.
  std::optional<Index> find(Index model, const std::string& name) const;
};

/// What is converted, and the element that says so.
struct ChosenModel {
  SdfFile* file = nullptr;
  pugi::xml_node element;  ///< <model> or <include>
  SdfFile* world_file = nullptr;
  pugi::xml_node world;  ///< that holds it; none
};

/// The only model of a file, or the one of a name. Errors: NotFound without one, Invalid for
/// several, which are listed with what to type.
Result<ChosenModel> choose_model(SdfFile& file, const std::string& name);

/// The elements of a model by their names. Includes that cannot be found are skipped and reported.
/// Errors (Parse, Limit): duplicate names, unknown ones, too many, nested too deep.
Result<ModelTree> gather_model(const ChosenModel& chosen, ModelFiles& files);

/// Gives every node its place in the world and its link. Errors (Parse): poses in a cycle, joints
/// of a model without links.
Result<void> place_nodes(ModelTree& tree);

/// The place of node `b` in the frame of `a`, exact where one is written in the other.
Pose pose_between(const ModelTree& tree, Index a, Index b);

}  // namespace tenon::sdf
