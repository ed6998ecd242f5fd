// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "tenon/base/function.h"
#include "tenon/base/result.h"
#include "tenon/live/work.h"

namespace tenon::live {

enum class IdentifyStage : std::uint8_t {
  Check,     ///< what the logs tell
  Solve,     ///< the fit, and the layer that it would write
  SelfTest,  ///< a log with other numbers is made and they are found
};

/// What the panel "Identify" asks of the verb of that name. Texts are those of its options.
struct IdentifyWish {
  IdentifyStage stage = IdentifyStage::Check;
  std::string asset;
  std::string engine;
  std::string variant;  ///< of "Physics"; empty: the asset's
  std::vector<std::string> logs;
  std::vector<std::string> held_out;    ///< logs that are not fitted
  std::vector<std::string> parameters;  ///< FAMILY:REGEX=LOW..HIGH
  std::vector<std::string> priors;      ///< FAMILY:REGEX=VALUE,DEVIATION
  std::vector<std::string> names;       ///< NAME=JOINT
  std::vector<std::string> signs;       ///< JOINT=-1
  std::string units;
  bool allow_gaps = false;
  bool hold = false;      ///< what the logs do not tell keeps the asset's number
  double training = 0.7;  ///< of each log the part that is fitted
  double time_step = 0;   ///< [s]; 0: the asset's
  double window = 0;      ///< [s]; 0: the verb's own
  std::uint32_t starts = 1;
  std::string layer;  ///< the file that would be written
};

/// How the verb ended.
struct IdentifyEnd {
  int code = 0;
  std::string json;       ///< with "layer", the text that would be written, where there is one
  std::string complaint;  ///< the last lines of standard error
};

/// Runs the verb. It tells `work` how far it is, and ends soon once that is ended. Safe from
/// another thread. Errors: Missing (python.missing) without the Python package.
using IdentifyRun = Function<Result<IdentifyEnd>(const IdentifyWish& wish, Work& work)>;

/// What a session can identify with.
struct IdentifyTools {
  std::vector<std::string> logs;  ///< files that pages may name
  std::string commands;           ///< a table that the logs lack; empty: none
  IdentifyRun run;                ///< empty: the panel says that there is none
};

/// The layer of the last fit, until it is written. Safe from two threads.
class FoundLayer {
 public:
  struct Layer {
    std::string text;
    std::vector<std::string> problems;  ///< why the verb would not write it
  };
  void keep(Layer layer) {
    const std::lock_guard<std::mutex> lock(mutex_);
    layer_ = std::move(layer);
  }
  Layer get() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return layer_;
  }

 private:
  mutable std::mutex mutex_;
  Layer layer_;
};

}  // namespace tenon::live
