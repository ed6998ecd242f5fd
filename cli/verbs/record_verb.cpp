// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The ending of the output says whether it is a picture or a film; options of the other kind are
// refused instead of ignored. All else is in cli/recording.h, which `view --screenshot` shares.
#include <memory>
#include <string>

#include "cli/recording.h"
#include "cli/report.h"
#include "cli/simulate.h"
#include "cli/verb.h"
#include "tenon/base/text/comma_list.h"

namespace tenon::cli {
namespace {

constexpr double kFilmFrames = 30;  // per second, as players of films have them
constexpr double kMegabit = 1e6;

struct RecordArguments {
  SimulateArguments simulate;
  PictureArguments picture;
  RecordOptions options;
  std::string output;
  double megabits = 0;

  void add_camera_to(const Command& verb);
  void add_looks_to(const Command& verb);
  void add_film_to(const Command& verb);
};

void RecordArguments::add_camera_to(const Command& verb) {
  RecordCamera& camera = options.camera;
  verb.add_option("--camera", camera.prim,
                  "Look through this prim of type Camera, which moves with the body above it; "
                  "without it by the angles below")
      .value_name("PRIM");
  verb.add_option("--azimuth", camera.azimuth, {-1e6, 1e6, false, false, "degrees"},
                  "Angle of the camera about the up axis, counterclockwise from +X")
      .value_name("DEGREES");
  verb.add_option("--elevation", camera.elevation, {-89, 89, false, false, "degrees"},
                  "Angle of the camera above the ground")
      .value_name("DEGREES");
  verb.add_option("--zoom", camera.zoom, {0.01, 1000, false, false, ""},
                  "1 shows all of what is looked at, 2 is twice as close")
      .value_name("FACTOR");
  verb.add_option("--look-at", camera.target,
                  "Look at this prim: a body, or one with a shape; without it at everything")
      .value_name("PRIM");
}

void RecordArguments::add_looks_to(const Command& verb) {
  verb.add_option("--background", options.background,
                  "light, dark, a colour such as #ffffff, or transparent (of .png)")
      .value_name("COLOUR");
  const std::string layers = comma_list(record_layers());
  verb.add_option("--show", options.show, "Show these, too: " + layers)
      .split_at_commas()
      .repeatable()
      .value_name("NAMES");
  verb.add_option("--hide", options.hide, "Do not show these, which are shown else: visuals, grid")
      .split_at_commas()
      .repeatable()
      .value_name("NAMES");
  verb.add_option("--select", options.select, "Mark this prim, as a click on it does")
      .value_name("PRIM");
  verb.add_option("--simplify", options.triangles, {1, 1e9, false, true, ""},
                  "Draw about so many triangles at most")
      .value_name("TRIANGLES");
}

void RecordArguments::add_film_to(const Command& verb) {
  verb.add_option("--time", options.time, {0, 1e6, false, false, "s"},
                  "Moment that a .png shows; it is simulated up to there")
      .value_name("SECONDS");
  verb.add_flag("--panels", options.panels,
                "The page of tenon report, with its panels around the picture (.png)");
  verb.add_option("--speed", options.speed, {1e-4, 1e4, false, false, ""},
                  "Seconds of motion for each second of a film; 0.25 is slow motion")
      .value_name("FACTOR");
  verb.add_option("--turn", options.camera.turn, {-1e6, 1e6, false, false, "degrees"},
                  "Angle that the camera turns from begin to end of a film")
      .value_name("DEGREES");
  verb.add_option(
          "--codec", options.codec,
          "Codec of a film; without it vp9 in .webm and h264 in .mp4, which not every Chromium "
          "can make")
      .one_of({"h264", "vp9", "vp8", "av1"})
      .value_name("NAME");
  verb.add_option(
          "--bitrate", megabits, {0.01, 1000, false, false, "Mbit/s"},
          "Bit rate of a film; without it by size and frames: 4.1 for 1280x720 at 30 per second")
      .value_name("MBITS");
}

/// Options of the other kind of output are a mistake.
Result<void> check_kind(const Command& verb, const RecordArguments& arguments) {
  if (recording_format(arguments.output) != RecordFormat::Png) {
    return refuse_given(verb, {"--time", "--panels"}, "pictures",
                        "name an output file that ends in .png");
  }
  TENON_CHECK(refuse_given(
      verb, {"--duration", "--fps", "--speed", "--turn", "--codec", "--bitrate"}, "films",
      "name an output file that ends in .webm or .mp4, or choose the moment of "
      "the picture with --time"));
  if (verb.option("--time").given() || arguments.options.panels) {
    return {};
  }
  return refuse_given(
      verb, {"--engine", "--dt", "--integrator", "--solver", "--iterations", "--commands"},
      "films and of pictures of a later moment",
      "name a moment of the motion, since the start takes no steps, or leave it out");
}

Result<RecordOptions> options_of(const RecordArguments& arguments, Report& report) {
  RecordOptions options = arguments.options;
  TENON_TRY(options.run, simulation_options(arguments.simulate, report));
  TENON_CHECK(arguments.picture.put_into(options));
  options.format = recording_format(arguments.output);
  options.frames_per_second = arguments.simulate.frames_per_second;
  options.bitrate = arguments.megabits * kMegabit;
  return options;
}

int run_record(const Globals& globals, const Command& verb, const RecordArguments& arguments) {
  Report report(globals, "record", arguments.simulate.asset.asset);
  Outputs outputs;
  if (auto claimed = outputs.claim(OutputKind::Recording, arguments.output); !claimed) {
    return report.fail(claimed.error());
  }
  if (auto fits = check_kind(verb, arguments); !fits) {
    return report.fail(fits.error());
  }
  auto options = options_of(arguments, report);
  if (!options) {
    return report.fail(options.error());
  }
  return make_recording(report, arguments.simulate, *std::move(options), arguments.output, outputs);
}

constexpr const char* kRecordFooter =
    "A local Chromium draws, without a window and without a network, frame by frame: the same "
    "picture on every machine, however long it takes. tenon doctor says whether there is one.\n\n"
    "Examples:\n"
    "  tenon record hand.usda -o hand.png --size 1600x900\n"
    "  tenon record hand.usda -o hand.png --show joints,colliders --background transparent\n"
    "  tenon record grasp.usda -o grasp.png --time 1.5 --azimuth 30 --look-at /World/can\n"
    "  tenon record grasp.usda -o grasp.webm --duration 4 --turn 90\n"
    "  tenon record grasp.usda -o grasp.mp4 --camera /World/Camera --speed 0.5";

}  // namespace

void add_record(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb =
      parent.add_subcommand("record", "A picture or a film of an asset: .png, .webm, .mp4");
  auto options = std::make_shared<RecordArguments>();
  options->simulate.frames_per_second = kFilmFrames;
  options->simulate.add_to(verb);
  options->simulate.add_commands_to(verb);
  verb.option("asset").file_only().description("A .usd, .usda, .usdc or .usdz file");
  verb.option("--fps").description("Frames per second of a film");
  verb.add_option("-o,--output", options->output, "The file to write: .png, .webm or .mp4")
      .required();
  options->picture.add_to(verb);
  options->add_camera_to(verb);
  options->add_looks_to(verb);
  options->add_film_to(verb);
  verb.footer(kRecordFooter);
  choose(verb, chosen, [&globals, verb, options] { return run_record(globals, verb, *options); });
}

}  // namespace tenon::cli
