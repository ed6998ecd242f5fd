// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/answers/dump/json_sink.h"
#include "tenon/answers/json.h"
#include "tenon/base/diagnostics.h"

namespace tenon::answers {

/// {"severity", "rule", "message", "file", "line", "column", "endLine", "endColumn", "prim",
/// "property", "fix", "related"}: null for what is unknown. "related": [{"path", "role", "file",
/// "line", "column"}], what the finding is about beside its own prim.
Json diagnostic_json(const Diagnostic& diagnostic);

/// What every answer says before it comes to its subject.
struct Envelope {
  std::string version;  ///< of the program
  std::string verb;
  std::string asset;  ///< empty: the verb is not about one
  bool ok = true;
  std::string settings{};  ///< the tenon.toml that was read; empty: none
};

/// {"tool", "version", "schema", "asset", "ok", "diagnostics"}, "settings" where a file was read,
/// then the keys of `body`, which may have diagnostics of its own.
Json envelope_json(const Envelope& envelope, const Diagnostics& diagnostics, Json body);

/// Writes members into an object that is open; none that the envelope has.
using WriteMembers = std::function<void(JsonTextSink& sink)>;

/// The same as text, for a body that is too long to be held.
void write_envelope(const Envelope& envelope, const Diagnostics& diagnostics,
                    const WriteMembers& body, JsonTextSink& sink);

/// {"assets"}: the answers for several assets in one.
Json assets_json(std::vector<Json> answers);

/// {"text"}: an answer that is a text.
Json text_json(const std::string& text);

/// {"output"}: where the answer was written.
Json output_json(const std::string& output);

/// {"rule", "page"}: a rule and its page.
Json rule_page_json(const std::string& rule, std::string_view page);

}  // namespace tenon::answers
