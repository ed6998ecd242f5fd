// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tenon/robot/robot_model.h"
#include "tenon/sdf/model_files.h"
#include "tenon/sdf/model_tree.h"

/// Internal to this folder.
namespace tenon::sdf {

/// A robot in the making, and the placed tree of elements that it is made of.
struct SdfDraft {
  ModelTree tree;
  ModelFiles& files;
  robot::RobotModel model{};
  std::map<Index, Index> links{};  ///< by node, into model.links
  std::vector<Index> of_link{};    ///< (link_count) the node, or the world's
  std::optional<Index> world{};    ///< the link "world", where there is one
};

/// links.cpp: all links with their shapes, frames as sites, who collides with whom.
Result<void> read_links(SdfDraft& draft);
/// joints.cpp: all joints of models that move, and what follows what.
Result<void> read_joints(SdfDraft& draft);

/// Names the sensors, plugins and lights of a link, a joint or a model, each by itself.
void list_parts(const SdfNode& node);

/// roots.cpp: the link "world", made where it is first asked for.
Index world_link(SdfDraft& draft);
/// Links of static models: without mass, on fixed joints to the world. Before any joint is read.
void make_static(SdfDraft& draft);
/// Makes a tree of the links: joints beside it become loops, free links hang on the world where
/// there are several.
void make_tree(SdfDraft& draft);

}  // namespace tenon::sdf
