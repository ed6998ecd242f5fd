// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A joint has a frame of its own, by default that of its child, and its axis is written in that
// frame or in another one. Joints of two axes turn first about the one in the parent: they become
// two joints with a link of a millionth of the child's mass between. So does a screw: it turns, and
// slides by a mimic. What the child is and what the parent, where a child has two, roots.cpp says.
#include <cmath>

#include "tenon/math/angle.h"
#include "tenon/sdf/sdf_draft.h"

namespace tenon::sdf {

using robot::JointKind;

namespace {

constexpr double kNoSdfLimit = 1e9;  // SDF writes 1e16 and inf for none, this program 1e9

struct TypeRow {
  const char* type;
  JointKind kind;
  std::size_t axes;
};
constexpr TypeRow kTypes[] = {
    {"fixed", JointKind::Fixed, 0},
    {"revolute", JointKind::Revolute, 1},
    {"continuous", JointKind::Continuous, 1},
    {"prismatic", JointKind::Prismatic, 1},
    {"ball", JointKind::Ball, 0},
    {"universal", JointKind::Revolute, 2},
    {"revolute2", JointKind::Revolute, 2},
    {"screw", JointKind::Revolute, 1},
};

/// The shares of a link between two joints.
constexpr double kBetweenShare = 1e-6;

double no_limit_beyond(double value) {
  return std::fabs(value) >= kNoSdfLimit ? std::copysign(robot::kUnlimited, value) : value;
}

/// None where the number is negative, or none.
double upper_bound(double value) {
  return !(value >= 0) || value >= kNoSdfLimit ? robot::kUnlimited : value;
}

/// One <axis> of a joint.
struct Axis {
  Vec3d direction{{0, 0, 1}};  ///< in the joint frame
  pugi::xml_node element;
};

class JointReader {
 public:
  explicit JointReader(SdfDraft& draft) : draft_(draft), tree_(draft.tree), model_(draft.model) {}

  Result<void> read_joint(Index number);
  Result<void> read_mimics();

 private:
  Result<void> add_joint(const SdfNode& node, robot::Joint joint);
  Result<std::vector<Axis>> read_axes(Index number, std::size_t count);
  static Result<void> read_axis(const SdfNode& node, const Axis& axis, robot::Joint& joint);
  Result<void> read_screw(const SdfNode& node, const robot::Joint& joint, const Axis& axis);
  Result<void> read_two_axes(Index number, const robot::Joint& joint,
                             const std::vector<Axis>& axes);
  std::pair<robot::Joint, robot::Joint> split(const robot::Joint& joint, const std::string& first,
                                              const std::string& second);

  SdfDraft& draft_;
  const ModelTree& tree_;
  robot::RobotModel& model_;
  std::map<std::pair<Index, int>, Index> axis_joints_;  // by joint's node and axis, into joints
  std::map<Index, std::vector<Axis>> axes_;             // of a joint's node
};

Result<std::vector<Axis>> JointReader::read_axes(Index number, std::size_t count) {
  const SdfNode& node = tree_.nodes[number];
  SdfFile& file = *node.file;
  std::vector<Axis> axes;
  for (std::size_t i = 0; i < count; ++i) {
    Axis axis;
    axis.element = node.element.child(i == 0 ? "axis" : "axis2");
    if (!axis.element) {
      file.warn(node.element, "sdf.missing",
                std::string("needs an <") + (i == 0 ? "axis" : "axis2") + ">; 0 0 1 is used",
                "add <axis><xyz>0 0 1</xyz></axis>", Severity::Error);
    }
    file.list_skipped(axis.element, {"xyz", "limit", "dynamics", "mimic", "use_parent_model_frame"},
                      {"initial_position"});
    TENON_TRY(const std::vector<double> xyz, file.numbers(axis.element, "xyz", {0, 0, 1}));
    axis.direction = {{xyz[0], xyz[1], xyz[2]}};
    std::string in = axis.element.child("xyz").attribute("expressed_in").value();
    TENON_TRY(const bool of_model,
              file.flag(axis.element, "use_parent_model_frame", file.minor_version() < 5));
    if (in.empty() && of_model && file.minor_version() < 7) {
      in = "__model__";
    }
    if (!in.empty()) {
      const auto frame = tree_.find(node.model, in);
      if (!frame) {
        return file.fault(axis.element.child("xyz"), "sdf.frame-missing",
                          "no link, joint, frame or model is named \"" + in + "\"",
                          "name one that is there, or leave expressed_in out");
      }
      axis.direction = rotate(pose_between(tree_, number, *frame).orientation, axis.direction);
    }
    axes.push_back(axis);
  }
  return axes;
}

Result<void> JointReader::read_axis(const SdfNode& node, const Axis& axis, robot::Joint& joint) {
  SdfFile& file = *node.file;
  joint.axis = axis.direction;
  const pugi::xml_node limit = axis.element.child("limit");
  file.list_skipped(limit, {"lower", "upper", "effort", "velocity"}, {"stiffness", "dissipation"});
  TENON_TRY(const double lower, file.number(limit, "lower", -kNoSdfLimit));
  TENON_TRY(const double upper, file.number(limit, "upper", kNoSdfLimit));
  if (lower > -kNoSdfLimit || upper < kNoSdfLimit) {
    joint.limit = robot::Limit{no_limit_beyond(lower), no_limit_beyond(upper)};
  }
  if (joint.kind == JointKind::Revolute && !joint.limit) {
    joint.kind = JointKind::Continuous;
  } else if (joint.kind == JointKind::Continuous) {
    joint.limit.reset();
  }
  TENON_TRY(const double effort, file.number(limit, "effort", -1));
  TENON_TRY(const double velocity, file.number(limit, "velocity", -1));
  if (effort == 0 || velocity == 0) {
    file.warn(limit, "sdf.zero-limit",
              std::string(effort == 0 ? "effort" : "velocity") + " 0 of joint \"" + joint.name +
                  "\" is treated as unlimited",
              "give the limit, or leave it out");
  }
  joint.effort_limit = upper_bound(effort == 0 ? -1 : effort);
  joint.velocity_limit = upper_bound(velocity == 0 ? -1 : velocity);
  TENON_TRY(const double rotor, file.number(node.element, "drake:rotor_inertia", 0));
  TENON_TRY(const double gear, file.number(node.element, "drake:gear_ratio", 1));
  joint.armature = rotor * gear * gear;
  const pugi::xml_node dynamics = axis.element.child("dynamics");
  file.list_skipped(dynamics, {"damping", "friction", "spring_reference", "spring_stiffness"}, {});
  TENON_TRY(joint.damping, file.number(dynamics, "damping", 0));
  TENON_TRY(joint.friction, file.number(dynamics, "friction", 0));
  TENON_TRY(joint.spring_reference, file.number(dynamics, "spring_reference", 0));
  TENON_TRY(joint.stiffness, file.number(dynamics, "spring_stiffness", 0));
  return {};
}

/// Two joints with a link between, in the place of one.
std::pair<robot::Joint, robot::Joint> JointReader::split(const robot::Joint& joint,
                                                         const std::string& first,
                                                         const std::string& second) {
  const robot::Link& child = model_.links[joint.child];
  robot::Link between;
  between.name = joint.name + "_between";
  between.place = joint.place;
  between.gravity_scale = child.gravity_scale;
  if (child.inertial) {
    robot::Inertial& inertial = between.inertial.emplace(*child.inertial);
    inertial.mass *= kBetweenShare;
    for (auto& row : inertial.inertia.m) {
      for (double& moment : row) {
        moment *= kBetweenShare;
      }
    }
  }
  const auto number = static_cast<Index>(model_.links.size());
  model_.links.push_back(std::move(between));
  draft_.of_link.push_back(draft_.of_link[joint.child]);
  std::pair<robot::Joint, robot::Joint> both{joint, joint};
  both.first.name = first;
  both.first.child = number;
  both.second.name = second;
  both.second.parent = number;
  both.second.origin = {};
  return both;
}

Result<void> JointReader::read_screw(const SdfNode& node, const robot::Joint& joint,
                                     const Axis& axis) {
  SdfFile& file = *node.file;
  constexpr double kTurn = 2 * kPi;
  double pitch = 0;  // metres for each turn
  if (node.element.child("screw_thread_pitch") || !node.element.child("thread_pitch")) {
    TENON_TRY(pitch, file.number(node.element, "screw_thread_pitch", -kTurn));
  } else {
    TENON_TRY(const double turns, file.number(node.element, "thread_pitch", 1));
    pitch = turns == 0 ? 0 : -kTurn / turns;  // radians for each metre, the other way round
  }
  file.warn(node.element, "sdf.two-joints",
            "the screw \"" + joint.name + "\" becomes a joint that turns and one, \"" + joint.name +
                "_slide\", that slides as it follows",
            "", Severity::Info);
  auto [turns, slides] = split(joint, joint.name, joint.name + "_slide");
  TENON_CHECK(read_axis(node, axis, turns));
  slides.kind = JointKind::Prismatic;
  slides.axis = axis.direction;
  slides.mimic.emplace();
  slides.mimic->leader = static_cast<Index>(model_.joints.size());
  slides.mimic->multiplier = pitch / kTurn;
  slides.mimic->place = turns.place;
  TENON_CHECK(add_joint(node, std::move(turns)));
  return add_joint(node, std::move(slides));
}

Result<void> JointReader::add_joint(const SdfNode& node, robot::Joint joint) {
  if (joint.parent == joint.child) {
    return node.file->fault(node.element, "sdf.joint-ends",
                            "joins the link \"" + model_.links[joint.child].name + "\" with itself",
                            "name two links");
  }
  model_.joints.push_back(std::move(joint));
  return {};
}

Result<void> JointReader::read_two_axes(Index number, const robot::Joint& joint,
                                        const std::vector<Axis>& axes) {
  const SdfNode& node = tree_.nodes[number];
  node.file->warn(node.element, "sdf.two-joints",
                  "the joint \"" + node.name + "\" of two axes becomes two, with a link between",
                  "", Severity::Info);
  auto [first, second] = split(joint, joint.name + "_1", joint.name + "_2");
  TENON_CHECK(read_axis(node, axes[0], first));
  TENON_CHECK(read_axis(node, axes[1], second));
  TENON_CHECK(add_joint(node, std::move(first)));
  axis_joints_[{number, 1}] = static_cast<Index>(model_.joints.size());
  return add_joint(node, std::move(second));
}

Result<void> JointReader::read_joint(Index number) {
  const SdfNode& node = tree_.nodes[number];
  SdfFile& file = *node.file;
  file.list_skipped(
      node.element,
      {"pose", "parent", "child", "axis", "axis2", "thread_pitch", "screw_thread_pitch", "sensor",
       "plugin", "drake:rotor_inertia", "drake:gear_ratio"},
      {"physics", "gearbox_ratio", "gearbox_reference_body"});
  list_parts(node);
  TENON_TRY(const std::string type, file.attribute(node.element, "type"));
  const TypeRow* row = nullptr;
  for (const TypeRow& one : kTypes) {
    row = type == one.type ? &one : row;
  }
  if (row == nullptr) {
    const bool gears = type == "gearbox";
    if (!gears) {
      return file.fault(node.element, "sdf.joint-type",
                        "the type \"" + type + "\" of joint \"" + node.name + "\" is not known",
                        "use revolute, continuous, prismatic, fixed, ball, universal or screw");
    }
    file.warn(node.element, "sdf.joint-type",
              "the gearbox \"" + node.name + "\" is unsupported; it is skipped",
              "let one of the two joints follow the other by <mimic>", Severity::Error);
    return {};
  }
  if (!node.link) {
    return file.fault(node.element, "sdf.joint-ends", "the world is no child of a joint",
                      "let the world be the parent");
  }
  const auto parent = tree_.nodes[node.parent].link;
  robot::Joint joint;
  joint.name = node.name;
  joint.place = file.place_of(node.element);
  joint.kind = row->kind;
  joint.child = draft_.links.at(*node.link);
  joint.parent = parent ? draft_.links.at(*parent) : world_link(draft_);
  joint.origin = pose_between(tree_, parent.value_or(0), *node.link);
  joint.frame = pose_between(tree_, *node.link, number);
  TENON_TRY(const std::vector<Axis> axes, read_axes(number, row->axes));
  axis_joints_[{number, 0}] = static_cast<Index>(model_.joints.size());
  if (type == "screw") {
    axes_[number] = {axes[0], {}};
    return read_screw(node, joint, axes[0]);
  }
  axes_[number] = axes;
  if (row->axes == 2) {
    return read_two_axes(number, joint, axes);
  }
  if (row->axes == 1) {
    TENON_CHECK(read_axis(node, axes[0], joint));
  }
  return add_joint(node, std::move(joint));
}

Result<void> JointReader::read_mimics() {
  for (const auto& [at, joint] : axis_joints_) {
    const auto& [number, axis] = at;
    const std::vector<Axis>& axes = axes_[number];
    const pugi::xml_node mimic = axes.empty()
                                     ? pugi::xml_node()
                                     : axes[static_cast<std::size_t>(axis)].element.child("mimic");
    if (!mimic) {
      continue;
    }
    const SdfNode& node = tree_.nodes[number];
    SdfFile& file = *node.file;
    file.list_skipped(mimic, {"multiplier", "offset", "reference"}, {});
    const std::string name = mimic.attribute("joint").value();
    const int of_leader = std::string_view(mimic.attribute("axis").value()) == "axis2" ? 1 : 0;
    const auto leader = tree_.find(node.model, name);
    const auto found = leader ? axis_joints_.find({*leader, of_leader}) : axis_joints_.end();
    if (found == axis_joints_.end()) {
      file.warn(
          mimic, "sdf.joint-missing",
          "no joint is named \"" + name + "\"; the mimic of joint \"" + node.name + "\" is skipped",
          "name one of the joints", Severity::Error);
      continue;
    }
    robot::Mimic values;
    values.leader = found->second;
    values.place = file.place_of(mimic);
    TENON_TRY(values.multiplier, file.number(mimic, "multiplier", 1));
    TENON_TRY(const double offset, file.number(mimic, "offset", 0));
    TENON_TRY(const double reference, file.number(mimic, "reference", 0));
    values.offset = offset - values.multiplier * reference;
    model_.joints[joint].mimic = values;
  }
  return {};
}

}  // namespace

Result<void> read_joints(SdfDraft& draft) {
  JointReader reader(draft);
  for (Index i = 1; i < draft.tree.nodes.size(); ++i) {
    const SdfNode& node = draft.tree.nodes[i];
    if (node.kind == NodeKind::Joint && !draft.tree.models[node.model].is_static) {
      TENON_CHECK(reader.read_joint(i));
    }
  }
  return reader.read_mimics();
}

}  // namespace tenon::sdf
