// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/crate/sample_layer.h"

namespace tenon::formats::crate {
namespace {

using layer::Value;

template <class T>
void add_scalar(const std::string& name, layer::Spec& spec) {
  if constexpr (!std::is_same_v<T, layer::Opaque>) {
    spec.set(Token(name), sample<T>(3));
    spec.set(Token(name + "Large"), sample<T>(105));
    spec.set(Token(name + "None"), layer::Array<T>());
    spec.set(Token(name + "Few"), sample_array<T>(2, true));
    constexpr int kMany = kIsInteger<T> || kIsReal<T> ? 20 : 4;  // enough to be packed
    spec.set(Token(name + "Whole"), sample_array<T>(kMany, true));
    spec.set(Token(name + "Many"), sample_array<T>(kMany, false));
  }
}

layer::Dictionary sample_dictionary() {
  layer::Dictionary inner;
  inner.items["numbers"] = Value(std::vector<std::int32_t>{1, 2, 3});
  inner.items["nothing"] = Value(layer::Dictionary());
  layer::Dictionary outer;
  outer.items["inner"] = Value(inner);
  outer.items["text"] = Value(std::string("some text"));
  return outer;
}

layer::Spline sample_spline() {
  layer::Spline spline;
  spline.value_type = layer::ValueType::Float;
  spline.pre = {layer::SplineExtrapolation::Sloped, 2.5, {}};
  spline.post.mode = layer::SplineExtrapolation::LoopReset;
  spline.post.boundary = 7;
  layer::SplineKnot knot;
  knot.time = 1;
  knot.value = 2;
  knot.pre_value = 1.5;
  knot.next = layer::SplineInterpolation::Curve;
  knot.post_tangent = {0.5, 3, layer::TangentAlgorithm::Custom};
  knot.custom_data = sample_dictionary();
  spline.knots = {knot};
  knot.time = 4;
  knot.custom_data = {};
  spline.knots.push_back(knot);
  spline.loop = layer::SplineLoop{1, 4, 2, 3, 0.5};
  return spline;
}

void add_edits(layer::Spec& spec) {
  const layer::Reference reference{"./r.usda", Path::from("/R"), {1, 2}, sample_dictionary()};
  const layer::Payload payload{"./p.usda", Path(), {3, 4}};
  const layer::UnregisteredValue text{Value(std::string("new"))};
  const layer::UnregisteredValue other{Value(sample_dictionary())};
  spec.set("tokens", sample_edit<Token>("a", "b"));
  spec.set("strings", sample_edit<std::string>("a", "b"));
  spec.set("paths", sample_edit(Path::from("/A"), Path::from("/A.b[/C].d")));
  spec.set("references", sample_edit(reference, layer::Reference()));
  spec.set("payload", sample_edit(payload, layer::Payload()));
  spec.set("ints", sample_edit<std::int32_t>(1, -2));
  spec.set("int64s", sample_edit<std::int64_t>(1, -2));
  spec.set("uints", sample_edit<std::uint32_t>(1, 2));
  spec.set("uint64s", sample_edit<std::uint64_t>(1, 2));
  spec.set("unknown", other);
  spec.set("unknowns", sample_edit(text, other));
  spec.set("nothing", layer::ListOp<Token>::make_explicit({}));
}

void add_fields(layer::Spec& spec) {
  spec.set("dictionary", sample_dictionary());
  spec.set("pathVector", std::vector<Path>{Path::from("/A"), Path()});
  spec.set("specifier", layer::Specifier::Class);
  spec.set("permission", layer::Permission::Private);
  spec.set("variability", layer::Variability::Uniform);
  spec.set("variantSelection", layer::VariantSelections{{{"set", "one"}, {"other", ""}}});
  spec.set("offsets", std::vector<layer::LayerOffset>{{1, 2}, {}});
  spec.set("block", layer::ValueBlock());
  spec.set("animationBlock", layer::AnimationBlock());
  spec.set("relocates",
           layer::Relocates{{{Path::from("/A"), Path::from("/B")}, {Path::from("/C"), Path()}}});
  spec.set("spline", sample_spline());
  spec.set("timeSamples", layer::TimeSamples{{1, 2, 3.5},
                                             {Value(1.5), Value(layer::ValueBlock()),
                                              Value(sample_array<double>(30, false))}});
  spec.set("primOrder", std::vector<Token>{"a", "b"});
  spec.set("subLayers", std::vector<std::string>{"a.usda", "b.usda"});
}

}  // namespace

layer::Layer layer_of_all_types() {
  layer::Layer layer("sample");
  using namespace layer;  // NOLINT(google-build-using-namespace): the table names its types
  layer::Spec& prim = layer.create(Path::from("/World"), SpecKind::Prim);
#define TENON_SCALAR(enumerator, type, name, crate_id) add_scalar<type>(name, prim);
#include "tenon/layer/value_types.def"
  layer::Spec& fields = layer.create(Path::from("/World.fields"), SpecKind::Attribute);
  add_edits(fields);
  add_fields(fields);
  return layer;
}

}  // namespace tenon::formats::crate
