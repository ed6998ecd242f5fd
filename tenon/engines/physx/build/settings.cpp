// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// By default the solver is projected Gauss-Seidel with 16 iterations, of trees with 32, as the
// schemas have them: with 16 the drives of a hand with links of 10 g throw it. The other, TGS,
// applies drives of trees once more per iteration of velocities, so that it gets none of these
// unless the asset wants them; and a box that falls 5 m with 2 cm/s sideways then slides by 12 cm.
// Nothing falls asleep unless a threshold is authored.
#include "tenon/engines/physx/build/settings.h"

#include <algorithm>
#include <iterator>
#include <string>

namespace tenon::engines::physx {
namespace {

using scene::Index;

constexpr double kMostIterations = 255;   // PhysX keeps them in a byte
constexpr float kBounceThreshold = 0.2F;  // [m/s] slower impacts do not rebound
// PhysX's own for metres; it makes them of the length that is small to it (physx_library.cpp), and
// impacts then have no friction.
constexpr float kFrictionOffset = 0.04F;        // [m] where friction begins to act
constexpr float kFrictionCorrelation = 0.025F;  // [m] contacts as near as that share it
constexpr double kTurned = 1e-6;                // sine of half an angle

bool is_on(const Settings& settings, std::string_view name) {
  return number_of(settings, name).value_or(0) != 0;
}

bool turns(const scene::PoseTrack& track) {
  return std::any_of(track.poses.begin(), track.poses.end(), [&](const Pose& pose) {
    const Quatd turn = conjugate(track.poses.front().orientation) * pose.orientation;
    return length(Vec3d{turn.x, turn.y, turn.z}) > kTurned;
  });
}

/// A kinematic body of the scene that turns by itself: the solver PGS carries nothing round on it.
bool has_turntable(const Build& build, Index scene) {
  const auto is_in = [&](Index b) {
    return build.scene.bodies[b].kinematic && build.scene.bodies[b].scene == scene;
  };
  return std::any_of(
      build.scene.pose_tracks.begin(), build.scene.pose_tracks.end(),
      [&](const auto& track) { return track.body && is_in(*track.body) && turns(track); });
}

bool solves_by_tgs(const Build& build, Index scene) {
  if (build.options.methods.solver != ConstraintSolver::Default) {
    return false;
  }
  const std::string_view authored = word_of(build.scene.scenes[scene].parts.physx, "solverType");
  return authored == "TGS" || (authored.empty() && has_turntable(build, scene));
}

px::PxFrictionType::Enum friction_type(std::string_view word) {
  return word == "oneDirectional"   ? px::PxFrictionType::eONE_DIRECTIONAL
         : word == "twoDirectional" ? px::PxFrictionType::eTWO_DIRECTIONAL
                                    : px::PxFrictionType::ePATCH;
}

void report_solver(Build& build, const scene::Scene& source, const px::PxSceneDesc& wanted) {
  const Settings& settings = source.parts.physx;
  if (number_of(settings, "enableEnhancedDeterminism") == 0) {
    build.report(source.path, "physxScene:enableEnhancedDeterminism", "it is always on here");
  }
  if (wanted.solverType == px::PxSolverType::eTGS && number_of(settings, "maxBiasCoefficient")) {
    build.report(source.path, "physxScene:maxBiasCoefficient", "PhysX's solver TGS has none");
  }
  const bool tells = wanted.solverType == px::PxSolverType::ePGS &&
                     wanted.frictionType == px::PxFrictionType::ePATCH;
  if (!tells && needs_contacts(build.options.outputs)) {
    build.report(source.path, "physxScene:solverType, physxScene:frictionType",
                 "PhysX tells of friction with solver PGS and friction by patches alone; forces "
                 "of contacts and joints lack it");
  }
}

// [m/s] and the like, where PhysX takes what is above 0.
template <class Set>
void set_positive(const Settings& settings, std::string_view name, const Set& set) {
  if (const std::optional<double> number = number_of(settings, name); number && *number > 0) {
    set(to_px(*number));
  }
}

void report_link_settings(Build& build, Index body) {
  for (const scene::VendorSetting& setting : build.scene.bodies[body].parts.physx) {
    const bool of_tree = setting.name.starts_with("solver") || setting.name == "sleepThreshold" ||
                         setting.name == "stabilizationThreshold";
    if (of_tree) {
      build.report(build.scene.bodies[body].path, "physxRigidBody:" + setting.name,
                   "links have what PhysxArticulationAPI says of the whole articulation");
    }
  }
}

}  // namespace

std::optional<double> number_of(const Settings& settings, std::string_view name) {
  for (const scene::VendorSetting& setting : settings) {
    if (setting.name == name && !setting.numbers.empty()) {
      return setting.numbers.front();
    }
  }
  return std::nullopt;
}

std::string_view word_of(const Settings& settings, std::string_view name) {
  for (const scene::VendorSetting& setting : settings) {
    if (setting.name == name) {
      return setting.token;
    }
  }
  return "";
}

void set_solver(Build& build, Index scene, px::PxSceneDesc& wanted) {
  const scene::Scene& source = build.scene.scenes[scene];
  const Settings& settings = source.parts.physx;
  wanted.solverType = solves_by_tgs(build, scene) ? px::PxSolverType::eTGS : px::PxSolverType::ePGS;
  wanted.frictionType = friction_type(word_of(settings, "frictionType"));
  if (solves_by_tgs(build, scene) && word_of(settings, "solverType") != "TGS") {
    build.diagnostics.add({Severity::Info, "physx.solver",
                           "a kinematic body turns, and PhysX's solver PGS carries nothing round "
                           "on it: the solver TGS is used",
                           source.path.str(), "", ""});
  }
  wanted.bounceThresholdVelocity = kBounceThreshold;
  wanted.frictionOffsetThreshold = kFrictionOffset;
  wanted.frictionCorrelationDistance = kFrictionCorrelation;
  set_positive(settings, "bounceThreshold", [&](float x) { wanted.bounceThresholdVelocity = x; });
  set_positive(settings, "frictionOffsetThreshold",
               [&](float x) { wanted.frictionOffsetThreshold = x; });
  set_positive(settings, "frictionCorrelationDistance",
               [&](float x) { wanted.frictionCorrelationDistance = x; });
  set_positive(settings, "maxBiasCoefficient", [&](float x) { wanted.maxBiasCoefficient = x; });
  wanted.flags |= px::PxSceneFlag::eENABLE_ENHANCED_DETERMINISM;
  if (is_on(settings, "enableCCD")) {
    wanted.flags |= px::PxSceneFlag::eENABLE_CCD;
    build.model.pairs->sweeps = true;
  }
  if (is_on(settings, "enableStabilization")) {
    wanted.flags |= px::PxSceneFlag::eENABLE_STABILIZATION;
  }
  if (word_of(settings, "collisionSystem") == "SAT") {
    wanted.flags &= ~px::PxSceneFlags(px::PxSceneFlag::eENABLE_PCM);
  }
  report_solver(build, source, wanted);
}

std::vector<scene::VendorSetting> run_settings(const Model& model) {
  const px::PxScene& scene = *model.scenes.front();
  px::PxU32 positions = 0;
  px::PxU32 velocities = 0;
  const auto count = [&](const auto& of) {
    px::PxU32 own_positions = 0;
    px::PxU32 own_velocities = 0;
    of.getSolverIterationCounts(own_positions, own_velocities);
    positions = std::max(positions, own_positions);
    velocities = std::max(velocities, own_velocities);
  };
  for (Index b = 0; b < model.bodies.size(); ++b) {
    if (!model.is_link(b)) {
      count(static_cast<const px::PxRigidDynamic&>(*model.bodies[b]));
    }
  }
  for (const ReducedTree& tree : model.trees) {
    count(*tree.articulation);
  }
  const auto number = [](const char* name, double value) {
    return scene::VendorSetting{name, {value}, ""};
  };
  const px::PxSceneFlags flags = scene.getFlags();
  constexpr const char* kFriction[] = {"patch", "oneDirectional", "twoDirectional"};
  const auto friction = static_cast<std::size_t>(scene.getFrictionType());
  return {{"integrator", {}, "euler"},
          {"solver", {}, scene.getSolverType() == px::PxSolverType::eTGS ? "tgs" : "pgs"},
          number("positionIterations", positions),
          number("velocityIterations", velocities),
          {"friction", {}, friction < std::size(kFriction) ? kFriction[friction] : "none"},
          number("bounceThreshold", scene.getBounceThresholdVelocity()),
          number("frictionOffsetThreshold", scene.getFrictionOffsetThreshold()),
          number("ccd", flags & px::PxSceneFlag::eENABLE_CCD ? 1 : 0),
          number("stabilization", flags & px::PxSceneFlag::eENABLE_STABILIZATION ? 1 : 0)};
}

Iterations iterations_of(const Build& build, Index scene, const Settings& settings, double usual) {
  const Settings& bounds = build.scene.scenes[scene].parts.physx;
  const auto within = [&](double count, const char* least, const char* most) {
    const double low = number_of(bounds, least).value_or(0);
    const double high = number_of(bounds, most).value_or(kMostIterations);
    return std::clamp(std::min(std::max(count, low), high), 0.0, kMostIterations);
  };
  const double asked = build.options.methods.iterations;
  double positions = number_of(settings, "solverPositionIterationCount").value_or(usual);
  positions = within(positions, "minPositionIterationCount", "maxPositionIterationCount");
  const double usual_velocities = solves_by_tgs(build, scene) ? 0 : 1;
  const double velocities =
      within(number_of(settings, "solverVelocityIterationCount").value_or(usual_velocities),
             "minVelocityIterationCount", "maxVelocityIterationCount");
  positions = asked > 0 ? std::min(asked, kMostIterations) : std::max(positions, 1.0);
  return {static_cast<px::PxU32>(positions), static_cast<px::PxU32>(velocities)};
}

float sleep_threshold_of(const Build& build, Index scene, const Settings& settings) {
  const bool never = is_on(build.scene.scenes[scene].parts.physx, "disableSleeping");
  const double threshold = number_of(settings, "sleepThreshold").value_or(0);
  return never || threshold < 0 ? 0 : to_px(threshold);
}

void set_body_settings(Build& build, Index body, px::PxRigidBody& made) {
  const scene::Body& source = build.scene.bodies[body];
  const Settings& settings = source.parts.physx;
  set_positive(settings, "maxDepenetrationVelocity",
               [&](float x) { made.setMaxDepenetrationVelocity(x); });
  set_positive(settings, "maxContactImpulse", [&](float x) { made.setMaxContactImpulse(x); });
  set_positive(settings, "contactSlopCoefficient",
               [&](float x) { made.setContactSlopCoefficient(x); });
  made.setRigidBodyFlag(px::PxRigidBodyFlag::eENABLE_CCD,
                        is_on(settings, "enableCCD") && !source.kinematic);
  made.setRigidBodyFlag(px::PxRigidBodyFlag::eENABLE_SPECULATIVE_CCD,
                        is_on(settings, "enableSpeculativeCCD"));
  if (made.getType() == px::PxActorType::eARTICULATION_LINK) {
    // PhysX's own 0.025 softens rows of joints, and drives by acceleration with them.
    const double softness = number_of(settings, "cfmScale").value_or(0);
    static_cast<px::PxArticulationLink&>(made).setCfmScale(to_px(std::clamp(softness, 0.0, 1.0)));
    report_link_settings(build, body);
    return;
  }
  if (number_of(settings, "cfmScale").has_value()) {
    build.report(source.path, "physxRigidBody:cfmScale",
                 "PhysX 5.1 has it for links of articulations only");
  }
  auto& alone = static_cast<px::PxRigidDynamic&>(made);
  const Iterations iterations = iterations_of(build, source.scene, settings, kBodyIterations);
  alone.setSolverIterationCounts(iterations.positions, iterations.velocities);
  alone.setSleepThreshold(sleep_threshold_of(build, source.scene, settings));
  set_positive(settings, "stabilizationThreshold",
               [&](float x) { alone.setStabilizationThreshold(x); });
}

const scene::Articulation* articulation_of(const Build& build, Index body) {
  for (const scene::Articulation& articulation : build.scene.articulations) {
    if (std::find(articulation.links.begin(), articulation.links.end(), body) !=
        articulation.links.end()) {
      return &articulation;
    }
  }
  return nullptr;
}

}  // namespace tenon::engines::physx
