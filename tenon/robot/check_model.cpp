// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A model from another process may hold anything, so each index and each length that later code
// follows is checked once, before it is used. The first fault is enough: it shows that the reader
// is at fault and not the description, so there is nothing to fix in the file.
#include "tenon/robot/check_model.h"

#include <algorithm>
#include <string>

namespace tenon::robot {
namespace {

constexpr std::size_t kSolref = 2;
constexpr std::size_t kSolimp = 5;
constexpr std::size_t kActuatorNumbers = 10;

/// The first fault that is found.
class Checks {
 public:
  explicit Checks(const RobotModel& model) : model_(model) {}

  std::string run() {
    for (const Link& link : model_.links) {
      check_link(link);
    }
    for (const Joint& joint : model_.joints) {
      check_joint(joint);
    }
    for (const MeshFile& mesh : model_.meshes) {
      check_mesh(mesh);
    }
    check_contacts();
    for (const LoopJoint& loop : model_.loops) {
      check_loop(loop);
    }
    check_mujoco(model_.mujoco);
    return std::move(fault_);
  }

 private:
  void expect(bool holds, const char* fault) {
    if (!holds && fault_.empty()) {
      fault_ = fault;
    }
  }
  template <class List>
  void expect_in(std::size_t index, const List& list, const char* fault) {
    expect(index < list.size(), fault);
  }
  void expect_numbers(const std::vector<double>& list, std::size_t count) {
    expect(list.empty() || list.size() == count, "a list of numbers has another length");
  }

  void check_geometry(const Geometry& geometry) {
    if (geometry.kind == GeometryKind::Mesh) {
      expect_in(geometry.mesh, model_.meshes, "a shape names a mesh that is not there");
    }
  }
  void check_material(const std::optional<Index>& material) {
    if (material) {
      expect_in(*material, model_.materials, "a shape names a material that is not there");
    }
  }

  void check_link(const Link& link) {
    for (const Visual& visual : link.visuals) {
      check_geometry(visual.geometry);
      check_material(visual.material);
    }
    for (const Collider& collider : link.colliders) {
      check_geometry(collider.geometry);
      check_material(collider.material);
      if (collider.contact_class) {
        expect_in(*collider.contact_class, model_.contact_classes,
                  "a collider names a contact class that is not there");
      }
      expect_numbers(collider.mujoco.solref, kSolref);
      expect_numbers(collider.mujoco.solimp, kSolimp);
    }
    for (const Camera& camera : link.cameras) {
      check_tracking(camera.tracking);
    }
    for (const Light& light : link.lights) {
      check_tracking(light.tracking);
    }
  }

  void check_tracking(const MujocoTracking& tracking) {
    if (tracking.target) {
      expect_in(*tracking.target, model_.links, "a camera or light follows a link not there");
    }
  }

  void check_joint(const Joint& joint) {
    expect_in(joint.parent, model_.links, "a joint names a link that is not there");
    expect_in(joint.child, model_.links, "a joint names a link that is not there");
    if (joint.mimic) {
      expect_in(joint.mimic->leader, model_.joints, "a joint follows one that is not there");
    }
    expect_numbers(joint.mujoco.solref_limit, kSolref);
    expect_numbers(joint.mujoco.solimp_limit, kSolimp);
    expect_numbers(joint.mujoco.solref_friction, kSolref);
    expect_numbers(joint.mujoco.solimp_friction, kSolimp);
  }

  void check_mesh(const MeshFile& mesh) {
    const auto points = static_cast<std::int64_t>(mesh.points.size());
    for (const Vec3i& triangle : mesh.triangles) {
      for (const std::int32_t at : triangle.v) {
        expect(at >= 0 && at < points, "a triangle names a point that is not there");
      }
    }
    expect(mesh.texture_coordinates.empty() ||
               mesh.texture_coordinates.size() == 3 * mesh.triangles.size(),
           "a mesh has not one texture coordinate for each corner");
  }

  void check_contacts() {
    for (const std::array<Index, 2>& pair : model_.excluded_pairs) {
      for (const Index link : pair) {
        expect_in(link, model_.links, "a pair names a link that is not there");
      }
    }
    for (const ContactClass& of : model_.contact_classes) {
      for (const Index other : of.untouched) {
        expect_in(other, model_.contact_classes, "a contact class names one that is not there");
      }
    }
  }

  void check_loop(const LoopJoint& loop) {
    for (const Index link : loop.links) {
      expect_in(link, model_.links, "a loop names a link that is not there");
    }
    expect_numbers(loop.solref, kSolref);
    expect_numbers(loop.solimp, kSolimp);
  }

  void check_mujoco(const MujocoParts& parts) {
    for (const MujocoActuator& actuator : parts.actuators) {
      expect(
          actuator.target < (actuator.kind == MujocoActuator::Target::Joint ? model_.joints.size()
                                                                            : parts.tendons.size()),
          "an actuator names a joint or a tendon that is not there");
      expect_numbers(actuator.gain, kActuatorNumbers);
      expect_numbers(actuator.bias, kActuatorNumbers);
      expect_numbers(actuator.dynamics, kActuatorNumbers);
    }
    for (const MujocoTendon& tendon : parts.tendons) {
      expect(tendon.coefficients.size() == tendon.joints.size(),
             "a tendon has not one coefficient for each joint");
      for (const Index joint : tendon.joints) {
        expect_in(joint, model_.joints, "a tendon names a joint that is not there");
      }
    }
  }

  const RobotModel& model_;
  std::string fault_;
};

}  // namespace

Result<void> check_model(const RobotModel& model) {
  if (std::string fault = Checks(model).run(); !fault.empty()) {
    return Error(ErrorCode::Corrupt, "the data read from the file contradict themselves: " + fault)
        .in_file(model.file)
        .with_rule("robot.corrupt")
        .with_fix("report this with the file");
  }
  return {};
}

}  // namespace tenon::robot
