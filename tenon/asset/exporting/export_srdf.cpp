// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// SRDF belongs to a URDF, so its names are those that export_urdf writes: display names. Where two
// links have one, the URDF gives the second a number, and pairs with it are listed as skipped.
#include "tenon/asset/exporting/export_srdf.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "tenon/asset/exporting/joint_motors.h"
#include "tenon/asset/exporting/kept_apart.h"
#include "tenon/asset/exporting/pose_values.h"
#include "tenon/asset/physics_options.h"
#include "tenon/base/text/source_number.h"
#include "tenon/describe/describe_robot.h"
#include "tenon/physics/read_physics.h"
#include "tenon/scene/joint_forest.h"
#include "tenon/urdf/xml_writer.h"

namespace tenon {
namespace {

constexpr const char* kSrdfRule = "srdf.left-out";
constexpr const char* kGroup = "all";

class SrdfExport {
 public:
  SrdfExport(const stage::Stage& stage, const scene::PhysicsScene& scene,
             const physics::Provenance& provenance, const robot::RobotModel& model,
             Diagnostics& diagnostics)
      : stage_(stage),
        scene_(scene),
        provenance_(provenance),
        model_(model),
        diagnostics_(diagnostics),
        motors_(joint_motors(stage, scene, kSrdfRule, "SRDF", diagnostics)) {}

  ExportedSrdf run() {
    name_bodies();
    out_.open("robot", {{"name", model_.name}});
    write_group();
    write_states();
    write_root();
    for (const JointMotor& motor : motors_) {
      if (!motor.driven && !motor.leader) {
        out_.empty("passive_joint", {{"name", motor.name}});
      }
    }
    write_pairs();
    out_.close("robot");
    return {out_.take(), model_.links.size(), model_.joints.size()};
  }

 private:
  void name_bodies() {
    std::map<std::string, std::size_t> counts;
    for (const scene::Body& body : scene_.bodies) {
      ++counts[shown_name(stage_, body.path)];
    }
    for (const scene::Body& body : scene_.bodies) {
      const std::string name = shown_name(stage_, body.path);
      names_.push_back(counts[name] == 1 ? std::optional(name) : std::nullopt);
    }
  }

  void write_group() {
    if (motors_.empty()) {
      return;
    }
    out_.open("group", {{"name", kGroup}});
    for (const JointMotor& motor : motors_) {
      out_.empty("joint", {{"name", motor.name}});
    }
    out_.close("group");
  }

  void write_state(const std::string& name,
                   const std::vector<std::pair<std::size_t, double>>& values) {
    out_.open("group_state", {{"name", name}, {"group", kGroup}});
    for (const auto& [at, value] : values) {
      out_.empty("joint", {{"name", motors_[at].name}, {"value", source_number(value)}});
    }
    out_.close("group_state");
  }

  void write_states() {
    std::vector<std::pair<std::size_t, double>> start;
    for (std::size_t i = 0; i < motors_.size(); ++i) {
      if (!motors_[i].leader) {
        start.emplace_back(i, motors_[i].start);
      }
    }
    bool named_start = start.empty();
    const auto poses = pose_values(stage_, motors_, scene_.meters_per_unit);
    for (const PoseValues& pose : poses) {
      named_start |= pose.first == "start";
    }
    if (!named_start) {
      write_state("start", start);
    }
    for (const PoseValues& pose : poses) {
      if (!pose.second.empty()) {
        write_state(pose.first, pose.second);
      }
    }
  }

  /// A root that floats; one that stands still is the root of the URDF itself.
  void write_root() {
    std::set<robot::Index> children;
    for (const robot::Joint& joint : model_.joints) {
      children.insert(joint.child);
    }
    for (robot::Index i = 0; i < model_.links.size(); ++i) {
      if (!children.contains(i) && model_.links[i].inertial) {
        out_.empty("virtual_joint", {{"name", "virtual_joint"},
                                     {"type", "floating"},
                                     {"parent_frame", "world"},
                                     {"child_link", model_.links[i].name}});
      }
    }
  }

  void write_pair(scene::Index a, scene::Index b, const char* reason) {
    const std::pair<scene::Index, scene::Index> ends = std::minmax(a, b);
    if (!written_.insert(ends).second) {
      return;
    }
    if (!names_[a] || !names_[b]) {
      Diagnostic finding;
      finding.severity = Severity::Warning;
      finding.rule = kSrdfRule;
      finding.message = "two links have the name of this one, so that a pair of it cannot be named";
      finding.prim = scene_.bodies[names_[a] ? b : a].path.str();
      diagnostics_.add(std::move(finding));
      return;
    }
    out_.empty("disable_collisions",
               {{"link1", *names_[a]}, {"link2", *names_[b]}, {"reason", reason}});
  }

  void write_pairs() {
    for (const scene::Joint& joint : scene_.joints) {
      if (joint.body0 && joint.body1 && joint.enabled && !joint.collision_enabled) {
        write_pair(*joint.body0, *joint.body1, "Adjacent");
      }
    }
    const KeptApart apart = kept_apart(scene_, provenance_);
    for (const auto& [a, b] : apart.pairs) {
      write_pair(a, b, "User");
    }
    if (apart.is_cut) {
      Diagnostic finding;
      finding.severity = Severity::Warning;
      finding.rule = kSrdfRule;
      finding.message = "filters keep more pairs of links apart than are written, " +
                        std::to_string(apart.pairs.size()) + " (kDisabledPairs, kDisabledPairWork)";
      finding.fix = "turn the self-collision of the articulation off";
      diagnostics_.add(std::move(finding));
    }
  }

  const stage::Stage& stage_;
  const scene::PhysicsScene& scene_;
  const physics::Provenance& provenance_;
  const robot::RobotModel& model_;
  Diagnostics& diagnostics_;
  std::vector<JointMotor> motors_;
  std::vector<std::optional<std::string>> names_;  // (body_count)
  std::set<std::pair<scene::Index, scene::Index>> written_;
  urdf::XmlWriter out_;
};

}  // namespace

Result<ExportedSrdf> export_srdf(const stage::Stage& stage, Diagnostics& diagnostics) {
  physics::Provenance provenance;
  const scene::PhysicsScene scene =
      physics::read_physics(stage, read_options(), diagnostics, &provenance);
  Diagnostics of_urdf;  // the URDF beside it tells what it lacks
  TENON_TRY(const robot::RobotModel model, describe::describe_robot(stage, scene, of_urdf));
  return SrdfExport(stage, scene, provenance, model, diagnostics).run();
}

}  // namespace tenon
