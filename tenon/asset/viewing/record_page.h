// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "tenon/asset/viewing/record_asset.h"
#include "tenon/base/result.h"
#include "tenon/browser/browser_page.h"
#include "tenon/view/view_camera.h"

/// Internal to this folder.
namespace tenon {

/// The page that draws recordings (page/src/record), in a browser.
class RecordPage {
 public:
  /// An empty page that is handed `scene`, a GLB; or the page of a report, `html`, which has its
  /// own.
  static Result<RecordPage> open(const RecordOptions& options, std::string_view html,
                                 std::string_view scene,
                                 const std::optional<view::ViewCamera>& camera);

  /// A PNG of the motion at a time [s].
  Result<std::string> still(double time);
  /// Begins a film; -> its codec as RecordOptions has it.
  Result<std::string> begin_film();
  /// The frame `index`, at a time of the motion [s], the camera turned [degrees].
  Result<void> add_frame(std::size_t index, double time, double turn);
  /// The bytes of the film.
  Result<std::string> end_film();

  const browser::BrowserPage& browser() const { return *page_; }
  bool interrupted() const { return page_->interrupted(); }

 private:
  RecordPage(const RecordOptions& options, std::unique_ptr<browser::BrowserPage> page)
      : options_(&options), page_(std::move(page)) {}
  Result<void> wait_for_report();
  /// What a script has made in the page: bytes.
  Result<std::string> taken(const std::string& script);

  const RecordOptions* options_;
  std::unique_ptr<browser::BrowserPage> page_;
};

}  // namespace tenon
