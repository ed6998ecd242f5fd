// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Tendons of the asset. Their sites and wrapping geoms are made for them, named after their prim
// and shared by all that use them: a site, or a sphere or cylinder without contacts. A tendon with
// a joint that is not a single coordinate here is skipped as a whole: without one of its terms its
// length would mean something else.
#include <algorithm>
#include <iterator>
#include <string_view>

#include "tenon/engines/mujoco/build/build.h"

namespace tenon::engines::mujoco {
namespace {

using scene::Tendon;
using scene::TendonWrap;

class TendonPass {
 public:
  explicit TendonPass(Build& build) : build_(build) {}

  void add(const Tendon& tendon) {
    if (!joints_are_there(tendon)) {
      return;
    }
    mjsTendon* result = mjs_addTendon(build_.spec.get(), nullptr);
    mjs_setName(result->element, tendon.path.str().c_str());
    for (std::size_t i = 0; i < tendon.joints.size(); ++i) {
      mjs_wrapJoint(result, name_of(joint(tendon.joints[i])->element).c_str(),
                    tendon.coefficients[i]);
    }
    for (const TendonWrap& wrap : tendon.wraps) {
      add_wrap(result, wrap);
    }
    result->stiffness[0] = tendon.stiffness;
    result->damping[0] = tendon.damping;
    result->frictionloss = tendon.friction;
    result->armature = tendon.armature;
    std::copy(tendon.spring_length.begin(), tendon.spring_length.end(), result->springlength);
    result->limited = tendon.range ? mjLIMITED_TRUE : mjLIMITED_FALSE;
    if (tendon.range) {
      std::copy(tendon.range->begin(), tendon.range->end(), result->range);
    }
    if (tendon.range && tendon.limit_stiffness > 0) {
      build_.soft_bounds.push_back({nullptr, result, tendon.limit_stiffness, 0});
    }
    for (const scene::VendorSetting& setting : tendon.settings) {
      if (!apply(setting, *result)) {
        build_.report(tendon.path, "mjc:" + setting.name, "MuJoCo has no such setting or value");
      }
    }
    if (result->actfrclimited == mjLIMITED_AUTO) {
      const bool limited = result->actfrcrange[0] < result->actfrcrange[1];
      result->actfrclimited = limited ? mjLIMITED_TRUE : mjLIMITED_FALSE;
    }
  }

 private:
  static std::string name_of(mjsElement* element) { return mjs_getString(mjs_getName(element)); }

  mjsJoint* joint(scene::Index index) const {
    return scalar_joint(build_, index, build_.scene.joints[index].dof());
  }

  bool joints_are_there(const Tendon& tendon) {
    for (const scene::Index index : tendon.joints) {
      if (joint(index) == nullptr) {
        build_.report(tendon.path, "mjc:path",
                      "<" + build_.scene.joints[index].path.str() +
                          "> is not a single coordinate here; the tendon is skipped");
        return false;
      }
    }
    return true;
  }

  std::string round(const TendonWrap& wrap) {
    const std::string name = wrap.attachment.path.str() + ".wrap";
    if (rounds_.insert(name).second) {
      mjsGeom* made = mjs_addGeom(side_body(build_, wrap.attachment.body), nullptr);
      mjs_setName(made->element, name.c_str());
      made->type = wrap.kind == TendonWrap::Kind::Sphere ? mjGEOM_SPHERE : mjGEOM_CYLINDER;
      made->size[0] = wrap.radius;
      made->size[1] = wrap.radius;  // the length of a cylinder does not matter
      made->contype = 0;
      made->conaffinity = 0;
      made->group = 4;  // seen when asked for
      const Pose pose = side_frame(build_, wrap.attachment.body, wrap.attachment.pose);
      write_vector(made->pos, pose.position);
      write_quaternion(made->quat, normalized(pose.orientation));
    }
    return name;
  }

  void add_wrap(mjsTendon* tendon, const TendonWrap& wrap) {
    switch (wrap.kind) {
      case TendonWrap::Kind::Site:
        mjs_wrapSite(tendon, site_at(build_, wrap.attachment).c_str());
        break;
      case TendonWrap::Kind::Sphere:
      case TendonWrap::Kind::Cylinder: {
        const std::string side = wrap.side ? site_at(build_, *wrap.side) : "";
        mjs_wrapGeom(tendon, round(wrap).c_str(), side.c_str());
        break;
      }
      case TendonWrap::Kind::Pulley:
        mjs_wrapPulley(tendon, wrap.divisor);
        break;
    }
  }

  template <class T>
  static bool copy(const std::vector<double>& numbers, T* target, std::size_t count) {
    if (numbers.size() != count) {
      return false;
    }
    std::transform(numbers.begin(), numbers.end(), target,
                   [](double number) { return static_cast<T>(number); });
    return true;
  }

  static bool apply(const scene::VendorSetting& setting, mjsTendon& tendon) {
    const std::string_view name = setting.name;
    const std::vector<double>& numbers = setting.numbers;
    if (name == "actuatorfrclimited") {
      tendon.actfrclimited = setting.token == "true"    ? mjLIMITED_TRUE
                             : setting.token == "false" ? mjLIMITED_FALSE
                                                        : mjLIMITED_AUTO;
      return true;
    }
    if (name == "group") {
      return copy(numbers, &tendon.group, 1);
    }
    if (name == "rgba") {
      return copy(numbers, tendon.rgba, 4);
    }
    struct Row {
      std::string_view name;
      mjtNum* target;
      std::size_t count;
    };
    const Row rows[] = {{"actuatorfrcrange:max", tendon.actfrcrange + 1, 1},
                        {"actuatorfrcrange:min", tendon.actfrcrange, 1},
                        {"margin", &tendon.margin, 1},
                        {"solimpfriction", tendon.solimp_friction, mjNIMP},
                        {"solimplimit", tendon.solimp_limit, mjNIMP},
                        {"solreffriction", tendon.solref_friction, mjNREF},
                        {"solreflimit", tendon.solref_limit, mjNREF},
                        {"width", &tendon.width, 1}};
    const auto* row = std::find_if(std::begin(rows), std::end(rows),
                                   [&](const Row& r) { return r.name == name; });
    return row != std::end(rows) && copy(numbers, row->target, row->count);
  }

  Build& build_;
  std::set<std::string> rounds_;
};

}  // namespace

std::string site_at(Build& build, const TendonWrap::Attachment& place) {
  const std::string name = place.path.str();
  if (build.sites.insert(name).second) {
    mjsSite* made = mjs_addSite(side_body(build, place.body), nullptr);
    mjs_setName(made->element, name.c_str());
    const Pose pose = side_frame(build, place.body, place.pose);
    write_vector(made->pos, pose.position);
    write_quaternion(made->quat, normalized(pose.orientation));
  }
  return name;
}

void add_tendons(Build& build) {
  TendonPass pass(build);
  for (const Tendon& tendon : build.scene.tendons) {
    pass.add(tendon);
  }
}

}  // namespace tenon::engines::mujoco
