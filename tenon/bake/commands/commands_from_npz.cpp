// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Commands from NumPy. Sizes are compared with one another and with the limit before a number is
// read; numbers become SI while they are.
#include "tenon/bake/commands/commands_from_npz.h"

#include <cmath>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "tenon/bake/commands/command_names.h"
#include "tenon/bake/npy_array.h"
#include "tenon/base/limits/run_limits.h"
#include "tenon/base/text/text_number.h"
#include "tenon/bytes/zip/zip_archive.h"

namespace tenon::bake {
namespace {

constexpr const char* kFix =
    "write it with numpy.savez(FILE, time=..., columns=[...], values=...): rows, columns, and rows "
    "x columns";

Error wrong(ErrorCode code, std::string message, std::string fix = kFix) {
  return Error(code, std::move(message)).with_rule("sim.commands").with_fix(std::move(fix));
}

Result<NpyArray> read_array(const bytes::ZipArchive& archive, const std::string& name) {
  const bytes::ZipEntry* entry = archive.find(name + ".npy");
  if (entry == nullptr) {
    return wrong(ErrorCode::NotFound, "the archive has no array \"" + name + "\"");
  }
  if (entry->method != 0) {
    return wrong(ErrorCode::Unsupported, "the array \"" + name + "\" is compressed",
                 "write it with numpy.savez, not savez_compressed");
  }
  TENON_TRY(auto file, archive.read_checked(*entry));
  auto array = NpyArray::read(std::move(file));
  if (!array) {
    return wrong(array.error().code(),
                 "the array \"" + name + "\" cannot be read: " + array.error().message());
  }
  return array;
}

struct Arrays {
  NpyArray time;
  NpyArray columns;
  NpyArray values;
};

Result<Arrays> read_arrays(const bytes::ZipArchive& archive) {
  TENON_TRY(NpyArray time, read_array(archive, "time"));
  TENON_TRY(NpyArray columns, read_array(archive, "columns"));
  TENON_TRY(NpyArray values, read_array(archive, "values"));
  if (time.is_text() || values.is_text() || !columns.is_text()) {
    return wrong(ErrorCode::Parse, "\"time\" and \"values\" are numbers, \"columns\" are texts");
  }
  if (time.shape().size() != 1 || columns.shape().size() != 1 ||
      values.shape() != std::vector<std::size_t>{time.size(), columns.size()}) {
    return wrong(ErrorCode::Parse, "\"values\" has not a number for each of " +
                                       std::to_string(time.size()) + " times and " +
                                       std::to_string(columns.size()) + " columns");
  }
  if (time.size() + values.size() > limits::kCommandValues) {
    return wrong(ErrorCode::Limit,
                 "more than " + std::to_string(limits::kCommandValues) + " numbers of commands",
                 "give a file for each part of the run, with --state-out and --state-in between");
  }
  return Arrays{std::move(time), std::move(columns), std::move(values)};
}

Result<std::vector<CommandColumn>> read_columns(const NpyArray& array, const CommandNames& names) {
  std::vector<CommandColumn> columns;
  std::set<std::string> seen;
  for (std::size_t i = 0; i < array.size(); ++i) {
    const std::string name = array.text(i);
    TENON_TRY(const CommandColumn column, names.find(name));
    if (!seen.insert(name).second) {
      return wrong(ErrorCode::Parse, "the column " + shown_name(name) + " is there twice",
                   "leave one out");
    }
    columns.push_back(column);
  }
  return columns;
}

Result<std::vector<double>> read_times(const NpyArray& array) {
  std::vector<double> times;
  for (std::size_t i = 0; i < array.size(); ++i) {
    const double time = array.number(i);
    if (!std::isfinite(time) || (i > 0 && time <= times.back())) {
      return wrong(ErrorCode::Parse,
                   "time[" + std::to_string(i) + "] = " + shortest(time) +
                       (i == 0 ? std::string(" is not a finite number")
                               : " is not a finite number above the one before"),
                   "sort the rows by time, each time once");
    }
    times.push_back(time);
  }
  return times;
}

}  // namespace

Result<Commands> commands_from_npz(std::shared_ptr<const bytes::FileBytes> file,
                                   const scene::PhysicsScene& scene,
                                   const engines::Simulation& simulation) {
  TENON_TRY(const auto archive, bytes::ZipArchive::open(std::move(file)));
  TENON_TRY(const Arrays arrays, read_arrays(archive));
  const CommandNames names(scene, simulation);
  Commands commands;
  TENON_TRY(commands.columns, read_columns(arrays.columns, names));
  TENON_TRY(commands.times, read_times(arrays.time));
  commands.values.reserve(arrays.values.size());
  const std::size_t width = commands.columns.size();
  for (std::size_t i = 0; i < arrays.values.size(); ++i) {
    const double value = arrays.values.number(i) * names.unit_of(commands.columns[i % width]);
    if (std::isinf(value)) {
      return wrong(ErrorCode::Parse,
                   "values[" + std::to_string(i / width) + ", " + std::to_string(i % width) +
                       "] is not a finite number",
                   "write a number, or NaN where what held goes on");
    }
    commands.values.push_back(value);
  }
  return commands;
}

}  // namespace tenon::bake
