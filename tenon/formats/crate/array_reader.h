// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "tenon/base/result.h"
#include "tenon/formats/crate/layout.h"
#include "tenon/formats/crate/tables.h"
#include "tenon/formats/crate/work_budget.h"
#include "tenon/layer/value.h"

namespace tenon::formats::crate {

/// The array that `word` points at. Short ones are decoded at once, others when asked for; the
/// header of either is checked here: no more elements than the file's bytes can hold.
Result<layer::Value> read_array(const std::shared_ptr<const CrateFile>& file,
                                layer::ValueType element, ValueWord word, WorkBudget& budget);

/// The text of a string by its index.
Result<std::string_view> string_at(const CrateFile& file, std::uint32_t index);
Result<Token> token_at(const CrateFile& file, std::uint32_t index);

}  // namespace tenon::formats::crate
