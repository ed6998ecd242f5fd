// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What conformance suites compare: one layer, a folded chain of list edits, values at times, and
// composition, each in the form that the suites record.
#include <iostream>
#include <iterator>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "cli/output.h"
#include "cli/report.h"
#include "cli/verb.h"
#include "tenon/answers/dump/layer_json.h"
#include "tenon/answers/dump/list_op_json.h"
#include "tenon/answers/dump/schema_json.h"
#include "tenon/answers/dump/values_json.h"
#include "tenon/formats/save_layer.h"
#include "tenon/open_stage.h"

namespace tenon::cli {
namespace {

constexpr const char* kName = "test-runner";

/// Prints `text`, or says why there is none.
int answer(Report& report, const Result<std::string>& text) {
  report.speak_as_text();
  if (!text) {
    return report.fail(text.error());
  }
  print_data(*text);
  print_data("\n");
  return report.finish(kOk);
}

struct LayerOptions {
  std::string file;
  FileAccess files;
};

Result<std::string> layer_text(const LayerOptions& options, Diagnostics& diagnostics) {
  TENON_TRY(const layer::LayerPtr layer,
            open_layer(options.file, options.files.open_options(), diagnostics));
  TENON_CHECK(formats::check_repeated_arrays(*layer));
  std::ostringstream out;
  answers::write_layer_json(out, *layer);
  return std::move(out).str();
}

Result<std::string> folded_list_ops(std::istream& in) {
  const std::string text(std::istreambuf_iterator<char>(in), {});
  TENON_TRY(const auto folded, answers::fold_list_ops(text));
  return answers::on_one_line(folded);
}

struct ValueOptions {
  AssetArguments asset;
  std::string attribute;
  std::vector<std::string> times;
};

Result<std::string> values_text(const ValueOptions& options, Diagnostics& diagnostics) {
  TENON_TRY(const Path path, Path::parse(options.attribute));
  TENON_TRY(const stage::Stage stage,
            tenon::open(options.asset.asset, options.asset.open_options(), diagnostics));
  const stage::Attribute attribute = stage.prim(path.prim()).attribute(path.name());
  if (!path.is_property() || !attribute.is_defined()) {
    return Error(ErrorCode::NotFound,
                 "<" + options.attribute + "> is not an attribute of the stage");
  }
  return answers::values_at_times(attribute, options.times);
}

void add_layer(const Command& runner, const Globals& globals, Chosen& chosen) {
  const Command verb =
      runner.add_subcommand("layer", "The fields of every spec of one layer, as JSON");
  auto options = std::make_shared<LayerOptions>();
  verb.add_option("file", options->file, "A .usd, .usda, .usdc or .usdz file").required();
  options->files.add_to(verb);
  choose(verb, chosen, [&globals, options] {
    Report report(globals, kName, options->file);
    return answer(report, layer_text(*options, report.diagnostics));
  });
}

void add_list_op(const Command& runner, const Globals& globals, Chosen& chosen) {
  const Command verb = runner.add_subcommand(
      "list-op", "Fold a chain of list edits, strongest first, from standard input into one");
  verb.footer(
      "Example:\n  echo '[{\"appended_items\": [1]}, {\"explicit_items\": [2, 1]}]' | "
      "tenon test-runner list-op");
  choose(verb, chosen, [&globals] {
    Report report(globals, kName, "");
    return answer(report, folded_list_ops(std::cin));
  });
}

void add_value(const Command& runner, const Globals& globals, Chosen& chosen) {
  const Command verb =
      runner.add_subcommand("value", "The resolved value of an attribute at each time, as JSON");
  auto options = std::make_shared<ValueOptions>();
  options->asset.add_to(verb);
  verb.add_option("attribute", options->attribute, "Such as /World/ball.radius").required();
  verb.add_option("times", options->times, "Time codes; \"default\" asks for the default value")
      .required();
  choose(verb, chosen, [&globals, options] {
    Report report(globals, kName, options->asset.asset);
    return answer(report, values_text(*options, report.diagnostics));
  });
}

void add_schemas(const Command& runner, const Globals& globals, Chosen& chosen) {
  const Command verb = runner.add_subcommand("schemas", "Every schema that tenon knows, as JSON");
  choose(verb, chosen, [&globals] {
    Report report(globals, kName, "");
    std::ostringstream out;
    answers::write_schemas_json(out);
    return answer(report, out.str());
  });
}

}  // namespace

void add_test_runner(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command runner = parent.add_subcommand(
      kName, "What conformance suites compare: layers, list edits, values, schemas, composition");
  runner.require_subcommand();
  runner.footer("Example:\n  tenon test-runner layer model.usdc");
  add_layer(runner, globals, chosen);
  add_list_op(runner, globals, chosen);
  add_value(runner, globals, chosen);
  add_schemas(runner, globals, chosen);
  add_index_dump(runner, "composition", "standin=render", globals, chosen);
}

}  // namespace tenon::cli
