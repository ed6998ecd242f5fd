// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Rows of a tree come depth first with their depths; whether one is the last below its parent is
// known when the rows behind it are looked at from the end.
#include "cli/text/forest_text.h"

#include <cstddef>
#include <vector>

#include "cli/text/text_table.h"
#include "tenon/base/text/rounded_text.h"
#include "tenon/scene/physics_counts.h"

namespace tenon::cli {
namespace {

using answers::Json;
using scene::Index;
using scene::Joint;
using scene::JointForest;
using scene::PhysicsScene;

/// The name of a prim; of none the world.
std::string last_name(const Json& path) {
  if (path.is_null()) {
    return "world";
  }
  const std::string text = path.get<std::string>();
  return text.substr(text.rfind('/') + 1);
}

std::string mass_words(const Json& row) {
  return rounded_text(row["mass_kg"].get<double>()) + " kg";
}

std::string bound_words(const Json& bound, const char* open_end) {
  return bound.is_null() ? open_end : rounded_text(bound.get<double>());
}

/// "rotZ -10..80 deg, driven"; of a joint with one the name is not said.
std::string dof_words(const Json& dof, bool alone) {
  std::string text = alone ? "" : dof["dof"].get<std::string>() + " ";
  if (dof["lower"].is_null() && dof["upper"].is_null()) {
    text += "no bounds";
  } else {
    text += bound_words(dof["lower"], "-inf") + ".." + bound_words(dof["upper"], "inf") + " " +
            dof["unit"].get<std::string>();
  }
  return text + (dof["driven"].get<bool>() ? ", driven" : "");
}

std::string dofs_words(const Json& joint) {
  std::string text;
  for (const Json& dof : joint["dofs"]) {
    text += (text.empty() ? "" : "; ") + dof_words(dof, joint["dofs"].size() == 1);
  }
  return text;
}

std::string follows_words(const Json& joint) {
  std::string text;
  for (const Json& one : joint["follows"]) {
    text += (text.empty() ? "follows " : ", ") + last_name(one["leader"]) + " x " +
            rounded_text(one["multiplier"].get<double>()) +
            (one["rigid"].get<bool>() ? "" : " (spring)");
  }
  return text;
}

/// "thumb_1_joint: revolute, -10..80 deg, driven, follows ..."
std::string joint_line(const Json& joint) {
  std::string text = last_name(joint["joint"]) + ": " + joint["type"].get<std::string>();
  for (const std::string& part : {dofs_words(joint), follows_words(joint)}) {
    text += part.empty() ? "" : ", " + part;
  }
  return text;
}

/// The lines before the words of each row of a tree: "|  `-- ".
std::vector<std::string> branches(const Json& rows) {
  std::vector<char> more;  // at each depth: a later row of the same parent follows
  std::vector<std::string> result(rows.size());
  for (std::size_t i = rows.size(); i-- > 0;) {
    const auto depth = rows[i]["depth"].get<std::size_t>();
    const bool is_last = depth >= more.size() || more[depth] == 0;
    more.resize(depth + 1, 0);
    for (std::size_t d = 0; d < depth; ++d) {
      result[i] += more[d] != 0 ? "|   " : "    ";
    }
    result[i] += is_last ? "`-- " : "|-- ";
    more[depth] = 1;
  }
  return result;
}

std::string articulation_text(const Json& forest) {
  std::string text = "world\n";
  const std::vector<std::string> lines = branches(forest["rows"]);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Json& row = forest["rows"][i];
    const std::string link = last_name(row["link"]) + "  " + mass_words(row);
    const char* const loose = row["kinematic"].get<bool>() ? "  (kinematic)" : "  (free)";
    text += lines[i] +
            (row["joint"].is_null() ? link + loose : "(" + joint_line(row["joint"]) + ") " + link) +
            "\n";
  }
  for (const Json& loop : forest["loops"]) {
    text += "loop  (" + joint_line(loop) + ") " + last_name(loop["body0"]) + " - " +
            last_name(loop["body1"]) + "\n";
  }
  return text;
}

std::string flat_text(const Json& forest) {
  std::vector<std::vector<std::string>> links{{"link", "mass", "parent"}};
  for (const Json& link : forest["links"]) {
    links.push_back({link["link"].get<std::string>(), mass_words(link), last_name(link["parent"])});
  }
  std::vector<std::vector<std::string>> joints{
      {"joint", "type", "from", "to", "part of", "moves", "follows"}};
  for (const Json& joint : forest["joints"]) {
    joints.push_back({joint["joint"].get<std::string>(), joint["type"].get<std::string>(),
                      last_name(joint["body0"]), last_name(joint["body1"]),
                      joint["role"].get<std::string>(), dofs_words(joint), follows_words(joint)});
  }
  return text_table(links) + "\n" + text_table(joints);
}

std::string mujoco_text(const Json& forest) {
  std::string text = "worldbody\n";
  const std::vector<std::string> lines = branches(forest["bodies"]);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Json& body = forest["bodies"][i];
    std::string joints;
    for (const Json& joint : body["joints"]) {
      joints += (joints.empty() ? "" : ", ") + joint["type"].get<std::string>() + " " +
                last_name(joint["joint"]);
    }
    const std::string base = body["base"].get<std::string>();
    joints = !joints.empty() ? joints : base == "free" ? "freejoint" : "welded";
    text += lines[i] + last_name(body["body"]) + "  " + mass_words(body) + "  (" + joints + ")\n";
  }
  for (const Json& one : forest["constraints"]) {
    text += "constraint  " + last_name(one["joint"]) + ": " + one["type"].get<std::string>() + " ";
    text += one.contains("leader") ? last_name(one["leader"])
                                   : last_name(one["body0"]) + " - " + last_name(one["body1"]);
    text += "\n";
  }
  return text;
}

std::string joint_words(const Joint& joint) {
  const std::size_t dofs = scene::free_dofs(joint);
  return joint.path.name().str() + ": " + std::string(scene::joint_kind_name(joint.kind)) + ", " +
         std::to_string(dofs) + " dof" + (joint.mimics.empty() ? "" : ", mimic") +
         (joint.drives.empty() ? "" : ", driven");
}

std::string link_words(const PhysicsScene& scene, Index index, const scene::ForestBody& link) {
  const scene::Body& body = scene.bodies[index];
  const std::string hung = link.joint ? joint_words(scene.joints[*link.joint])
                                      : (body.kinematic ? "kinematic" : "free, 6 dof");
  return body.path.name().str() + "  " + rounded_text(body.mass) + " kg  (" + hung + ")";
}

}  // namespace

std::string forest_as_text(const Json& forest) {
  std::string text;
  for (const Json& articulation : forest["articulations"]) {
    text += "articulation  " + articulation["path"].get<std::string>() + ": " +
            std::to_string(articulation["links"].get<std::size_t>()) + " links, " +
            std::to_string(articulation["joints"].get<std::size_t>()) + " joints, root " +
            last_name(articulation["root"]) +
            (articulation["fixedBase"].get<bool>() ? ", fixed to the world" : ", floating") + "\n";
  }
  const std::string form = forest["as"].get<std::string>();
  return text + (form == "flat"     ? flat_text(forest)
                 : form == "mujoco" ? mujoco_text(forest)
                                    : articulation_text(forest));
}

std::string forest_text(const PhysicsScene& scene, const JointForest& forest) {
  struct Open {
    Index body;
    std::string indent;
    bool last;
  };
  std::string text = "world\n";
  std::vector<Open> open;
  auto push = [&](const std::vector<Index>& bodies, const std::string& indent) {
    for (std::size_t i = bodies.size(); i-- > 0;) {
      open.push_back({bodies[i], indent, i + 1 == bodies.size()});
    }
  };
  push(forest.roots, " ");
  while (!open.empty()) {
    const Open at = open.back();
    open.pop_back();
    text += at.indent + (at.last ? "`--" : "|--") +
            link_words(scene, at.body, forest.bodies[at.body]) + "\n";
    push(forest.bodies[at.body].children, at.indent + (at.last ? "   " : "|  "));
  }
  for (const Index joint : forest.loop_joints) {
    text += " loop  " + joint_words(scene.joints[joint]) + "\n";
  }
  return text;
}

}  // namespace tenon::cli
