// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/asset/tuning/tune_asset.h"
#include "tenon/live/session.h"

/// Internal to tenon/live.
namespace tenon::live {

/// The asset of a session with the gains that were set in its model.
TuneOptions wished_tuning(const Session::State& state);

}  // namespace tenon::live
