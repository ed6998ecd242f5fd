// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The asset is opened before the address is printed, so that what is printed can be opened. With
// --json the object with the address is all of standard output; what happens later goes to the page
// and to standard error. The server runs until it is told to stop, which is its usual end.
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/output.h"
#include "cli/reading_options.h"
#include "cli/recording.h"
#include "cli/report.h"
#include "cli/settings.h"
#include "cli/verb.h"
#include "tenon/base/error.h"
#include "tenon/engines/engines.h"
#if TENON_WITH_VIEW
#include "cli/python/ask_identify.h"
#include "tenon/asset/viewing/page_place.h"
#include "tenon/asset/viewing/view_asset.h"
#include "tenon/glb/simplify_view.h"
#include "tenon/glb/write_glb.h"
#include "tenon/live/serve_session.h"
#endif

namespace tenon::cli {
namespace {

struct ViewArguments {
  AssetArguments asset;
  std::vector<std::string> readings;
  std::vector<std::string> pose;
  dynamics::Masks masks;
  std::string engine;
  double time_step = 0;
  std::string bind = "127.0.0.1";
  std::size_t port = 0;
  std::size_t triangles = 100'000;
  std::optional<double> seconds;
  std::vector<std::string> logs;
  std::string commands;
  bool watch = false;
  bool read_only = false;
  std::string screenshot;
  PictureArguments picture;
};

/// Options of the other kind are a mistake: a picture is served by nobody.
Result<void> check_view_kind(const Command& verb, const ViewArguments& arguments) {
  if (arguments.screenshot.empty()) {
    return refuse_given(verb, {"--size", "--browser", "--no-sandbox", "--patience"}, "--screenshot",
                        "add --screenshot FILE.png");
  }
  return refuse_given(verb,
                      {"--bind", "--port", "--engine", "--dt", "--watch", "--read-only", "--for",
                       "--log", "--commands"},
                      "views that are served", "leave it out, or leave --screenshot out");
}

/// --screenshot: a picture instead of a server, as `tenon record` makes it.
int run_screenshot(const Globals& globals, const ViewArguments& arguments) {
  Report report(globals, "view", arguments.asset.asset);
  Outputs outputs;
  RecordOptions options;
  auto well = outputs.claim(OutputKind::Picture, arguments.screenshot);
  well = well ? arguments.picture.put_into(options) : well;
  auto readings = chosen_readings(arguments.readings);
  if (!well || !readings) {
    return report.fail(well ? readings.error() : well.error());
  }
  options.run.open = arguments.asset.open_options();
  options.run.readings = *std::move(readings);
  options.run.pose = arguments.pose;
  options.run.masks = arguments.masks;
  options.triangles = arguments.triangles;
  SimulateArguments still;
  still.asset = arguments.asset;
  return make_recording(report, still, std::move(options), arguments.screenshot, outputs);
}

#if TENON_WITH_VIEW

struct PageRow {
  const char* name;
  const char* file;
  const char* type;
};

constexpr std::array kPageRows{
    PageRow{"", "index.html", "text/html; charset=utf-8"},
    PageRow{"live.js", "live.js", "text/javascript; charset=utf-8"},
    PageRow{"page.css", "page.css", "text/css; charset=utf-8"},
    PageRow{"three-LICENSE.txt", "three-LICENSE.txt", "text/plain; charset=utf-8"},
};

Result<void> publish_page(serve::Server& server) {
  for (const PageRow& row : kPageRows) {
    TENON_TRY(const auto file, page_file(row.file));
    server.publish(row.name, {row.type, std::make_shared<const std::string>(file->text())});
  }
  return {};
}

/// The visuals, simplified to at most the requested number of triangles.
Result<std::string> picture_of(const ViewArguments& arguments, const stage::Stage& stage,
                               const scene::PhysicsScene& scene) {
  view::ViewScene view =
      view_of_asset(stage, scene, arguments.asset.asset, arguments.asset.open_options(), true);
  if (arguments.triangles > 0) {
    glb::simplify_view(view, arguments.triangles);
  }
  return glb::write_glb(view, {.colliders = true});
}

Result<live::SessionOptions> session_options(const ViewArguments& arguments, Report& report) {
  live::SessionOptions options;
  TENON_TRY(options.asset.engine, engine_for(arguments.engine, arguments.asset.asset, report));
  TENON_TRY(options.asset.readings, chosen_readings(arguments.readings));
  options.asset.pose = arguments.pose;
  options.asset.masks = arguments.masks;
  options.asset.path = arguments.asset.asset;
  options.asset.open = arguments.asset.open_options();
  options.asset.time_step = arguments.time_step;
  options.asset.picture = [&arguments](const stage::Stage& stage,
                                       const scene::PhysicsScene& scene) {
    return picture_of(arguments, stage, scene);
  };
  options.version = TENON_VERSION;
  options.watch = arguments.watch;
  options.identify.logs = arguments.logs;
  options.identify.commands = arguments.commands;
  options.identify.run = [commands = arguments.commands](const live::IdentifyWish& wish,
                                                         live::Work& work) {
    return ask_identify(wish, commands, work);
  };
  if (!arguments.read_only) {
    options.write = [asset = arguments.asset.asset](const std::vector<EditedFile>& files) {
      return write_edits(files, {"view", asset});
    };
  }
  return options;
}

/// The address, and how to come to it from elsewhere.
void tell_address(const Report& report, const serve::Server& server) {
  if (!report.json()) {
    for (const std::string& url : server.urls()) {
      print("%s\n", url.c_str());
    }
  }
  const std::string port = std::to_string(server.port());
  if (server.is_local()) {
    report.note("serving on localhost only; from another machine: ssh -L " + port +
                ":127.0.0.1:" + port + " THIS_MACHINE, then open the same address there");
  } else {
    report.note(
        "others can reach this address, and who knows all of it can change the asset: it "
        "is not encrypted; 127.0.0.1 and ssh -L are safer");
  }
  report.note("Ctrl-C ends it");
}

int run_view(const Globals& globals, const ViewArguments& arguments) {
  Report report(globals, "view", arguments.asset.asset);
  auto server = serve::Server::open(
      {.bind = arguments.bind, .port = static_cast<std::uint16_t>(arguments.port)});
  if (!server) {
    return report.fail(server.error());
  }
  auto options = session_options(arguments, report);
  if (!options) {
    return report.fail(options.error());
  }
  auto session = live::Session::open(*std::move(options));
  if (!session) {
    return report.fail(session.error());
  }
  report.diagnostics.append(session->asset().opening);
  if (auto published = publish_page(*server); !published) {
    return report.fail(published.error());
  }
  server->heed_signals();  // a client with the address may end it at once
  tell_address(report, *server);
  report.finish(kOk, live::address_json(*server));
  flush_prints();
  if (printing_error() != 0) {
    return kFailed;  // nobody has the address
  }
  const auto served = live::serve_session(*server, *session, arguments.seconds);
  if (!served) {
    say_aside(diagnostic_line(served.error().diagnostic(), use_color(globals)));
    return exit_code_of(served.error());
  }
  return kOk;
}

#else

int run_view(const Globals& globals, const ViewArguments& arguments) {
  Report report(globals, "view", arguments.asset.asset);
  return report.fail(Error(ErrorCode::Missing, "this tenon was built without its viewer")
                         .with_rule("view.missing")
                         .with_fix("install libboost-dev, node and npm, and build it again"));
}

#endif

constexpr const char* kViewFooter =
    "The page shows the asset, lets it move on an engine, and asks and edits it: joints, drives,\n"
    "forces by mouse, variants, findings, where a value comes from. Edits land in the file that\n"
    "owns the value, as with tenon set; --read-only refuses them. The address has a random token:\n"
    "who does not know it gets nothing. docs/viewer.md has the messages that pages send.\n\n"
    "Examples:\n"
    "  tenon view hand.usda\n"
    "  tenon view hand.usda --watch               reloads when a file changes\n"
    "  tenon view hand.usda --port 8080 --json    an address that scripts can read\n"
    "  tenon view hand.usda --screenshot hand.png a picture, without a server";

}  // namespace

void add_view(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb =
      parent.add_subcommand("view", "Show an asset in the browser: move it, inspect it, edit it");
  auto options = std::make_shared<ViewArguments>();
  options->asset.add_to(verb);
  verb.add_option("--bind", options->bind,
                  "The address to serve on; 0.0.0.0 is every network this machine is in")
      .value_name("ADDRESS");
  verb.add_option("--port", options->port, {0, 65535, false, true, ""}, "0: any that is free");
  verb.add_option("--engine", options->engine,
                  "The engine; without it that of tenon.toml, else that of the selected variant")
      .one_of(engines::engine_names())
      .value_name("NAME");
  verb.add_option("--dt", options->time_step, {1e-9, 10, false, false, "s"},
                  "Time step; without it the asset's, else 0.002 s")
      .value_name("SECONDS");
  verb.add_option("--triangles", options->triangles, {0, 1e9, false, true, ""},
                  "Simplify the picture to about so many; 0: draw all")
      .value_name("COUNT");
  verb.add_flag("--watch", options->watch, "Open the asset again when one of its files changes");
  verb.add_flag("--read-only", options->read_only, "Refuse edits");
  verb.add_option("--for", options->seconds, {0, 1e9, false, false, "s"},
                  "End by itself after this time; without it Ctrl-C ends it")
      .value_name("SECONDS");
  verb.add_option("--log", options->logs,
                  "A log of the robot for the panel \"Identify\" (tenon identify); may be repeated")
      .value_name("FILE")
      .repeatable();
  verb.add_option("--commands", options->commands, "Commands that are not in the logs, as a table")
      .value_name("FILE");
  verb.add_option("--screenshot", options->screenshot,
                  "Serve nothing: write a picture to this .png and end (tenon record has more to "
                  "choose)")
      .value_name("FILE");
  options->picture.add_to(verb);
  add_readings(verb, options->readings);
  add_pose(verb, options->pose);
  add_masks(verb, options->masks);
  verb.add_option("--set", options->asset.overrides,
                  "PATH.attr=value, for this session only; may be repeated")
      .repeatable();
  verb.footer(kViewFooter);
  choose(verb, chosen, [&globals, verb, options] {
    if (auto fits = check_view_kind(verb, *options); !fits) {
      return Report(globals, "view", options->asset.asset).fail(fits.error());
    }
    return options->screenshot.empty() ? run_view(globals, *options)
                                       : run_screenshot(globals, *options);
  });
}

}  // namespace tenon::cli
