// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Handles point into StageData, which stays in place when the Stage is moved. It is filled when the
// stage is opened. Paths below an instance have no records of their own: such a path is looked up
// at the nearest instance above it and followed down from there by names through the prototype.
// Metadata of the stage are those of the session layer and the root layer: sublayers do not count,
// and registered fallbacks are used for what neither of the two authors.
#include "tenon/stage/stage.h"

#include <algorithm>

#include "tenon/base/containers/short_list.h"
#include "tenon/stage/composed_fields.h"
#include "tenon/stage/stage_data.h"

namespace tenon::stage {
namespace {

using layer::Value;
namespace fields = layer::fields;

// What OpenUSD takes when neither layer authors the field.
Value registered_fallback(Token field) {
  if (field == fields::upAxis) {
    return Token("Y");
  }
  if (field == fields::metersPerUnit) {
    return 0.01;
  }
  if (field == fields::kilogramsPerUnit) {
    return 1.0;
  }
  if (field == fields::timeCodesPerSecond || field == fields::framesPerSecond) {
    return 24.0;
  }
  if (field == fields::startTimeCode || field == fields::endTimeCode) {
    return 0.0;
  }
  return {};
}

double number(const Value& value) {
  if (const double* x = value.get<double>()) {
    return *x;
  }
  return value.get_or<float>(0);
}

}  // namespace

std::vector<compose::Opinion> root_opinions(const StageData& data) {
  std::vector<compose::Opinion> result;
  const compose::LayerStack& stack = *data.cache->layer_stack();
  for (const layer::LayerPtr& layer : {stack.session, stack.root}) {
    if (layer != nullptr) {
      compose::Opinion opinion;
      opinion.layer = layer.get();
      opinion.spec = &layer->root();
      opinion.path = Path::absolute_root();
      result.push_back(opinion);
    }
  }
  return result;
}

Prim StageData::find(Path path) const {
  if (path.empty() || !path.is_absolute()) {
    return {};
  }
  ShortList<Path, 24> below;
  for (Path at = path; !at.empty(); at = at.parent()) {
    const PrimData* const found = record(at);
    if (found == nullptr) {
      if (!at.is_prim()) {
        return {};
      }
      below.push_back(at);
      continue;
    }
    if (!below.empty() && !found->is_instance()) {
      return {};
    }
    Prim prim(this, found);
    for (auto step = below.rbegin(); step != below.rend() && prim; ++step) {
      prim = prim.child(step->name());
    }
    return prim;
  }
  return {};
}

Stage::Stage(std::unique_ptr<StageData> data) : data_(std::move(data)) {}
Stage::Stage(Stage&&) noexcept = default;
Stage& Stage::operator=(Stage&&) noexcept = default;
Stage::~Stage() = default;

Result<Stage> Stage::open(layer::LayerPtr root, layer::LayerPtr session,
                          compose::LayerOpener opener, StageOptions options) {
  if (root == nullptr) {
    return Error(ErrorCode::Invalid, "a stage needs a root layer");
  }
  auto data = std::make_unique<StageData>();
  data->options = std::move(options);
  data->options.compose.shares_root_stack = false;
  data->clip_layers = std::make_unique<ClipLayers>(opener);
  data->cache = std::make_unique<compose::IndexCache>(std::move(root), std::move(session),
                                                      std::move(opener), data->options.compose);
  populate(*data);
  Diagnostics all = data->cache->errors();
  all.append(data->diagnostics);
  data->diagnostics = std::move(all);
  return Stage(std::move(data));
}

Prim Stage::pseudo_root() const { return Prim(data_.get(), data_->root); }

Prim Stage::prim(Path path) const { return data_->find(path); }

Prim Stage::default_prim() const {
  const Token name = root_layer().default_prim();
  if (name.empty()) {
    return {};
  }
  const auto path = Path::parse(name.view().front() == '/' ? name.str() : "/" + name.str());
  return path ? prim(*path) : Prim();
}

std::vector<Prim> Stage::prototypes() const {
  std::vector<Prim> result;
  for (const PrimData* prototype : data_->prototypes) {
    result.push_back(Prim(data_.get(), prototype));
  }
  return result;
}

const layer::Layer& Stage::root_layer() const { return *data_->cache->layer_stack()->root; }

const layer::Layer* Stage::session_layer() const {
  return data_->cache->layer_stack()->session.get();
}

const compose::LayerStack& Stage::layer_stack() const { return *data_->cache->layer_stack(); }

std::vector<layer::LayerPtr> Stage::used_layers() const {
  std::map<std::string, layer::LayerPtr> layers;
  for (const auto& some : {data_->cache->used_layers(), data_->clip_layers->opened()}) {
    for (const layer::LayerPtr& layer : some) {
      layers.emplace(layer->identifier(), layer);
    }
  }
  std::vector<layer::LayerPtr> result;
  for (const auto& [identifier, layer] : layers) {
    result.push_back(layer);
  }
  return result;
}

std::size_t Stage::work() const { return data_->cache->work(); }

bool Stage::may_lack_text() const {
  const std::vector<layer::LayerPtr> layers = used_layers();
  return std::any_of(layers.begin(), layers.end(),
                     [](const layer::LayerPtr& layer) { return layer->may_lack_text(); });
}

const std::vector<compose::MissingArc>& Stage::missing_arcs() const {
  return data_->cache->missing_arcs();
}

const Diagnostics& Stage::diagnostics() const {
  data_->diagnostics.append(data_->clip_layers->take_diagnostics());
  return data_->diagnostics;
}

void Stage::set_diagnostics(Diagnostics all) { data_->diagnostics = std::move(all); }

double Stage::start_time_code() const {
  return has_authored_metadata(fields::startTimeCode) ? number(metadata(fields::startTimeCode))
                                                      : number(metadata(fields::startFrame));
}

double Stage::end_time_code() const {
  return has_authored_metadata(fields::endTimeCode) ? number(metadata(fields::endTimeCode))
                                                    : number(metadata(fields::endFrame));
}

// Core Spec 1.0.1 on stage metadata: framesPerSecond is the fallback of timeCodesPerSecond.
double Stage::time_codes_per_second() const {
  for (const compose::Opinion& opinion : root_opinions(*data_)) {
    for (const Token field : {fields::timeCodesPerSecond, fields::framesPerSecond}) {
      if (const Value* value = opinion.spec->find(field)) {
        return number(*value);
      }
    }
  }
  return 24;
}

double Stage::frames_per_second() const { return number(metadata(fields::framesPerSecond)); }

Value Stage::metadata(Token field) const {
  const Value authored = compose_field(*data_, *data_->root, root_opinions(*data_), field);
  return authored.empty() ? registered_fallback(field) : authored;
}

bool Stage::has_authored_metadata(Token field) const {
  for (const compose::Opinion& opinion : root_opinions(*data_)) {
    if (opinion.spec->has(field)) {
      return true;
    }
  }
  return false;
}

std::map<std::string, Value> Stage::all_authored_metadata() const {
  return compose_metadata(*data_, *data_->root, root_opinions(*data_));
}

const PrimData* record_of(const Stage& stage, Path path) {
  const Prim prim = stage.prim(path);
  if (!prim) {
    return nullptr;
  }
  const Path own = prim.is_instance_proxy() ? prim.prim_in_prototype().path() : prim.path();
  return stage.data().record(own);
}

}  // namespace tenon::stage
