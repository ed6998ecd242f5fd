// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The choices between readings of UsdPhysics, by the words that users give. The words of a row
// are in the order of the enumerators, so the index of a word is its value, and the default comes
// first.
#include "tenon/physics/readings.h"

#include <algorithm>
#include <array>
#include <utility>

#include "tenon/base/text/comma_list.h"

namespace tenon::physics {
namespace {

template <auto member>
void assign(Readings& readings, std::size_t value) {
  using Choice = std::remove_reference_t<decltype(readings.*member)>;
  readings.*member = static_cast<Choice>(value);
}

Error unknown(std::string what, const std::vector<std::string>& known) {
  return Error(ErrorCode::Invalid, std::move(what) + "; there are " + comma_list(known));
}

/// Sorted by name; an absent third value is null.
struct Row {
  const char* name;
  std::array<const char*, 3> values;
  const char* about;
  void (*set)(Readings& readings, std::size_t value);
};
const Row kRows[] = {
    {"angular-acceleration",
     {"per-degree", "literal"},
     "gains of angular acceleration drives: PhysX takes them per degree (S-104)",
     assign<&Readings::angular_acceleration>},
    {"body-defaults",
     {"none", "physx"},
     "bodies that say nothing: PhysX damps their turning by 0.05/s and cuts it at 100 rad/s (S-28)",
     assign<&Readings::body_defaults>},
    {"center-shift",
     {"parallel-axis", "keep"},
     "an authored centre of mass alone: OpenUSD and PhysX add the parallel-axis term, Newton "
     "keeps the inertia (M-15)",
     assign<&Readings::center_shift>},
    {"collision-on-group",
     {"ignore", "shapes-below"},
     "PhysicsCollisionAPI on an Xform: PhysX means the shapes below (S-47)",
     assign<&Readings::collision_on_group>},
    {"fixed-to-world",
     {"stay", "together"},
     "a fixed joint to the world whose frames are apart: PhysX and Newton leave the root of an "
     "articulation where it stands; the frames say that it is moved (S-90)",
     assign<&Readings::fixed_to_world>},
    {"held-samples",
     {"linear", "held"},
     "poses between time samples: the interpolation of the stage (S-117)",
     assign<&Readings::held_samples>},
    {"layer-units",
     {"stage", "layer"},
     "layers with units of their own: OpenUSD has one set per stage, the proposal converts each "
     "opinion by the metadata of its layer (S-11)",
     assign<&Readings::layer_units>},
    {"mass-inheritance",
     {"subtree", "own"},
     "a mass API between body and collider: OpenUSD ignores it (S-40)",
     assign<&Readings::mass_inheritance>},
    {"missing-target",
     {"drop", "world"},
     "a joint to a prim that does not exist: OpenUSD attaches it to the world (S-87)",
     assign<&Readings::missing_target>},
    {"negative-gravity",
     {"earth", "literal"},
     "a finite negative magnitude: OpenUSD and PhysX take it as it is (S-15)",
     assign<&Readings::negative_gravity>},
    {"nesting",
     {"independent", "ignore", "error"},
     "a body below a body: the proposal ignores the inner one, older PhysX rejects it unless it "
     "resets the transform stack (S-24)",
     assign<&Readings::nesting>},
    {"one-sided-limits",
     {"keep", "drop"},
     "revolute limits and cone angles with one side: OpenUSD drops them (S-96, S-98)",
     assign<&Readings::one_sided_limits>},
    {"point-instancers",
     {"expand", "skip"},
     "prototypes with physics: OpenUSD's parser skips point instancers (S-38)",
     assign<&Readings::point_instancers>},
    {"sheared-offsets",
     {"exact", "factored"},
     "offsets below a sheared body: OpenUSD scales them along the body's axes (S-33, S-84)",
     assign<&Readings::sheared_offsets>},
    {"stretched-sphere",
     {"ellipsoid", "ball"},
     "a sphere under non-uniform scale: OpenUSD and PhysX take the largest radius (S-53)",
     assign<&Readings::stretched_sphere>},
    {"time",
     {"seconds", "stage"},
     "units of time: the proposal says stage time codes (S-10)",
     assign<&Readings::time>},
    {"unbound-friction",
     {"half", "one", "zero"},
     "friction without a material: PhysX 0.5, Newton and MuJoCo 1 (S-71)",
     assign<&Readings::unbound_friction>},
    {"ungrouped",
     {"off", "on"},
     "colliders in no group against an inverted group: OpenUSD's table leaves them on (S-78)",
     assign<&Readings::ungrouped>},
    {"value-types",
     {"strict", "lenient"},
     "numbers of another type than the schema's: OpenUSD takes the fallback (S-3)",
     assign<&Readings::value_types>},
    {"velocity-space",
     {"parent", "body", "world"},
     "axes of authored velocities: Newton takes the body's, PhysX the world's (S-30)",
     assign<&Readings::velocity_space>},
};

}  // namespace

const std::vector<ReadingChoice>& reading_choices() {
  static const std::vector<ReadingChoice> choices = [] {
    std::vector<ReadingChoice> list;
    for (const Row& row : kRows) {
      ReadingChoice choice{row.name, {}, row.about, row.set};
      for (const char* value : row.values) {
        if (value != nullptr) {
          choice.values.emplace_back(value);
        }
      }
      list.push_back(std::move(choice));
    }
    return list;
  }();
  return choices;
}

Result<void> set_reading(Readings& readings, std::string_view name, std::string_view value) {
  std::vector<std::string> names;
  for (const ReadingChoice& choice : reading_choices()) {
    if (choice.name == name) {
      const auto at = std::find(choice.values.begin(), choice.values.end(), value);
      if (at == choice.values.end()) {
        return unknown("\"" + std::string(value) + "\" is not a reading of " + choice.name,
                       choice.values);
      }
      choice.set(readings, static_cast<std::size_t>(at - choice.values.begin()));
      return {};
    }
    names.push_back(choice.name);
  }
  return unknown("there is no reading named \"" + std::string(name) + "\"", names);
}

}  // namespace tenon::physics
