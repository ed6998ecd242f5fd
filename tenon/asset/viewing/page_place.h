// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "tenon/base/result.h"
#include "tenon/bytes/file_bytes.h"

namespace tenon {

/// The folder of the bundled page: the environment variable TENON_PAGE; else as it is built and
/// installed, share/tenon/page of the prefix that the program or libtenon.so lies in. Missing, with
/// how to get it, where there is none.
Result<std::string> page_folder();

/// A file of the page: "report.html", "index.html", "live.js", "page.css". Errors: as above; Io.
Result<std::shared_ptr<const bytes::FileBytes>> page_file(const std::string& name);

}  // namespace tenon
