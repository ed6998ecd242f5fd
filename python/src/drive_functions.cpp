// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The verbs that measure an asset, choose numbers for it and may write them: colliders and tune.
#include "drive_functions.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "answer_of.h"
#include "failure.h"
#include "options.h"
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "tenon/asset/answers/edited_json.h"
#include "tenon/asset/colliders/colliders_asset.h"
#include "tenon/asset/colliders/colliders_json.h"
#include "tenon/asset/edit_asset.h"
#include "tenon/asset/edit_request.h"
#include "tenon/asset/tuning/tune_asset.h"
#include "tenon/asset/tuning/tuned_json.h"
#include "tenon/base/text/comma_list.h"
#include "tenon/math/angle.h"

namespace tenon::python {
namespace {

using namespace nb::literals;

/// What was chosen, as one edit.
struct WrittenChoice {
  std::vector<AssetEdit> edits;
  EditedAsset edited;
};

Result<WrittenChoice> write_choice(const std::string& path, const OpenOptions& open,
                                   const EditRequest& request, bool any, Job& job) {
  WrittenChoice choice;
  if (!any) {
    return choice;
  }
  EditOptions options;
  options.open = open;
  TENON_TRY(choice.edits, read_edits(path, request, options));
  Diagnostics again;  // the asset was read before
  TENON_TRY(choice.edited, edit_asset(path, choice.edits, options, again));
  if (choice.edited.without_effect.empty()) {
    TENON_CHECK(check_may_write(job));
    TENON_CHECK(write_files(choice.edited.files));
  }
  return choice;
}

/// Raises for a word that is not in `known`.
void check_word(const std::string& name, const std::string& word, bool is_known,
                const std::vector<std::string>& known) {
  if (!word.empty() && !is_known) {
    raise(Error(ErrorCode::Invalid, name + " is \"" + word + "\"")
              .with_rule("usage.value")
              .with_fix("expected one of: " + comma_list(known)));
  }
}

nb::object colliders(const std::filesystem::path& path, const OpenArguments& arguments,
                     const std::string& engine, const std::vector<std::string>& patterns,
                     const std::string& approximation, std::size_t budget,
                     std::optional<double> gap, bool save) {
  CollidersOptions options;
  options.open = open_options_of(arguments);
  options.engine = engine;
  options.colliders = patterns;
  options.instead = approximation_named(approximation);
  check_word("approximation", approximation, options.instead.has_value(), approximation_words());
  if (budget > 0) {
    options.budget = ColliderBudget{budget, gap};
  }
  return answer_of([path = path.string(), options, save](Job& job) -> Result<Json> {
    TENON_TRY(const CollidersOfAsset found, colliders_of_asset(path, options, job.found));
    Json json = colliders_json(found);
    if (save) {
      EditRequest request;
      request.collider = collider_requests(found);
      TENON_TRY(const WrittenChoice choice,
                write_choice(path, options.open, request, !request.collider.empty(), job));
      json.update(edited_json(choice.edits, choice.edited, false));
    }
    return json;
  });
}

/// The arguments of tune() as tenon_usd/functions.py hands them over, by name; what is not given is
/// absent, or empty.
struct TuneArguments {
  std::map<std::string, double> numbers;
  std::map<std::string, std::string> words;
  std::map<std::string, std::vector<std::string>> lists;
  std::map<std::string, bool> flags;
  std::vector<double> payloads;  ///< [kg]

  std::optional<double> number(const char* name) const {
    const auto found = numbers.find(name);
    return found == numbers.end() ? std::nullopt : std::optional(found->second);
  }
};

std::optional<SearchRequest> search_of(const TuneArguments& given) {
  if (!given.flags.at("search")) {
    return std::nullopt;
  }
  SearchRequest search;
  search.goal.overshoot = given.numbers.at("overshoot");
  search.goal.settling = given.numbers.at("settle");
  search.payloads = given.payloads;
  search.at = given.words.at("at");
  search.poses = static_cast<std::size_t>(given.numbers.at("poses"));
  search.seed = static_cast<std::uint64_t>(given.numbers.at("seed"));
  return search;
}

TuneOptions tune_options(const OpenArguments& arguments, const TuneArguments& given) {
  TuneOptions options;
  options.open = open_options_of(arguments);
  options.readings = readings_of(arguments);
  options.joints = given.lists.at("joints");
  options.sequence = given.lists.at("sequence");
  options.gains_file = given.words.at("gains");
  options.engine = given.words.at("engine");
  options.time_step = given.number("time_step").value_or(0);
  options.force = given.flags.at("force");
  options.wish.damping_ratio = given.number("damping_ratio");
  if (const auto frequency = given.number("frequency")) {
    options.wish.frequency = *frequency * 2 * kPi;
  }
  options.search = search_of(given);
  const std::string& test = given.words.at("test");
  options.test = tuning::test_named(test);
  check_word("test", test, options.test.has_value(), tuning::test_names());
  options.test_options.period = given.number("period");
  options.test_options.amplitude = given.number("amplitude");
  options.test_options.duration = given.number("duration");
  options.test_options.seed = static_cast<std::uint64_t>(given.numbers.at("seed"));
  options.test_options.adversarial = given.flags.at("adversarial");
  return options;
}

nb::object tune(const std::filesystem::path& path, const OpenArguments& arguments,
                const std::map<std::string, double>& numbers,
                const std::map<std::string, std::string>& words,
                const std::map<std::string, std::vector<std::string>>& lists,
                const std::map<std::string, bool>& flags, const std::vector<double>& payloads) {
  const TuneArguments given{numbers, words, lists, flags, payloads};
  const bool save = given.flags.at("save");
  return answer_of([path = path.string(), save,
                    options = tune_options(arguments, given)](Job& job) mutable -> Result<Json> {
    options.listener.go_on = [&job](double /*seconds*/, double /*duration*/) {
      return job.go_on();
    };
    TENON_TRY(const TunedAsset tuned, tune_asset(path, options, job.found));
    if (!save) {
      return tuned_json(tuned);
    }
    TENON_TRY(const WrittenChoice choice,
              write_choice(path, options.open, tuned.request, !tuned.request.drive.empty(), job));
    return tuned_json(tuned, choice.edits, choice.edited);
  });
}

}  // namespace

void bind_drive_functions(nb::module_& module) {
  module.def("colliders", &colliders, "path"_a, "arguments"_a, "engine"_a, "patterns"_a,
             "approximation"_a, "budget"_a, "gap"_a.none(), "save"_a,
             nb::sig("def colliders(path: str | os.PathLike[str], arguments: OpenArguments, "
                     "engine: str, patterns: Sequence[str], approximation: str, budget: int, "
                     "gap: float | None, save: bool) -> dict[str, Any]"));
  module.def("tune", &tune, "path"_a, "arguments"_a, "numbers"_a, "words"_a, "lists"_a, "flags"_a,
             "payloads"_a,
             nb::sig("def tune(path: str | os.PathLike[str], arguments: OpenArguments, "
                     "numbers: Mapping[str, float], words: Mapping[str, str], "
                     "lists: Mapping[str, Sequence[str]], flags: Mapping[str, bool], "
                     "payloads: Sequence[float]) -> dict[str, Any]"));
}

}  // namespace tenon::python
