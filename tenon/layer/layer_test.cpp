// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/layer/layer.h"

#include <map>
#include <random>

#include <gtest/gtest.h>

namespace tenon::layer {
namespace {

TEST(Layer, StartsWithItsRoot) {
  const Layer layer("a.usda");
  EXPECT_EQ(layer.identifier(), "a.usda");
  EXPECT_EQ(layer.root().kind, SpecKind::PseudoRoot);
  EXPECT_EQ(layer.spec_count(), 1u);
  EXPECT_TRUE(layer.default_prim().empty());
  EXPECT_TRUE(layer.sublayers().empty());
  EXPECT_EQ(layer.time_codes_per_second(), 24.0);
}

TEST(Layer, SpecsAreFoundAfterGrowthAndErasure) {
  Layer layer("a.usda");
  std::vector<Path> paths;
  for (int i = 0; i < 1000; ++i) {
    paths.push_back(Path::absolute_root().child("P" + std::to_string(i)));
    Spec& spec = layer.create(paths.back(), SpecKind::Prim);
    spec.set(fields::displayName, Value(std::to_string(i)));
    EXPECT_EQ(&layer.create(paths.back(), SpecKind::Attribute), &spec);
  }
  for (std::size_t i = 0; i < paths.size(); i += 2) {
    layer.erase(paths[i]);
  }
  EXPECT_EQ(layer.spec_count(), 501u);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const Spec* spec = layer.find(paths[i]);
    ASSERT_EQ(spec != nullptr, i % 2 == 1);
    if (spec != nullptr) {
      EXPECT_EQ(spec->get_or(fields::displayName, std::string()), std::to_string(i));
    }
  }
  layer.create(paths[0], SpecKind::Prim);
  EXPECT_TRUE(layer.has(paths[0]));
  EXPECT_FALSE(layer.find(paths[0])->has(fields::displayName));
}

TEST(Layer, PropertiesAreFoundWhereverTheyWereMade) {
  for (const std::size_t count : {std::size_t{3}, 2 * Layer::kShortList}) {
    Layer layer("a.usda");
    std::vector<Token> names;
    for (std::size_t i = 0; i < count; ++i) {
      names.push_back(Token("p" + std::to_string(i)));
    }
    const Path in_order = Path::from("/InOrder");
    const Path reversed = Path::from("/Reversed");
    for (const Path prim : {in_order, reversed}) {
      layer.create(prim, SpecKind::Prim).set(fields::properties, Value(names));
      for (std::size_t i = 0; i < count; ++i) {
        layer.create(prim.property(names[prim == in_order ? i : count - 1 - i]),
                     SpecKind::Attribute);
      }
    }
    layer.erase(reversed.property(names[0]));
    for (const Path prim : {in_order, reversed}) {
      const Spec& owner = *layer.find(prim);
      for (const Token name : names) {
        const Layer::Entry* entry = layer.find_property(owner, prim, name);
        ASSERT_EQ(entry == nullptr, prim == reversed && name == names[0]);
        if (entry != nullptr) {
          EXPECT_EQ(entry->path, prim.property(name));
          EXPECT_EQ(&entry->spec, layer.find(prim.property(name)));
        }
      }
      EXPECT_EQ(layer.find_property(owner, prim, "none"), nullptr);
    }
  }
}

/// Whatever is made and erased in whatever order is found as in a plain map.
TEST(Layer, FindsWhatAMapFinds) {
  std::mt19937 dice(7);
  const auto below = [&](std::uint32_t count) {
    return static_cast<std::uint32_t>(dice() % count);
  };
  for (int round = 0; round < 40; ++round) {
    Layer layer("a.usda");
    std::map<Path, std::uint32_t> known;
    std::uint32_t made = 0;
    for (int step = 0; step < 400; ++step) {
      const Path prim = Path::absolute_root().child("P" + std::to_string(below(6)));
      const Path property = prim.property("p" + std::to_string(below(50)));
      const std::uint32_t what = below(10);
      if (what == 0) {  // a prim with a run behind it, longer than a run may be at times
        layer.create(prim, SpecKind::Prim);
        known.try_emplace(prim, layer.find(prim)->line);
        for (std::uint32_t i = 0, count = below(45); i < count; ++i) {
          const Path next = prim.property("p" + std::to_string(i));
          Spec* const fresh = layer.create_new(next, SpecKind::Attribute);
          ASSERT_EQ(fresh == nullptr, known.count(next) == 1) << next.str();
          if (fresh != nullptr) {
            fresh->set_place(++made, 1);
            known[next] = made;
          }
        }
      } else if (what < 6) {
        const Path path = what < 3 ? prim : property;
        if (known.try_emplace(path, made + 1).second) {
          layer.create(path, what < 3 ? SpecKind::Prim : SpecKind::Attribute).set_place(++made, 1);
        }
      } else {
        const Path path = what == 6 ? prim : property;
        layer.erase(path);
        known.erase(path);
      }
    }
    Layer other("b.usda");
    other.take_missing(Layer(layer));
    ASSERT_EQ(layer.spec_count(), known.size() + 1);
    for (std::uint32_t p = 0; p < 6; ++p) {
      const Path prim = Path::absolute_root().child("P" + std::to_string(p));
      for (std::uint32_t i = 0; i <= 50; ++i) {
        const Path path = i == 50 ? prim : prim.property("p" + std::to_string(i));
        const auto found = known.find(path);
        for (const Layer* each : {&layer, &other}) {
          const Spec* const spec = each->find(path);
          ASSERT_EQ(spec != nullptr, found != known.end()) << path.str();
          EXPECT_TRUE(spec == nullptr || spec->line == found->second) << path.str();
        }
      }
    }
  }
}

TEST(Layer, ChildrenAndLayerFieldsAreRead) {
  Layer layer("a.usda");
  Spec& root = layer.root();
  root.set(fields::primChildren, Value(std::vector<Token>{"B", "A"}));
  root.set(fields::defaultPrim, Value(Token("B")));
  root.set(fields::subLayers, Value(std::vector<std::string>{"x.usda", "y.usda"}));
  root.set(fields::subLayerOffsets, Value(std::vector<LayerOffset>{{1, 2}}));
  root.set(fields::framesPerSecond, Value(30.0));
  EXPECT_EQ(layer.children(Path::absolute_root(), fields::primChildren),
            (std::vector<Token>{"B", "A"}));
  EXPECT_TRUE(layer.children(Path::from("/Q"), fields::primChildren).empty());
  EXPECT_EQ(layer.default_prim(), "B");
  EXPECT_EQ(layer.sublayers().size(), 2u);
  EXPECT_EQ(layer.sublayer_offset(0), (LayerOffset{1, 2}));
  EXPECT_TRUE(layer.sublayer_offset(1).is_identity());
  EXPECT_EQ(layer.time_codes_per_second(), 30.0);
  root.set(fields::timeCodesPerSecond, Value(48.0));
  EXPECT_EQ(layer.time_codes_per_second(), 48.0);
}

TEST(Layer, CopiesAreIndependent) {
  Layer layer("a.usda");
  layer.create(Path::from("/A"), SpecKind::Prim).set(fields::active, Value(true));
  Layer copy = layer;
  copy.find(Path::from("/A"))->set(fields::active, Value(false));
  copy.create(Path::from("/B"), SpecKind::Prim);
  EXPECT_TRUE(layer.find(Path::from("/A"))->get_or(fields::active, false));
  EXPECT_FALSE(layer.has(Path::from("/B")));
}

TEST(Spec, FieldsAreSetReplacedAndErased) {
  Spec spec;
  spec.set(fields::kind, Value(Token("a")));
  spec.set(fields::kind, Value(Token("b")));
  spec.append(fields::active, Value(false));
  EXPECT_EQ(spec.fields().size(), 2u);
  EXPECT_EQ(spec.get_or(fields::kind, Token()), "b");
  EXPECT_EQ(spec.get<double>(fields::kind), nullptr);
  spec.erase(fields::kind);
  EXPECT_FALSE(spec.has(fields::kind));
}

TEST(Spec, SharedFieldsChangeInOneSpecOnly) {
  Spec first;
  first.append(fields::kind, Value(Token("a")));
  first.append(fields::active, Value(true));
  Spec second;
  second.set_field_list(first.field_list());
  EXPECT_TRUE(second.field_list().is_same(first.field_list()));
  Spec third = second;
  second.set(fields::kind, Value(Token("b")));
  third.erase(fields::kind);
  third.append(fields::comment, Value(std::string("c")));
  EXPECT_EQ(first.get_or(fields::kind, Token()), "a");
  EXPECT_EQ(first.fields().size(), 2u);
  EXPECT_EQ(second.get_or(fields::kind, Token()), "b");
  EXPECT_TRUE(second.get_or(fields::active, false));
  EXPECT_FALSE(third.has(fields::kind));
  EXPECT_EQ(third.fields().size(), 2u);
}

TEST(Layer, FindsSpecsWhosePathsWereMadeInAnyOrder) {
  std::vector<Path> paths;
  for (int i = 0; i < 2000; ++i) {
    paths.push_back(Path::from("/order/p" + std::to_string(i)));
  }
  Layer layer("a.usda");
  layer.reserve(10);
  for (std::size_t i = 0; i < paths.size(); i += 2) {
    layer.create(paths[i], SpecKind::Prim).set_place(static_cast<std::uint32_t>(i), 1);
  }
  layer.erase(paths[10]);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const Spec* spec = layer.find(paths[i]);
    ASSERT_EQ(spec != nullptr, i % 2 == 0 && i != 10) << i;
    EXPECT_EQ(spec == nullptr ? i : spec->line, i);
  }
  layer.create(paths[10], SpecKind::Attribute);
  EXPECT_EQ(layer.find(paths[10])->kind, SpecKind::Attribute);
}

}  // namespace
}  // namespace tenon::layer
