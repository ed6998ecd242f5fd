// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/compose/cache/build_ahead.h"

#include <atomic>
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

const char* const kHand = R"(#usda 1.0
def "X"
{
    def "finger"
    {
    }
}
)";

layer::LayerPtr layer_of(const std::string& name, const std::string& text) {
  Diagnostics diagnostics;
  auto layer = formats::read_text(text, name, diagnostics);
  EXPECT_TRUE(layer) << (layer ? "" : layer.error().to_string());
  return std::make_shared<const layer::Layer>(layer ? *std::move(layer) : layer::Layer(name));
}

class Robot {
 public:
  explicit Robot(std::size_t max_nodes = limits::kCacheNodes) {
    for (const auto& [name, text] :
         std::map<std::string, std::string>{{"root", kRoot}, {"robot", kRobot}}) {
      layers_[name] = layer_of(name, text);
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
  EXPECT_EQ(scene.cache->index(Path::from("/World/Local/a/b")).opinions().size(), 1u);
  EXPECT_EQ(scene.cache->index(Path::from("/World/Local/a/inherited")).opinions().size(), 1u);
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
    EXPECT_EQ(scene.cache->index(Path::from("/World/Robot1/arm")).opinions().size(), 1u);
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

TEST(BuildAhead, SharesWhatEqualReferencesBringIn) {
  constexpr std::size_t kRobots = 8;
  std::string text = "#usda 1.0\n";
  for (std::size_t i = 0; i < kRobots; ++i) {
    text += "def \"R" + std::to_string(i) + "\" (references = @robot@</Robot>) {}\n";
  }
  const layer::LayerPtr robot = layer_of("robot", kRobot);
  const Result<layer::LayerPtr> hand = layer_of("hand", kHand);
  const LayerOpener opener = [&](const std::string& path, const layer::Layer&) {
    return path == "robot" ? Result<layer::LayerPtr>(robot) : hand;
  };
  IndexCache cache(layer_of("root", text), nullptr, opener, {});
  const IndexCache hands(*hand, nullptr, opener, {});
  std::map<Path, const PrimIndex*> known_roots;
  std::vector<const PrimIndex*> roots;
  for (std::size_t i = 0; i < kRobots; ++i) {
    const Path path = Path::absolute_root().child("R" + std::to_string(i));
    roots.push_back(&cache.index(path));
    known_roots[path] = roots.back();
  }

  const ComposeOptions options;
  const MapPool maps;
  std::atomic<std::size_t> followed = 0;  // references to the hand
  KnownIndices known;
  known.options = &options;
  known.root_stack = cache.layer_stack().get();
  known.maps = &maps;
  known.max_work = 1000000;
  known.max_indices = 1000;
  known.index = [&](Path path) {
    const auto found = known_roots.find(path);
    return found == known_roots.end() ? nullptr : found->second;
  };
  known.layer = [&](const std::string&, const layer::Layer&) {
    ++followed;
    return &hand;
  };
  known.stack = [&](const layer::LayerPtr&, const LayerStack*) {
    return hands.layer_stack().get();
  };
  known.enters = [](const PrimIndex&) { return true; };
  const std::vector<IndexBatch> batches = build_ahead(known, roots);
  EXPECT_LE(followed, 2u);  // once by each thread
  std::size_t fingers = 0;
  for (const IndexBatch& batch : batches) {
    EXPECT_TRUE(batch.complete);
    for (const IndexAhead& ahead : batch.indices) {
      fingers += ahead.index.path.name() == "finger" ? 1 : 0;
      EXPECT_EQ(ahead.index.opinions().size(), cache.index(ahead.index.path).opinions().size());
    }
  }
  EXPECT_EQ(fingers, kRobots);
}

}  // namespace
}  // namespace tenon::compose
