// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Edits are applied to the indices of elements, whatever their type; the elements are put together
// once, at the end: those of all types of numbers as bytes.
#include "tenon/layer/array_edit.h"

#include <algorithm>
#include <cstring>
#include <vector>

#include "tenon/base/limits/limits.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/number_arrays.h"

namespace tenon::layer {
namespace {

/// An element of a weaker array, of an edit's literals, or zero.
struct Source {
  static constexpr std::uint32_t kZero = 0xffffffffu;
  static constexpr std::uint32_t kWeaker = 0xfffffffeu;
  std::uint32_t edit = kZero;  ///< number of the edit, kWeaker or kZero
  std::uint32_t index = 0;
};

/// A list in blocks, so that an insertion moves few elements.
class SourceList {
 public:
  explicit SourceList(std::size_t count) {
    for (std::size_t at = 0; at < count; at += kBlock) {
      std::vector<Source>& block = blocks_.emplace_back();
      for (std::size_t i = at; i < std::min(at + kBlock, count); ++i) {
        block.push_back({Source::kWeaker, static_cast<std::uint32_t>(i)});
      }
    }
    size_ = count;
  }

  std::size_t size() const { return size_; }
  const std::vector<std::vector<Source>>& blocks() const { return blocks_; }

  Source& at(std::size_t index) {
    const Place place = find(index);
    return blocks_[place.block][place.offset];
  }

  void insert(std::size_t index, Source source) {
    if (blocks_.empty()) {
      blocks_.emplace_back();
    }
    // Behind the last element of a block rather than in front of the next one.
    const Place place = index == 0 ? Place{0, 0} : after(find(index - 1));
    std::vector<Source>& block = blocks_[place.block];
    block.insert(block.begin() + static_cast<std::ptrdiff_t>(place.offset), source);
    ++size_;
    if (block.size() > 2 * kBlock) {
      std::vector<Source> rest(block.begin() + kBlock, block.end());
      block.resize(kBlock);
      blocks_.insert(blocks_.begin() + static_cast<std::ptrdiff_t>(place.block) + 1,
                     std::move(rest));
    }
  }

  void erase(std::size_t index) {
    const Place place = find(index);
    std::vector<Source>& block = blocks_[place.block];
    block.erase(block.begin() + static_cast<std::ptrdiff_t>(place.offset));
    --size_;
    if (block.empty()) {
      blocks_.erase(blocks_.begin() + static_cast<std::ptrdiff_t>(place.block));
    }
  }

  void resize(std::size_t size, Source fill) {
    while (size_ > size) {
      std::vector<Source>& last = blocks_.back();
      const std::size_t removed = std::min(last.size(), size_ - size);
      last.resize(last.size() - removed);
      size_ -= removed;
      if (last.empty()) {
        blocks_.pop_back();
      }
    }
    while (size_ < size) {
      if (blocks_.empty() || blocks_.back().size() >= kBlock) {
        blocks_.emplace_back();
      }
      std::vector<Source>& last = blocks_.back();
      const std::size_t added = std::min(kBlock - last.size(), size - size_);
      last.insert(last.end(), added, fill);
      size_ += added;
    }
  }

 private:
  static constexpr std::size_t kBlock = 1024;
  struct Place {
    std::size_t block;
    std::size_t offset;
  };
  static Place after(Place place) { return {place.block, place.offset + 1}; }

  /// From the nearer end; `index` is in the list.
  Place find(std::size_t index) const {
    if (index < size_ / 2) {
      std::size_t block = 0;
      for (; index >= blocks_[block].size(); ++block) {
        index -= blocks_[block].size();
      }
      return {block, index};
    }
    std::size_t start = size_;
    std::size_t block = blocks_.size();
    while (start > index) {
      --block;
      start -= blocks_[block].size();
    }
    return {block, index - start};
  }

  std::vector<std::vector<Source>> blocks_;
  std::size_t size_ = 0;
};

/// Edits a list of sources, one edit after the other.
class Application {
 public:
  explicit Application(std::size_t weaker_size) : list_(weaker_size) {}

  /// False when the array gets too large.
  bool apply(const ArrayEdit& edit, std::uint32_t number) {
    number_ = number;
    bool fits = true;
    for_each_step(edit, [&](const ArrayEditStep& step) { fits = fits && take(step); });
    return fits;
  }

  const SourceList& list() const { return list_; }

 private:
  Source literal(std::int64_t index) const { return {number_, static_cast<std::uint32_t>(index)}; }

  /// The element that an index means, if there is one.
  std::optional<std::size_t> element(std::int64_t index) const {
    const auto size = static_cast<std::int64_t>(list_.size());
    if (index < -size || index >= size) {
      return std::nullopt;
    }
    return static_cast<std::size_t>(index < 0 ? index + size : index);
  }
  /// The place where an insertion at `index` goes.
  std::optional<std::size_t> gap(std::int64_t index) const {
    const auto size = static_cast<std::int64_t>(list_.size());
    if (index == kArrayEnd || index == size) {
      return list_.size();
    }
    return element(index);
  }

  bool insert(std::int64_t index, Source source) {
    const auto place = gap(index);
    if (!place) {
      return true;
    }
    list_.insert(*place, source);
    return ++added_ <= limits::kArrayEditGrowth;
  }
  bool resize(std::uint64_t size, Source fill) {
    const std::uint64_t more = size - std::min<std::uint64_t>(size, list_.size());
    if (more > limits::kArrayEditGrowth - added_) {
      return false;
    }
    added_ += static_cast<std::size_t>(more);
    list_.resize(static_cast<std::size_t>(size), fill);
    return true;
  }

  bool take(const ArrayEditStep& step) {
    const auto size = static_cast<std::uint64_t>(step.first);
    const bool filled = has_second_argument(step.op);
    switch (step.op) {
      case ArrayEditOp::Write:
        if (const auto target = element(step.second)) {
          list_.at(*target) = literal(step.first);
        }
        return true;
      case ArrayEditOp::WriteCopy: {
        const auto from = element(step.first);
        const auto to = element(step.second);
        if (from && to) {
          list_.at(*to) = Source(list_.at(*from));
        }
        return true;
      }
      case ArrayEditOp::Insert:
        return insert(step.second, literal(step.first));
      case ArrayEditOp::InsertCopy: {
        const auto from = element(step.first);
        return !from || insert(step.second, Source(list_.at(*from)));
      }
      case ArrayEditOp::Erase:
        if (const auto target = element(step.first)) {
          list_.erase(*target);
        }
        return true;
      case ArrayEditOp::MinSize:
      case ArrayEditOp::MinSizeFill:
        return size <= list_.size() || resize(size, filled ? literal(step.second) : Source());
      case ArrayEditOp::Resize:
      case ArrayEditOp::ResizeFill:
        return resize(size, filled ? literal(step.second) : Source());
      case ArrayEditOp::MaxSize:
        return size >= list_.size() || resize(size, Source());
    }
    return true;
  }

  SourceList list_;
  std::size_t added_ = 0;  // also what was taken out again
  std::uint32_t number_ = 0;
};

/// Elements of arrays of texts and bools: those of each edit's literals and of the weaker array.
template <class T>
struct Origins {
  std::vector<const Array<T>*> edits;
  const Array<T>* weaker = nullptr;

  const ArrayElement<T>& of(Source source) const {
    return (*(source.edit == Source::kWeaker ? weaker : edits[source.edit]))[source.index];
  }
};

/// Nothing where one of the arrays is of another type.
template <class T>
std::optional<Value> gather(const SourceList& list, std::span<const ArrayEdit* const> edits,
                            const Value& weaker) {
  Origins<T> origins;
  for (const ArrayEdit* edit : edits) {
    origins.edits.push_back(edit->literals.get<Array<T>>());
    if (origins.edits.back() == nullptr) {
      return std::nullopt;
    }
  }
  origins.weaker = weaker.get<Array<T>>();
  if (origins.weaker == nullptr && !weaker.empty()) {
    return std::nullopt;
  }
  ArrayBuffer<T> result(list.size());
  auto at = result.begin();
  for (const std::vector<Source>& block : list.blocks()) {
    for (const Source source : block) {
      if (source.edit != Source::kZero) {
        *at = origins.of(source);
      }
      ++at;
    }
  }
  return Value(std::move(result));
}

/// The bytes of the same with arrays of numbers.
struct NumberOrigins {
  std::vector<std::span<const std::byte>> edits;
  std::span<const std::byte> weaker;

  const std::byte* of(Source source, std::size_t size) const {
    const auto& array = source.edit == Source::kWeaker ? weaker : edits[source.edit];
    return array.data() + source.index * size;
  }
};

std::optional<NumberOrigins> number_origins(ValueType type, std::span<const ArrayEdit* const> edits,
                                            const Value& weaker) {
  NumberOrigins origins;
  for (const ArrayEdit* edit : edits) {
    const auto literals = NumberArrays::elements(edit->literals);
    if (!literals || edit->literals.type() != type) {
      return std::nullopt;
    }
    origins.edits.push_back(*literals);
  }
  if (!weaker.empty()) {
    const auto below = NumberArrays::elements(weaker);
    if (!below) {
      return std::nullopt;
    }
    origins.weaker = *below;
  }
  return origins;
}

std::optional<Value> gather_numbers(ValueType type, const SourceList& list,
                                    std::span<const ArrayEdit* const> edits, const Value& weaker) {
  const std::optional<NumberOrigins> origins = number_origins(type, edits, weaker);
  if (!origins) {
    return std::nullopt;
  }
  const std::size_t size = NumberArrays::layout(type).size;
  std::vector<std::byte> result(list.size() * size);
  std::byte* at = result.data();
  for (const std::vector<Source>& block : list.blocks()) {
    for (const Source source : block) {
      if (source.edit != Source::kZero) {
        std::memcpy(at, origins->of(source, size), size);
      }
      at += size;
    }
  }
  return NumberArrays::make(type, result);
}

template <class T>
Value array_of(std::span<const Value> elements) {
  ArrayBuffer<T> result;
  result.reserve(elements.size());
  for (const Value& element : elements) {
    result.push_back(*element.get<T>());
  }
  return Value(std::move(result));
}

/// Where the number is that a value holds.
const void* address_of_number(const Value& value) {
  switch (value.type()) {
#define TENON_NUMBER(enumerator, type, name, crate_id) \
  case ValueType::enumerator:                          \
    return value.get<type>();
#include "tenon/layer/value_types.def"
    default:
      return nullptr;
  }
}

Value array_of_numbers(ValueType type, std::span<const Value> elements) {
  const std::size_t size = NumberArrays::layout(type).size;
  std::vector<std::byte> result(elements.size() * size);
  std::byte* at = result.data();
  for (const Value& element : elements) {
    std::memcpy(at, address_of_number(element), size);
    at += size;
  }
  return NumberArrays::make(type, result);
}

}  // namespace

bool ArrayEdit::is_well_formed() const {
  const std::span<const std::int64_t> words = instructions.span();
  const auto literal_count = static_cast<std::int64_t>(literals.size());
  for (std::size_t at = 0; at < words.size();) {
    const ArrayEditRun run(words[at]);
    ++at;
    if (run.code >= kArrayEditOps) {
      return false;
    }
    const auto op = static_cast<ArrayEditOp>(run.code);
    const std::size_t width = has_second_argument(op) ? 2 : 1;
    if (run.count > (words.size() - at) / width) {
      return false;
    }
    const auto literal = static_cast<std::size_t>(literal_argument(op));
    for (std::uint64_t i = 0; i < run.count; ++i, at += width) {
      const bool sized = op >= ArrayEditOp::MinSize;
      const std::int64_t number = literal < 2 ? words[at + literal] : 0;
      if ((sized && words[at] < 0) || (literal < 2 && (number < 0 || number >= literal_count))) {
        return false;
      }
    }
  }
  return literals.is_array();
}

void ArrayEditBuilder::add(const ArrayEditStep& step) {
  const auto code = static_cast<std::uint64_t>(step.op);
  if (instructions_.empty() || ArrayEditRun(instructions_[run_]).code != code) {
    run_ = instructions_.size();
    instructions_.push_back(static_cast<std::int64_t>(code << ArrayEditRun::kCountBits));
  }
  ++instructions_[run_];
  instructions_.push_back(step.first);
  if (has_second_argument(step.op)) {
    instructions_.push_back(step.second);
  }
}

ArrayEdit ArrayEditBuilder::finish(Value literals) {
  ArrayEdit edit{std::move(literals), Array<std::int64_t>(std::move(instructions_))};
  *this = {};
  return edit;
}

std::optional<Value> apply_array_edits(std::span<const ArrayEdit* const> edits,
                                       const Value& weaker) {
  const bool fits = weaker.empty() || (!edits.empty() && weaker.is_array() &&
                                       weaker.type() == edits.front()->literals.type());
  if (edits.empty() || !fits) {
    return std::nullopt;
  }
  Application application(weaker.empty() ? 0 : weaker.size());
  for (std::size_t i = edits.size(); i-- > 0;) {
    if (!application.apply(*edits[i], static_cast<std::uint32_t>(i))) {
      return std::nullopt;
    }
  }
  const ValueType type = edits.front()->literals.type();
  switch (type) {
#define TENON_SCALAR(enumerator, type, name, crate_id) \
  case ValueType::enumerator:                          \
    return gather<type>(application.list(), edits, weaker);
#define TENON_NUMBER(enumerator, type, name, crate_id)
#include "tenon/layer/value_types.def"
    default:
      return NumberArrays::layout(type).size == 0
                 ? std::nullopt
                 : gather_numbers(type, application.list(), edits, weaker);
  }
}

Value make_array(ValueType type, std::span<const Value> elements) {
  switch (type) {
#define TENON_SCALAR(enumerator, cpp_type, name, crate_id) \
  case ValueType::enumerator:                              \
    return array_of<cpp_type>(elements);
#define TENON_NUMBER(enumerator, type, name, crate_id)
#include "tenon/layer/value_types.def"
    default:
      return NumberArrays::layout(type).size == 0 ? Value() : array_of_numbers(type, elements);
  }
}

}  // namespace tenon::layer
