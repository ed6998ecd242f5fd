// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Composition ends at a stated count, and on families of arcs that share, branch and lead back its
// work is in proportion to what it makes.
#include <algorithm>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "tenon/compose/cache/index_cache.h"
#include "tenon/compose/dump_index.h"
#include "tenon/compose/prim_index.h"
#include "tenon/formats/text/reader.h"

namespace tenon::compose {
namespace {

const char* const kKinds[] = {"references", "payload", "inherits", "specializes"};

std::string prim(const std::string& name, const std::string& kind, const std::string& targets,
                 const std::string& inside) {
  const std::string arcs = targets.empty() ? "" : " (\n" + kind + " = [" + targets + "]\n)";
  return "def \"" + name + "\"" + arcs + "\n{\n" + inside + "}\n";
}

std::string numbered(const std::string& name, std::size_t number) {
  return name + std::to_string(number);
}

/// Levels of prims; each prim of a level leads to all of the next.
std::string diamonds(const std::string& kind, std::size_t levels, std::size_t branches) {
  std::string text = "#usda 1.0\n";
  for (std::size_t level = 0; level <= levels; ++level) {
    std::string next;
    for (std::size_t i = 0; i < branches && level < levels; ++i) {
      next += (i == 0 ? "</" : ", </") + numbered(numbered("L", level + 1) + "_", i) + ">";
    }
    for (std::size_t i = 0; i < branches; ++i) {
      text += prim(numbered(numbered("L", level) + "_", i), kind, next, "double x = 1\n");
    }
  }
  return text;
}

/// The same between children of prims.
std::string diamonds_below(const std::string& kind, std::size_t levels, std::size_t branches) {
  std::string text = "#usda 1.0\n";
  for (std::size_t level = 0; level <= levels; ++level) {
    std::string next;
    for (std::size_t i = 0; i < branches && level < levels; ++i) {
      next += (i == 0 ? "</" : ", </") + numbered("L", level + 1) + numbered("/c", i) + ">";
    }
    std::string children;
    for (std::size_t i = 0; i < branches; ++i) {
      children += prim(numbered("c", i), kind, next, "double x = 1\n");
    }
    text += prim(numbered("L", level), kind, "", children);
  }
  return text;
}

/// Each level of a prim leads to the same level of the next prim.
std::string chains(const std::string& kind, std::size_t prims, std::size_t depth) {
  std::string text = "#usda 1.0\n";
  for (std::size_t i = 0; i <= prims; ++i) {
    std::string inside;
    for (std::size_t level = depth; level > 0; --level) {
      std::string target;
      if (i < prims) {
        target = "</" + numbered("L", i + 1);
        for (std::size_t step = 0; step < level; ++step) {
          target += "/a";
        }
        target += ">";
      }
      inside = prim("a", kind, target, inside);
    }
    text += prim(numbered("L", i), kind, "", inside);
  }
  return text;
}

/// Children of each prim lead to the other prims.
std::string cycles(const std::string& kind, std::size_t prims, std::size_t children) {
  std::string text = "#usda 1.0\n";
  for (std::size_t i = 0; i < prims; ++i) {
    std::string inside;
    for (std::size_t k = 0; k < children; ++k) {
      inside += prim(numbered("k", k), kind, numbered("</P", (i + k + 1) % prims) + ">", "");
    }
    text += prim(numbered("P", i), kind, "", inside);
  }
  return text;
}

/// A chain of references, each of which brings a class along.
std::string chains_with_classes(const std::string& kind, std::size_t length) {
  std::string text = "#usda 1.0\n";
  for (std::size_t i = 0; i < length; ++i) {
    const std::string reference =
        i + 1 < length ? "references = " + numbered("</R", i + 1) + ">\n" : "";
    text += "def \"" + numbered("R", i) + "\" (\n" + reference + kind + " = " +
            numbered("</_c", i) + ">\n)\n{\n}\nclass \"" + numbered("_c", i) +
            "\"\n{\ndouble x = 1\n}\n";
  }
  return text;
}

std::string wide(const std::string& kind, std::size_t count) {
  std::string text = "#usda 1.0\n";
  std::string targets;
  for (std::size_t i = 0; i < count; ++i) {
    text += prim(numbered("C", i), kind, "", "double x = 1\n");
    targets += (i == 0 ? "</" : ", </") + numbered("C", i) + ">";
  }
  return text + prim("A", kind, targets, "");
}

/// Variants that select variants of further sets, each of which references the next prim.
std::string variant_chains(std::size_t length) {
  std::string text = "#usda 1.0\n";
  for (std::size_t i = 0; i < length; ++i) {
    const std::string next =
        i + 1 < length ? " (\nreferences = " + numbered("</V", i + 1) + ">\n)" : "";
    text += "def \"" + numbered("V", i) +
            "\" (\nvariants = { string v = \"a\" }\nprepend variantSets = \"v\"\n)\n{\n"
            "variantSet \"v\" = {\n\"a\"" +
            next + " {\ndouble x = 1\n}\n\"b\" {\n}\n}\n}\n";
  }
  return text;
}

/// Ten prims, each with ten children that reference the one before: ten times more prims each.
std::string laughs(std::size_t levels) {
  std::string text = "#usda 1.0\n";
  for (std::size_t level = 0; level <= levels; ++level) {
    std::string children;
    for (std::size_t i = 0; i < 10 && level > 0; ++i) {
      children += prim(numbered("c", i), "references", numbered("</L", level - 1) + ">", "");
    }
    text += prim(numbered("L", level), "references", "", children);
  }
  return text;
}

/// Children of a reference, each of which is given another name.
std::string relocations(std::size_t count) {
  std::string pairs;
  std::string children;
  for (std::size_t i = 0; i < count; ++i) {
    pairs += (i == 0 ? "" : ",\n") + numbered("</W/a", i) + ">: " + numbered("</W/b", i) + ">";
    children += prim(numbered("a", i), "references", "", "");
  }
  return "#usda 1.0\n(\nrelocates = {\n" + pairs + "\n}\n)\n" +
         prim("W", "references", "</_r>", "") + prim("_r", "references", "", children);
}

struct Composed {
  std::size_t work = 0;
  std::size_t prims = 0;
  std::size_t nodes = 0;
  std::vector<std::string> exceeded;  // messages
  std::size_t result() const { return prims + nodes; }
};

std::unique_ptr<IndexCache> cache_of(const std::string& text, const ComposeOptions& options) {
  Diagnostics diagnostics;
  auto layer = formats::read_text(text, "scene.usda", diagnostics);
  EXPECT_TRUE(layer) << (layer ? "" : layer.error().to_string());
  const LayerOpener opener = [](const std::string& path, const layer::Layer&) {
    return Result<layer::LayerPtr>(Error(ErrorCode::NotFound, path));
  };
  return std::make_unique<IndexCache>(std::make_shared<const layer::Layer>(*std::move(layer)),
                                      nullptr, opener, options);
}

Composed compose_all(IndexCache& cache, bool ahead = false) {
  Composed composed;
  std::vector<const PrimIndex*> open{&cache.index(Path::absolute_root())};
  while (!open.empty()) {
    if (ahead && composed.prims % 100 == 0) {
      cache.build_below(open, [](const PrimIndex&) { return true; }, 100'000);
    }
    const PrimIndex& index = *open.back();
    open.pop_back();
    ++composed.prims;
    composed.nodes += index.nodes().size();
    for (const Diagnostic& found : index.extras().errors) {
      if (found.rule == "compose.work-exceeded") {
        composed.exceeded.push_back(found.message);
      }
    }
    const std::vector<Token>& names = index.child_names.list();
    for (auto name = names.rbegin(); name != names.rend(); ++name) {
      open.push_back(&cache.child_index(index, *name));
    }
  }
  composed.work = cache.work();
  return composed;
}

Composed compose_text(const std::string& text, const ComposeOptions& options = {}) {
  return compose_all(*cache_of(text, options));
}

ComposeOptions with_work(std::size_t most) {
  ComposeOptions options;
  options.max_work = most;
  options.max_work_per_spec = 0;
  return options;
}

/// Units for each prim and node of the result, not more than `most`.
void expect_linear(const std::string& what, const std::string& text, std::size_t most) {
  const Composed composed = compose_text(text);
  EXPECT_TRUE(composed.exceeded.empty()) << what;
  EXPECT_LE(composed.work, most * composed.result()) << what;
}

TEST(ComposeWork, IsInProportionToTheResult) {
  for (const std::string kind : kKinds) {
    for (const std::size_t levels : {2, 4, 8, 10}) {
      expect_linear("diamonds of " + kind, diamonds(kind, levels, 2), 100);
      expect_linear("diamonds below of " + kind, diamonds_below(kind, levels, 2), 250);
      expect_linear("chains of " + kind, chains(kind, levels, 2), 200);
    }
    for (const std::size_t children : {1, 2, 3}) {
      if (kind != "specializes") {
        expect_linear("cycles of " + kind, cycles(kind, 4, children), 300);
      }
    }
    for (const std::size_t count : {10, 100, 1000}) {
      expect_linear("many " + kind, wide(kind, count), 200);
    }
  }
  for (const std::size_t length : {5, 10, 20, 40}) {
    expect_linear("classes", chains_with_classes("inherits", length), 200);
    expect_linear("variants", variant_chains(length), 1500);
  }
  for (const std::size_t count : {100, 1000, 5000}) {
    expect_linear("relocations", relocations(count), 300);
  }
  for (const std::size_t levels : {1, 2, 3, 4}) {
    expect_linear("laughs", laughs(levels), 200);
  }
}

// Where copies of specializes lose what they come from, prims have children without end.
TEST(ComposeWork, EndsWhereTheResultHasNoEnd) {
  const Composed composed = compose_text(cycles("specializes", 3, 2), with_work(1'000'000));
  ASSERT_EQ(composed.exceeded.size(), 1u);
  EXPECT_LT(composed.work, 1'500'000u);
}

TEST(ComposeWork, ExceededNamesTheLimitAndTheArcThatTookMost) {
  const Composed composed = compose_text(laughs(5), with_work(300'000));
  ASSERT_EQ(composed.exceeded.size(), 1u);
  const std::string& message = composed.exceeded.front();
  EXPECT_NE(message.find("300000 units of work (kComposeWork)"), std::string::npos) << message;
  EXPECT_NE(message.find("the references of @scene.usda@</L1/c"), std::string::npos) << message;
}

TEST(ComposeWork, ExceededStopsWithinOneIndex) {
  const Composed composed = compose_text(diamonds("references", 12, 3), with_work(200'000));
  ASSERT_EQ(composed.exceeded.size(), 1u);
  EXPECT_LT(composed.work, 300'000u);
}

TEST(ComposeWork, LayersAllowForWorkOfTheirSize) {
  ComposeOptions options = with_work(1000);
  options.max_work_per_spec = 1000;
  EXPECT_TRUE(compose_text(wide("references", 1000), options).exceeded.empty());
  options.max_work_per_spec = 0;
  EXPECT_EQ(compose_text(wide("references", 1000), options).exceeded.size(), 1u);
}

TEST(ComposeWork, IsTheSameWhenBuiltAhead) {
  for (const std::size_t most : {20'000, 100'000, 10'000'000}) {
    for (const std::string& text : {laughs(3), chains("references", 8, 2), cycles("inherits", 4, 3),
                                    diamonds("references", 8, 2), relocations(100)}) {
      const auto plain = cache_of(text, with_work(most));
      const auto ahead = cache_of(text, with_work(most));
      const Composed expected = compose_all(*plain);
      const Composed found = compose_all(*ahead, true);
      EXPECT_EQ(found.work, expected.work);
      EXPECT_EQ(found.exceeded, expected.exceeded);
      EXPECT_EQ(found.result(), expected.result());
    }
  }
}

}  // namespace
}  // namespace tenon::compose
