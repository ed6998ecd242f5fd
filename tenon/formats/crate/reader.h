// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/bytes/file_bytes.h"
#include "tenon/layer/layer.h"

namespace tenon::formats {

/// Reads a binary layer (.usdc) of versions 0.4.0 to 0.16.0, which is what OpenUSD 26.11 reads.
/// Arrays longer than a few elements stay in the file until they are asked for.
/// Errors: ErrorCode::Unsupported for other versions, by name; Corrupt for data that contradict
/// each other or the size of the file; Limit. Diagnostics: values of unsupported types are skipped.
Result<layer::Layer> read_crate(std::shared_ptr<const bytes::FileBytes> bytes,
                                std::string identifier, Diagnostics& diagnostics);

}  // namespace tenon::formats
