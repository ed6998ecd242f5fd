// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/engines/mujoco/mujoco_library.h"

/// Internal to this folder.
namespace tenon::mjcf {

/// A model as MuJoCo has read and compiled it, with the words of its file: names and lines of its
/// elements, and findings about them. Elements have the numbers of the compiled model.
class MjcfSource {
 public:
  /// All but `file`, the model's, outlive this.
  MjcfSource(mjSpec& spec, const mjModel& model, std::string file, Diagnostics& diagnostics)
      : spec_(spec), model_(model), file_(std::move(file)), diagnostics_(diagnostics) {}

  const mjModel& model() const { return model_; }
  const std::string& file() const { return file_; }

  /// As the file says; empty: none given.
  std::string written_name(mjtObj kind, int id) const;
  /// Unique in its kind: as written, else `otherwise` with the number.
  std::string name(mjtObj kind, int id, const char* otherwise) const;
  /// What the element was compiled from; nullptr: nothing.
  mjsElement* element(mjtObj kind, int id) const;

  /// Where the element is written, 1-based; 0: not known.
  std::uint32_t line_of(mjtObj kind, int id) const;
  /// Of all elements of a kind, in the order of their numbers.
  std::vector<std::uint32_t> lines_of(mjtObj kind) const;

  /// Adds a finding about the file.
  void report(Severity severity, const char* rule, std::string message, std::uint32_t line = 0);
  /// A warning "mjcf.left-out".
  void left_out(std::string message, std::uint32_t line = 0);

 private:
  mjSpec& spec_;
  const mjModel& model_;
  std::string file_;
  Diagnostics& diagnostics_;
  mutable std::map<mjtObj, std::map<int, mjsElement*>> elements_;  // by number, as asked for
};

/// Takes the room that simulations of a model want out of its description, as long as this lives:
/// nothing is simulated here, and it may be gigabytes, which compilers ask for too.
class WithoutArena {
 public:
  explicit WithoutArena(mjSpec& spec)
      : spec_(spec), memory_(spec.memory), njmax_(spec.njmax), nconmax_(spec.nconmax) {
    spec.memory = -1;
    spec.njmax = -1;
    spec.nconmax = -1;
  }
  WithoutArena(const WithoutArena&) = delete;
  WithoutArena& operator=(const WithoutArena&) = delete;
  ~WithoutArena() {
    spec_.memory = memory_;
    spec_.njmax = njmax_;
    spec_.nconmax = nconmax_;
  }

 private:
  mjSpec& spec_;
  mjtSize memory_;
  int njmax_;
  int nconmax_;
};

/// ": lines 3, 5", or nothing where no line is known.
std::string lines_text(const std::vector<std::uint32_t>& lines);

}  // namespace tenon::mjcf
