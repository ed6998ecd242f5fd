// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage/work_account.h"

#include <algorithm>
#include <string>

#include "tenon/base/limits/work_limits.h"
#include "tenon/compose/composition_error.h"

namespace tenon::stage {

WorkAccount::WorkAccount(std::size_t max_work)
    : most_(std::max(max_work, 2 * limits::kComposeWork)) {}

Result<void> WorkAccount::spend(const Stage& stage) {
  for (const Diagnostic& found : stage.diagnostics().items()) {
    if (compose::is_work_exceeded(found)) {
      return Error(ErrorCode::Limit, found.message)
          .in_file(found.file)
          .with_prim(found.prim)
          .with_rule(found.rule)
          .with_fix(found.fix);
    }
  }
  spent_ += stage.work();
  for (const layer::LayerPtr& layer : stage.used_layers()) {
    allowed_ += limits::kComposeWorkPerSpec * layer->spec_count();
  }
  if (spent_ > allowed_ + most_) {
    return Error(ErrorCode::Limit, "composing the asset in all its variants takes more than " +
                                       std::to_string(allowed_ + most_) + " units of work")
        .in_file(stage.root_layer().identifier())
        .with_rule("compose.work-exceeded")
        .with_fix("reduce the arcs that multiply with each other, or allow more with --max-work");
  }
  return {};
}

}  // namespace tenon::stage
