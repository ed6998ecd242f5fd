// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Sources are asked strongest first. Edits are collected until a source gives an array, or none is
// left and the schema's fallback stands under them. Then they are applied from the weakest up.
// Each source holds a sample until its next one. A time lies between the nearest samples, on both
// sides, of all sources down to the one that decides, and the value is blended between the arrays
// composed at these two. On the way to the later one a source goes no further than its own next
// sample, and nothing goes on towards a block.
#include "tenon/stage/values/compose_array_edits.h"

#include <algorithm>
#include <optional>

#include "tenon/stage/interpolate.h"

namespace tenon::stage {
namespace {

using layer::ArrayEdit;
using layer::Value;

struct Question {
  const StageData& stage;
  const PrimData& prim;
  Token name;
  AssetForm form;
  ReadTrace* trace = nullptr;
};

/// Notes in the trace how a source was used; a use on the way to another time counts less.
void note(const Question& question, std::size_t source, ReadTrace::Use use, bool on_the_way) {
  if (question.trace == nullptr) {
    return;
  }
  ReadTrace::Use& known = question.trace->sources[source];
  if (!on_the_way) {
    known = use;
  } else if (known == ReadTrace::Use::NotRead && use != ReadTrace::Use::OtherType) {
    known = ReadTrace::Use::MovedTowards;
  }
}

/// What one source says at a time without interpolation: an array, an edit, a block, or nothing.
Value said_at(const Question& question, const ResolvedValue& source, Time time) {
  return read_one_value(question.stage, question.prim, source, time, question.form,
                        Interpolation::Held);
}

bool is_none(const Value& value) { return value.empty() || value.is_block(); }

/// The elements under the edits: what the weakest source gives, or the fallback.
Value fallback_of(const Question& question) {
  const schema::PropertyDefinition* definition = question.prim.definition->find(question.name);
  return definition == nullptr ? Value() : definition->fallback;
}

Value applied(const std::vector<Value>& edits, const Value& weaker) {
  std::vector<const ArrayEdit*> strongest_first;
  for (const Value& edit : edits) {
    strongest_first.push_back(edit.get<ArrayEdit>());
  }
  const layer::ValueType type = strongest_first.front()->literals.type();
  const bool fits = weaker.is_array() && weaker.type() == type;
  return layer::apply_array_edits(strongest_first, fits ? weaker : Value()).value_or(Value());
}

/// The samples of a source in stage time.
std::vector<double> times_of(const ResolvedValue& source) {
  std::vector<double> times;
  if (source.clips != nullptr) {
    return source.clips->time_samples(source.opinion.path);
  }
  if (source.samples != nullptr) {
    for (const double time : source.samples->times) {
      times.push_back(source.opinion.offset.apply(time));
    }
    std::sort(times.begin(), times.end());
  }
  return times;
}

/// The strongest source, or one without another below it.
bool is_outermost(const ValueSources& sources, std::size_t at) {
  const auto is_nothing = [](const ResolvedValue& source) {
    return source.source == ValueSource::None || source.source == ValueSource::Fallback;
  };
  return at == 0 || at + 1 == sources.size() || is_nothing(sources[at + 1]);
}

/// What a source gives on the way from one time to another: up to its first sample on the way, or
/// to none where it is blocked. Blocks to come count for the outermost sources only.
Value said_on_the_way(const Question& question, const ValueSources& sources, std::size_t at,
                      double from, double to) {
  const ResolvedValue& source = sources[at];
  const std::vector<double> times = times_of(source);
  const auto next = std::lower_bound(times.begin(), times.end(), from);
  Value here = said_at(question, source, Time(from));
  if (is_none(here)) {
    return here;
  }
  Value there = said_at(question, source, Time(next == times.end() ? to : std::min(*next, to)));
  return is_none(there) && !is_outermost(sources, at) ? here : there;
}

/// The value at a time without interpolation; with `from` the one that is gone towards from there.
Value composed_at(const Question& question, const ValueSources& sources, Time time,
                  std::optional<double> from = std::nullopt) {
  std::vector<Value> edits;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const ResolvedValue& source = sources[i];
    if (source.source == ValueSource::None || source.source == ValueSource::Fallback) {
      if (source.blocked && time.is_default()) {
        note(question, i, ReadTrace::Use::Gives, false);
        return {};
      }
      break;  // a block of the default lets the fallback through at other times
    }
    Value value = from ? said_on_the_way(question, sources, i, *from, time.code())
                       : said_at(question, source, time);
    const auto* edit = value.get<ArrayEdit>();
    if (edit == nullptr) {
      note(question, i, ReadTrace::Use::Gives, from.has_value());
      const Value weaker = is_none(value) ? Value() : std::move(value);
      return edits.empty() ? weaker : applied(edits, weaker);
    }
    if (!edits.empty() &&
        edit->literals.type() != edits.front().get<ArrayEdit>()->literals.type()) {
      note(question, i, ReadTrace::Use::OtherType, from.has_value());
      break;
    }
    note(question, i, ReadTrace::Use::Edits, from.has_value());
    edits.push_back(std::move(value));
  }
  if (question.trace != nullptr) {
    question.trace->fallback = true;
  }
  const Value fallback = fallback_of(question);
  return edits.empty() ? fallback : applied(edits, fallback);
}

bool edits_at(const Question& question, const ResolvedValue& source, double time) {
  return said_at(question, source, Time(time)).holds<ArrayEdit>();
}

/// The samples around a time of all sources down to the one that decides there.
struct Around {
  std::optional<double> before;  ///< or at it
  std::optional<double> after;
};

Around samples_around(const Question& question, const ValueSources& sources, double time) {
  Around around;
  for (const ResolvedValue& source : sources) {
    const Value here = said_at(question, source, Time(time));
    if (is_none(here)) {
      break;
    }
    const std::vector<double> times = times_of(source);
    const auto next = std::upper_bound(times.begin(), times.end(), time);
    if (next != times.begin() && (!around.before || *around.before < *std::prev(next))) {
      around.before = *std::prev(next);
    }
    // Nothing goes on towards a block.
    if (next != times.end() && (!around.after || *next < *around.after) &&
        !is_none(said_at(question, source, Time(*next)))) {
      around.after = *next;
    }
    if (!here.holds<ArrayEdit>()) {
      break;
    }
  }
  return around;
}

}  // namespace

bool may_edit(const ResolvedValue& source) {
  switch (source.source) {
    case ValueSource::Default:
      return source.value->holds<ArrayEdit>();
    case ValueSource::TimeSamples:
      return std::any_of(source.samples->values.begin(), source.samples->values.end(),
                         [](const Value& value) { return value.holds<ArrayEdit>(); });
    case ValueSource::ValueClips:
      return true;
    default:
      return false;
  }
}

Value compose_array_edits(const StageData& stage, const PrimData& prim, Token name, Time time,
                          AssetForm form, ReadTrace* trace) {
  const Question question{stage, prim, name, form, trace};
  const ValueSources sources = value_sources(prim, name, asked_at(time));
  if (trace != nullptr) {
    trace->sources.assign(sources.size(), ReadTrace::Use::NotRead);
  }
  if (time.is_default()) {
    return composed_at(question, sources, time);
  }
  Value before = composed_at(question, sources, time);
  const Around around = samples_around(question, sources, time.code());
  if (!around.before || !around.after || stage.options.interpolation == Interpolation::Held ||
      *around.after - *around.before < kSameTime) {
    return before;
  }
  const Value after = composed_at(question, sources, Time(*around.after), time.code());
  const double span = *around.after - *around.before;
  return interpolate(before, after, (time.code() - *around.before) / span);
}

std::vector<double> edited_times(const StageData& stage, const PrimData& prim,
                                 const ValueSources& sources) {
  const Question question{stage, prim, Token(), AssetForm::Resolved};
  std::vector<double> result;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    for (const double time : times_of(sources[i])) {
      const bool counts = std::all_of(
          sources.begin(), sources.begin() + static_cast<std::ptrdiff_t>(i),
          [&](const ResolvedValue& stronger) { return edits_at(question, stronger, time); });
      if (counts) {
        result.push_back(time);
      }
    }
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

}  // namespace tenon::stage
