// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/compose/cache/build_ahead.h"

#include <map>
#include <string>

#include <gtest/gtest.h>

#include "tenon/compose/cache/index_cache.h"
#include "tenon/compose/dump_index.h"
#include "tenon/formats/text/reader.h"

namespace tenon::compose {
namespace {

const char* const kRoot = R"(#usda 1.0
def "World"
{
    def "Robot1" (
        references = @robot@</Robot>
    )
    {
    }
    def "Robot2" (
        references = @robot@</Robot> (offset = 3)
        variants = { string kind = "b" }
    )
    {
        over "arm"
        {
            rel to = </World/Robot1>
        }
    }
    def "Lost" (
        references = @lost@</Lost>
    )
    {
    }
    def "Local"
    {
        def "a" (
            inherits = </World/_class>
        )
        {
            def "b"
            {
            }
        }
    }
    class "_class"
    {
        def "inherited"
        {
        }
    }
    def "Instance" (
        instanceable = true
        references = @robot@</Robot>
    )
    {
    }
}
)";

const char* const kRobot = R"(#usda 1.0
def "Robot" (
    prepend variantSets = "kind"
    variants = { string kind = "a" }
)
{
    def "arm"
    {
        def "hand" (
            references = @nowhere@</X>
        )
        {
        }
    }
    variantSet "kind" = {
        "a" {
            def "of_a"
            {
            }
        }
        "b" {
            def "of_b"
            {
            }
        }
    }
}
)";

class Robot {
 public:
  explicit Robot(std::size_t max_nodes = limits::kCacheNodes) {
    for (const auto& [name, text] :
         std::map<std::string, std::string>{{"root", kRoot}, {"robot", kRobot}}) {
      Diagnostics diagnostics;
      auto layer = formats::read_text(text, name, diagnostics);
      EXPECT_TRUE(layer) << (layer ? "" : layer.error().to_string());
      layers_[name] =
          std::make_shared<const layer::Layer>(layer ? *std::move(layer) : layer::Layer(name));
    }
    const LayerOpener opener = [this](const std::string& path,
                                      const layer::Layer&) -> Result<layer::LayerPtr> {
      ++opened;
      const auto found = layers_.find(path);
      return found == layers_.end() ? Result<layer::LayerPtr>(Error(ErrorCode::NotFound, path))
                                    : Result<layer::LayerPtr>(found->second);
    };
    ComposeOptions options;
    options.max_nodes = max_nodes;
    cache = std::make_unique<IndexCache>(layers_.at("root"), nullptr, opener, options);
  }

  bool build_below(const std::vector<const char*>& paths, std::size_t most = 1000) {
    std::vector<const PrimIndex*> roots;
    for (const char* path : paths) {
      roots.push_back(&cache->index(Path::from(path)));
    }
    return cache->build_below(roots, [](const PrimIndex&) { return true; }, most);
  }

  /// All that can be seen, everything asked for in the same order.
  std::string dump() {
    const LayerLabel label = [](const layer::Layer& layer) { return layer.identifier(); };
    std::string text = dump_indices(*cache, label);
    for (const MissingArc& arc : cache->missing_arcs()) {
      text += arc.layer + " " + arc.prim.str() + " " + arc.path + "\n";
    }
    return text;
  }

  std::unique_ptr<IndexCache> cache;
  std::size_t opened = 0;

 private:
  std::map<std::string, layer::LayerPtr> layers_;
};

TEST(BuildAhead, BuildsWhatNeedsNoFurtherLayer) {
  Robot scene;
  EXPECT_TRUE(scene.build_below({"/World/Local", "/World/_class"}));
  const std::size_t opened = scene.opened;
  EXPECT_EQ(scene.cache->index(Path::from("/World/Local/a/b")).opinions.size(), 1u);
  EXPECT_EQ(scene.cache->index(Path::from("/World/Local/a/inherited")).opinions.size(), 1u);
  EXPECT_EQ(scene.opened, opened);
}

TEST(BuildAhead, StopsAtTheLimit) {
  Robot scene;
  EXPECT_FALSE(scene.build_below({"/World/Local", "/World/_class"}, 1));
  EXPECT_EQ(scene.dump(), Robot().dump());
}

TEST(BuildAhead, OpensNothing) {
  Robot scene;
  EXPECT_FALSE(scene.build_below({"/World"}));
  EXPECT_EQ(scene.opened, 0u);
  EXPECT_TRUE(scene.cache->missing_arcs().empty());
}

TEST(BuildAhead, ChangesNoAnswer) {
  Robot plain;
  const std::string expected = plain.dump();
  const std::vector<const char*> asked[] = {
      {"/World"},
      {"/"},
      {"/World/Robot1"},
      {"/World/Local", "/World/Robot2"},
      {"/World/Lost", "/World/Instance", "/World/Robot2", "/World/Robot1"}};
  for (const std::vector<const char*>& roots : asked) {
    Robot scene;
    // In the order of the dump, which decides what is found missing first.
    scene.build_below(roots);
    EXPECT_EQ(scene.cache->index(Path::from("/World/Robot1/arm")).opinions.size(), 1u);
    scene.build_below({"/World"});
    EXPECT_EQ(scene.dump(), expected);
  }
}

TEST(BuildAhead, KeepsToTheLimitOfNodes) {
  Robot plain(4);
  const std::string expected = plain.dump();
  EXPECT_NE(expected, Robot().dump());
  Robot scene(4);
  EXPECT_FALSE(scene.build_below({"/World/Local", "/World/_class"}));
  EXPECT_EQ(scene.dump(), expected);
}

}  // namespace
}  // namespace tenon::compose
