// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Properties are written in dictionary order, variants by name, metadata by field and prims in the
// order of the layer, so the text does not show how the layer was made. One attribute becomes
// several statements: a declaration where it says more than the others do, then samples, a spline
// and connections. The version in the header is known when all is written and is put in then. The
// text of a prim depends on nothing that was written before it, except the empty line in front.
// That is why two halves can be written side by side and joined.
#include "tenon/formats/text/write/writer.h"

#include <algorithm>
#include <span>

#include "tenon/base/limits/limits.h"
#include "tenon/base/parallel.h"
#include "tenon/base/text/text_number.h"
#include "tenon/formats/text/write/list_writer.h"
#include "tenon/formats/text/write/metadata_writer.h"
#include "tenon/formats/text/write/spline_writer.h"
#include "tenon/formats/text/write/value_text.h"
#include "tenon/layer/written_type_name.h"

namespace tenon::formats {
namespace text {
namespace {

using layer::Layer;
using layer::Spec;
using layer::SpecKind;
using layer::Value;
using layer::Variability;
namespace fields = layer::fields;

/// What the spec of an attribute says, from one walk over its fields; nullptr, false: nothing.
struct AttributeParts {
  explicit AttributeParts(const Spec& spec) {
    for (const layer::Field& field : spec.fields()) {
      if (field.name == fields::typeName) {
        if (const auto* name = field.value.get<Token>()) {
          type_name = *name;
        }
      } else if (field.name == fields::default_value) {
        value = &field.value;
      } else if (field.name == fields::variability) {
        const auto* variability = field.value.get<Variability>();
        is_uniform = variability != nullptr && *variability == Variability::Uniform;
      } else if (field.name == fields::custom) {
        const auto* flag = field.value.get<bool>();
        is_custom = flag != nullptr && *flag;
      } else if (field.name == fields::timeSamples) {
        samples = field.value.get<layer::TimeSamples>();
      } else if (field.name == fields::spline) {
        spline = field.value.get<layer::Spline>();
      } else if (field.name == fields::connectionPaths) {
        connections = field.value.get<layer::ListOp<Path>>();
      } else {
        has_metadata = has_metadata || is_metadata(field, SpecKind::Attribute);
      }
    }
  }
  /// True when something has to be declared before, or instead of, samples and connections.
  bool needs_declaration() const {
    return value != nullptr || is_custom || has_metadata ||
           (samples == nullptr && spline == nullptr && connections == nullptr);
  }

  Token type_name;
  const Value* value = nullptr;
  const layer::TimeSamples* samples = nullptr;
  const layer::Spline* spline = nullptr;
  const layer::ListOp<Path>* connections = nullptr;
  bool is_uniform = false;
  bool is_custom = false;
  bool has_metadata = false;
};

class LayerWriter {
 public:
  explicit LayerWriter(const Layer& layer) : layer_(layer) {}

  /// A part of the text, written at the left margin.
  template <class Append>
  std::string part(Append append) {
    append(*this);
    return std::move(out_);
  }

  std::string write() {
    constexpr std::string_view kHeader = "#usda 1.";
    out_.reserve(kUsualBytes * layer_.spec_count());
    out_ += kHeader;
    out_ += "0\n";
    const Spec& root = layer_.root();
    append_layer_metadata(out_, root);
    append_order(root, fields::primOrder, "\nreorder rootPrims = ");
    append_children(Path::absolute_root(), Layer::children(root, fields::primChildren), 0, false);
    out_ += '\n';
    out_.replace(kHeader.size(), 1, std::to_string(minor_version_));
    return std::move(out_);
  }

 private:
  /// A reorder statement, unless it names fewer than two.
  void append_order(const Spec& spec, Token field, const std::string& start) {
    const std::vector<Token>& names = Layer::children(spec, field);
    if (names.size() > 1) {
      out_ += start;
      append_names(out_, names);
      out_ += '\n';
    }
  }

 public:
  void append_prim(Path path, const Spec& spec, std::size_t indent) {
    const auto specifier = spec.get_or(fields::specifier, layer::Specifier::Over);
    constexpr const char* kWords[] = {"def ", "over ", "class "};
    append_indent(out_, indent);
    out_ += kWords[static_cast<std::size_t>(specifier)];
    const Token type = spec.get_or(fields::typeName, Token());
    if (!type.empty() && type != "__AnyType__") {
      out_ += type.view();
      out_ += ' ';
    }
    append_quoted(out_, path.name().view());
    add_metadata(spec, indent);
    out_ += '\n';
    append_indent(out_, indent);
    out_ += "{\n";
    append_body(path, spec, indent);
    append_indent(out_, indent);
    out_ += "}\n";
  }

  void append_property(Path path) {
    if (const Spec* spec = layer_.find(path)) {
      spec->kind == SpecKind::Attribute ? append_attribute(path.name(), *spec, 0)
                                        : append_relationship(path.name(), *spec, 0);
    }
  }

  void append_variant_set(Path path, std::size_t indent) {
    const std::vector<Token> variants = sorted(layer_.children(path, fields::variantChildren));
    if (variants.empty()) {
      return;
    }
    append_indent(out_, indent);
    out_ += "variantSet " + quoted_text(path.name().view()) + " = {\n";
    for (const Token& variant : variants) {
      append_variant(path.parent().variant_selection(path.name(), variant), indent + 1);
    }
    append_indent(out_, indent);
    out_ += "}\n";
  }

  void append_variant(Path path, std::size_t indent) {
    const Spec* spec = layer_.find(path);
    if (spec == nullptr) {
      return;
    }
    append_indent(out_, indent);
    out_ += quoted_text(path.variant().view());
    add_metadata(*spec, indent);
    out_ += " {\n";
    append_body(path, *spec, indent);
    out_ += '\n';
    append_indent(out_, indent);
    out_ += "}\n";
  }

 private:
  /// The part in the braces of a prim or a variant. Recursion follows the path.
  void append_body(Path path, const Spec& spec, std::size_t indent) {
    if (path.depth() > limits::kPathElements) {
      return;
    }
    const std::string start(4 * (indent + 1), ' ');
    append_order(spec, fields::propertyOrder, start + "reorder properties = ");
    append_order(spec, fields::primOrder, start + "reorder nameChildren = ");
    const bool has_properties = append_properties(path, spec, indent + 1);
    append_children(path, Layer::children(spec, fields::primChildren), indent + 1, !has_properties);
    append_variant_sets(path, spec, indent + 1);
  }

  /// Prims with an empty line before each, except before the `first` of a block. The children of
  /// one prim of a large layer are written in two halves side by side.
  void append_children(Path parent, std::span<const Token> names, std::size_t indent, bool first) {
    constexpr std::size_t kWorthHalving = 2000;  // specs
    constexpr std::size_t kLikelyEven = 8;       // children
    if (is_halved_ || names.size() < kLikelyEven || layer_.spec_count() < kWorthHalving ||
        usable_processors() < 2) {
      return append_each(parent, names, indent, first);
    }
    is_halved_ = true;
    LayerWriter rest(layer_);
    rest.is_halved_ = true;
    rest.out_.reserve(kUsualBytes * layer_.spec_count() / 2);
    const std::size_t before = out_.size();
    const std::size_t middle = names.size() / 2;
    run_both([&] { rest.append_each(parent, names.subspan(middle), indent, false); },
             [&] { append_each(parent, names.first(middle), indent, first); });
    const bool starts = first && out_.size() == before && !rest.out_.empty();
    out_ += std::string_view(rest.out_).substr(starts ? 1 : 0);
    need(rest.minor_version_);
  }

  void append_each(Path parent, std::span<const Token> names, std::size_t indent, bool first) {
    for (const Token& name : names) {
      const Path path = parent.child(name);
      if (const Spec* prim = layer_.find(path)) {
        out_ += first ? "" : "\n";
        first = false;
        append_prim(path, *prim, indent);
      }
    }
  }

  bool append_properties(Path path, const Spec& spec, std::size_t indent) {
    sort_properties(Layer::children(spec, fields::properties));
    bool any = false;
    for (const Token& name : sorted_properties_) {
      const Spec* property = layer_.find(path.property(name));
      if (property == nullptr) {
        continue;
      }
      any = true;
      if (property->kind == SpecKind::Attribute) {
        append_attribute(name, *property, indent);
      } else {
        append_relationship(name, *property, indent);
      }
    }
    return any;
  }

  /// Puts `names` in the order of writing; most prims have those of the prim before.
  void sort_properties(const std::vector<Token>& names) {
    if (names == listed_properties_) {
      return;
    }
    listed_properties_ = names;
    sorted_properties_ = names;
    std::sort(sorted_properties_.begin(), sorted_properties_.end(),
              [](Token a, Token b) { return dictionary_less(a.view(), b.view()); });
  }

  void append_variant_sets(Path path, const Spec& spec, std::size_t indent) {
    for (const Token& set_name : Layer::children(spec, fields::variantSetChildren)) {
      const Path set = path.variant_selection(set_name, Token());
      if (layer_.has(set)) {
        append_variant_set(set, indent);
      }
    }
  }

  static std::vector<Token> sorted(std::vector<Token> names) {
    std::sort(names.begin(), names.end());
    return names;
  }

  // Attributes

  void append_attribute(Token name, const Spec& spec, std::size_t indent) {
    const AttributeParts parts(spec);
    std::string& declaration = declaration_;
    declaration = parts.is_uniform ? "uniform " : "";
    declaration += layer::written_type_name(parts.type_name).view();
    declaration += ' ';
    declaration += name.view();
    if (parts.needs_declaration()) {
      append_indent(out_, indent);
      out_ += parts.is_custom ? "custom " : "";
      out_ += declaration;
      if (parts.value != nullptr) {
        out_ += " = ";
        append_value_text(out_, *parts.value);
        need(minor_version_of(*parts.value));
      }
      if (parts.has_metadata) {
        add_metadata(spec, indent);
      }
      out_ += '\n';
    }
    if (parts.samples != nullptr) {
      append_time_samples(declaration, *parts.samples, indent);
    }
    if (parts.spline != nullptr) {
      append_spline_statement(declaration, *parts.spline, indent);
    }
    if (parts.connections != nullptr) {
      for_each_edit(*parts.connections, [&](const char* word, const std::vector<Path>& paths) {
        append_indent(out_, indent);
        out_ += word + declaration + ".connect = ";
        append_targets(paths, indent);
        out_ += '\n';
      });
    }
  }

  void append_spline_statement(const std::string& declaration, const layer::Spline& spline,
                               std::size_t indent) {
    need(minor_version_of(spline));
    append_indent(out_, indent);
    out_ += declaration + ".spline = {\n";
    append_spline(out_, spline, indent);
    append_indent(out_, indent);
    out_ += "}\n";
  }

  void append_time_samples(const std::string& declaration, const layer::TimeSamples& samples,
                           std::size_t indent) {
    append_indent(out_, indent);
    out_ += declaration + ".timeSamples = {\n";
    for (std::size_t i = 0; i < samples.size(); ++i) {
      append_indent(out_, indent + 1);
      append_layer_text(out_, samples.times[i]);
      out_ += ": ";
      append_value_text(out_, samples.values[i]);
      need(minor_version_of(samples.values[i]));
      out_ += ",\n";
    }
    append_indent(out_, indent);
    out_ += "}\n";
  }

  /// None, one path, or a list with one path per line.
  void append_targets(const std::vector<Path>& paths, std::size_t indent) {
    if (paths.size() < 2) {
      out_ += paths.empty() ? "None" : '<' + paths.front().str() + '>';
      return;
    }
    out_ += "[\n";
    for (const Path& path : paths) {
      append_indent(out_, indent + 1);
      out_ += '<' + path.str() + ">,\n";
    }
    append_indent(out_, indent);
    out_ += ']';
  }

  // Relationships

  void append_relationship(Token name, const Spec& spec, std::size_t indent) {
    const bool varying =
        spec.get_or(fields::variability, Variability::Uniform) == Variability::Varying;
    const std::string declaration = (varying ? "varying rel " : "rel ") + name.str();
    const bool custom = spec.get_or(fields::custom, false);
    const auto* targets = spec.get<layer::ListOp<Path>>(fields::targetPaths);
    const bool is_explicit = targets != nullptr && targets->is_explicit;
    const bool has_edits = targets != nullptr && !is_explicit && !targets->empty();
    if (has_metadata(spec) || is_explicit || custom || !has_edits) {
      append_indent(out_, indent);
      out_ += (custom ? "custom " : "") + declaration;
      if (is_explicit) {
        out_ += " = ";
        append_targets(targets->explicit_items, indent);
      }
      add_metadata(spec, indent);
      out_ += '\n';
    }
    if (has_edits) {
      for_each_edit(*targets, [&](const char* word, const std::vector<Path>& paths) {
        append_indent(out_, indent);
        out_ += word + declaration + " = ";
        append_targets(paths, indent);
        out_ += '\n';
      });
    }
    if (const Value* value = spec.find(fields::default_value)) {
      append_indent(out_, indent);
      out_ += declaration + ".default = ";
      append_value_text(out_, *value);
      append_indent(out_, indent);  // OpenUSD's blanks
      out_ += '\n';
    }
  }

  void add_metadata(const Spec& spec, std::size_t indent) {
    append_metadata(out_, spec, indent);
    for (const layer::Field& field : spec.fields()) {
      if (field.value.holds<layer::Dictionary>()) {
        need(minor_version_of(field.value));
      }
    }
  }

  void need(int minor_version) { minor_version_ = std::max(minor_version_, minor_version); }

  static constexpr std::size_t kUsualBytes = 128;  // of a spec, at most

  const Layer& layer_;
  std::string out_;
  bool is_halved_ = false;                // children of some prim are written side by side
  std::string declaration_;               // kept to spare allocations
  std::vector<Token> listed_properties_;  // of the last prim
  std::vector<Token> sorted_properties_;
  int minor_version_ = 0;  // the lowest that has all that is written
};

}  // namespace
}  // namespace text

std::string text::part_text(const layer::Layer& layer, Path path) {
  const layer::Spec* const spec = layer.find(path);
  if (spec == nullptr) {
    return {};
  }
  return LayerWriter(layer).part([&](LayerWriter& writer) {
    if (path.is_property()) {
      writer.append_property(path);
    } else if (spec->kind == layer::SpecKind::VariantSet) {
      writer.append_variant_set(path, 0);
    } else if (path.is_variant_selection()) {
      writer.append_variant(path, 0);
    } else {
      writer.append_prim(path, *spec, 0);
    }
  });
}

std::string write_text(const layer::Layer& layer) { return text::LayerWriter(layer).write(); }

}  // namespace tenon::formats
