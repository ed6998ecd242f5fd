// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage/stage.h"

#include <map>

#include <gtest/gtest.h>

#include "tenon/compose/prim_index.h"
#include "tenon/stage/collections/collection.h"
#include "tenon/stage/collections/material_binding.h"
#include "tenon/stage/flatten/flatten.h"
#include "tenon/stage/stage_units.h"
#include "tenon/stage/test_stage.h"
#include "tenon/stage/transform_at.h"

namespace tenon::stage {
namespace {

TEST(Stage, FlagsFollowSpecifiersActivityAndKinds) {
  const Stage stage = open_text(R"(
def "A" (kind = "group") { def "B" (kind = "component") { def "C" (kind = "component") {} } }
class "K" { def "Inside" {} }
over "O" { def "D" {} }
def "Off" (active = false) { def "Gone" {} }
)");
  EXPECT_TRUE(at(stage, "/A").is_group());
  EXPECT_TRUE(at(stage, "/A/B").is_model());
  EXPECT_FALSE(at(stage, "/A/B/C").is_model());
  EXPECT_TRUE(at(stage, "/K/Inside").is_abstract());
  EXPECT_TRUE(at(stage, "/K").is_defined());
  EXPECT_FALSE(at(stage, "/O/D").is_defined());
  EXPECT_FALSE(at(stage, "/Off").is_active());
  EXPECT_FALSE(at(stage, "/Off/Gone").is_valid());
}

TEST(Stage, AClassThatComesOverAnInheritIsWeakerThanADef) {
  const Stage stage = open_text(R"(
class "C" {}
def "D" {}
over "A" (inherits = </C>; references = </D>) {}
over "B" (references = </C>) {}
over "Deep" (inherits = </K>; references = </D>) {}
over "K" (references = </C>) {}
over "S" (specializes = [</C>, </D>]) {}
)");
  EXPECT_EQ(at(stage, "/A").specifier(), layer::Specifier::Def);
  EXPECT_EQ(at(stage, "/Deep").specifier(), layer::Specifier::Def);
  EXPECT_EQ(at(stage, "/S").specifier(), layer::Specifier::Class);
  EXPECT_EQ(at(stage, "/B").specifier(), layer::Specifier::Class);
}

TEST(Stage, InstancesShareAPrototypeAndShowProxies) {
  const Stage stage = open_text(R"(
def "R" {
    double z = 1
    def "C" { double y = 1
        rel up = </R>
        rel outside = </Other>
    }
}
def "A" (instanceable = true; references = </R>) { over "C" { double y = 3 } }
def "B" (instanceable = true; references = </R>) { double z = 2 }
)");
  ASSERT_TRUE(at(stage, "/A").is_instance());
  EXPECT_EQ(at(stage, "/A").prototype(), at(stage, "/B").prototype());
  EXPECT_EQ(stage.prototypes().size(), 1u);
  const Prim proxy = at(stage, "/B/C");
  ASSERT_TRUE(proxy.is_instance_proxy());
  EXPECT_EQ(proxy.path(), Path::from("/B/C"));
  EXPECT_EQ(proxy.parent(), at(stage, "/B"));
  EXPECT_EQ(at(stage, "/A/C").attribute("y").get_as<double>(), 1);
  EXPECT_EQ(at(stage, "/B").attribute("z").get_as<double>(), 2);
  EXPECT_EQ(proxy.relationship("up").targets(), std::vector{Path::from("/B")});
  EXPECT_EQ(proxy.relationship("outside").targets(), std::vector{Path::from("/Other")});
  EXPECT_TRUE(at(stage, "/A").prototype().authored_property_names().empty());
}

TEST(Stage, AMaskKeepsAncestorsAndDescendants) {
  StageOptions options;
  options.mask.insert(Path::from("/A/B"));
  const Stage stage =
      open_text({{"root", R"(def "A" { def "B" { def "C" {} } def "X" {} } def "Y" {})"}}, options);
  EXPECT_TRUE(at(stage, "/A/B/C").is_valid());
  EXPECT_FALSE(at(stage, "/A/X").is_valid());
  EXPECT_FALSE(at(stage, "/Y").is_valid());
}

TEST(Attribute, SamplesAreExactAtTheirTimesThroughOffsets) {
  const Stage stage =
      open_text({{"root", "(subLayers = [@sub@ (offset = -3; scale = 0.3125)])"},
                 {"sub", "def \"A\" { double t.timeSamples = { 13: 8, 17: 21 } }"}});
  const Attribute t = at(stage, "/A").attribute("t");
  EXPECT_EQ(t.time_samples(), (std::vector{1.0625, 2.3125}));
  EXPECT_EQ(t.get_as<double>(1.0625), 8);
}

TEST(Attribute, SamplesComeBeforeDefaultsLayerByLayer) {
  const Stage stage = open_text({{"root", R"((subLayers = [@sub@ (offset = 10; scale = 2)])
over "A" {
    double blocked = None
    double animated = AnimationBlock
    double strong.timeSamples = { 1: 2, 3: None, 5: 6 }
})"},
                                 {"sub", R"(def "A" {
    double moved.timeSamples = { 0: 1, 10: 5 }
    double blocked = 4
    double blocked.timeSamples = { 0: 7 }
    double animated = 3
    double animated.timeSamples = { 0: 7 }
    double strong = 3
    timecode when = 5
})"}});
  const Prim a = at(stage, "/A");
  EXPECT_EQ(a.attribute("moved").time_samples(), (std::vector<double>{10, 30}));
  EXPECT_EQ(a.attribute("moved").get_as<double>(20), 3);
  EXPECT_EQ(a.attribute("moved").get_as<double>(0), 1);
  EXPECT_TRUE(a.attribute("moved").get().empty());
  EXPECT_TRUE(a.attribute("blocked").is_blocked());
  EXPECT_TRUE(a.attribute("blocked").get(0).empty());
  EXPECT_EQ(a.attribute("animated").get_as<double>(0), 3);
  EXPECT_EQ(a.attribute("strong").get_as<double>(2), 2);
  EXPECT_TRUE(a.attribute("strong").get(3).empty());
  EXPECT_TRUE(a.attribute("strong").get(4).empty());
  EXPECT_EQ(a.attribute("strong").get_as<double>(), 3);
  EXPECT_EQ(a.attribute("when").get_as<layer::TimeCode>(), layer::TimeCode{20});
}

// Values as OpenUSD 26.11 evaluates these splines.
TEST(Attribute, SplinesAreEvaluated) {
  const Stage stage = open_text(R"(def "A" {
    double a.spline = {
        bezier,
        pre: sloped(1.5),
        post: linear,
        loop: (15, 25, 0, 2, 11.7),
        7: 5.5 & 7.21; post held,
        15: 8.18; post held,
        20: 14.72; pre (3.1, 1.5); post curve (4.2, 2.5),
        30: 1; post linear,
    }
    float b.spline = {
        hermite,
        post: loop repeat,
        1: 5; post held,
        2: 6; post none,
    }
})");
  const struct {
    const char* name;
    double time;
    double value;
  } cases[] = {
      {"a", 0, -5},     {"a", 6.999, 5.4985},
      {"a", 7, 7.21},   {"a", 17, 8.18},
      {"a", 20, 14.72}, {"a", 22, 19.05812076732389},
      {"a", 25, 19.88}, {"a", 33, 32.2455456441765},
      {"b", 0, 5},      {"b", 6.999, 10},
      {"b", 20, 24},
  };
  for (const auto& c : cases) {
    const layer::Value value = at(stage, "/A").attribute(c.name).get(c.time);
    const double actual =
        value.holds<float>() ? static_cast<double>(*value.get<float>()) : value.get_or(0.0);
    EXPECT_NEAR(actual, c.value, 1e-9) << c.name << " at " << c.time;
  }
}

TEST(Attribute, FallbacksAndDeclaredTypesComeFromSchemas) {
  const Stage stage = open_text(R"(
def Cube "A" (prepend apiSchemas = ["PhysicsDriveAPI:angular", "PhysxJointAPI", "Unknown"]) {
    custom uniform token visibility
    double size = None
}
)");
  const Prim a = at(stage, "/A");
  EXPECT_EQ(a.attribute("doubleSided").get_as<bool>(), false);
  EXPECT_EQ(a.attribute("drive:angular:physics:damping").get_as<float>(), 0.0f);
  EXPECT_EQ(a.attribute("visibility").variability(), layer::Variability::Varying);
  EXPECT_FALSE(a.attribute("visibility").is_custom());
  EXPECT_TRUE(a.attribute("size").get().empty());
  EXPECT_EQ(a.attribute("size").value_source(), ValueSource::Fallback);
  EXPECT_EQ(a.attribute("size").fallback(), layer::Value(2.0));
  EXPECT_TRUE(a.has_api("Unknown"));
  EXPECT_EQ(a.applied_schemas(), std::vector<Token>{"PhysicsDriveAPI:angular"});
  EXPECT_EQ(a.api_instances("PhysicsDriveAPI"), std::vector<Token>{"angular"});
  EXPECT_TRUE(a.is_a("Gprim"));
}

TEST(Attribute, WeakestOpinionDecidesVariabilityAndAnyOpinionCustom) {
  const Stage stage = open_text(R"(
def "R" {
    uniform double a
    custom double c
}
def "A" (references = </R>) {
    double a
    double c
}
)");
  EXPECT_EQ(at(stage, "/A").attribute("a").variability(), layer::Variability::Uniform);
  EXPECT_TRUE(at(stage, "/A").attribute("c").is_custom());
}

TEST(Prim, MetadataIsComposed) {
  const Stage stage = open_text({{"root", R"((subLayers = [@sub@])
over "A" (prepend apiSchemas = ["Strong"]; customData = { int a = 1 }) {
    reorder properties = ["b"]
    int a = 1
})"},
                                 {"sub", R"(def "A" (
    prepend apiSchemas = ["Weak"]
    customData = { int a = 2
 int b = 3 }
    variants = { string v = "one" }
    prepend variantSets = "v"
) {
    int b = 2
    variantSet "v" = { "one" { int c = 1 } "two" {} }
})"}});
  const Prim a = at(stage, "/A");
  EXPECT_EQ(a.authored_api_schemas(), (std::vector<Token>{"Strong", "Weak"}));
  const layer::Value data = a.metadata("customData");
  ASSERT_TRUE(data.holds<layer::Dictionary>());
  EXPECT_EQ(*data.get<layer::Dictionary>()->find("a"), layer::Value(std::int32_t{1}));
  EXPECT_EQ(*data.get<layer::Dictionary>()->find("b"), layer::Value(std::int32_t{3}));
  EXPECT_EQ(a.authored_property_names(), (std::vector<Token>{"b", "a", "c"}));
  EXPECT_EQ(a.variant_set_names(), std::vector<std::string>{"v"});
  EXPECT_EQ(a.variant_names("v"), (std::vector<std::string>{"one", "two"}));
  EXPECT_EQ(a.variant_selection("v"), "one");
}

TEST(Relationship, ForwardedTargetsFollowRelationships) {
  const Stage stage = open_text(R"(
def "A" {
    rel direct = [</B.further>, </C>]
    double x.connect = </B.further>
}
def "B" { rel further = [</A.direct>, </D>, </C>] }
)");
  const Relationship direct = at(stage, "/A").relationship("direct");
  EXPECT_EQ(direct.targets(), (std::vector{Path::from("/B.further"), Path::from("/C")}));
  // The cycle leads back once.
  EXPECT_EQ(direct.forwarded_targets(), (std::vector{Path::from("/C"), Path::from("/D")}));
  EXPECT_EQ(at(stage, "/A").attribute("x").connections(), std::vector{Path::from("/B.further")});
}

// As OpenUSD's stages, where composition alone rejects them.
TEST(Relationship, AClassMayTargetOtherPrimsThatUseIt) {
  const Stage stage = open_text(R"(
class "C" { rel r = [</A>, </B>] }
def "A" (inherits = </C>) {}
def "B" (inherits = </C>) {}
)");
  EXPECT_EQ(at(stage, "/A").relationship("r").targets(), std::vector{Path::from("/B")});
}

TEST(Prim, LegacyListEditsDoNotCombineInMetadata) {
  const Stage stage = open_text({
      {"root", "( subLayers = [@a@, @b@, @c@] )"},
      {"a", R"(def "A" (append apiSchemas = ["X"]) {})"},
      {"b", R"(def "A" (add apiSchemas = ["Y"]) {})"},
      {"c", R"(def "A" (apiSchemas = ["Z"]) {})"},
  });
  EXPECT_EQ(at(stage, "/A").metadata(Token("apiSchemas")),
            layer::Value(layer::ListOp<Token>::make_explicit({"Z", "X"})));
}

TEST(Attribute, InterpolationMayBeHeld) {
  StageOptions options;
  options.interpolation = Interpolation::Held;
  const Stage stage = open_text({{"root", R"(def "A" { double x.timeSamples = { 0: 1, 10: 2 } })"}},
                                std::move(options));
  EXPECT_EQ(at(stage, "/A").attribute("x").get_as<double>(9.0), 1.0);
}

struct XformCase {
  const char* ops;
  Vec3d image;  // of the point (1, 2, 3)
};

TEST(TransformAt, EveryKindOfOperation) {
  const XformCase cases[] = {
      {"double3 xformOp:translate = (10, 0, 0)|xformOp:translate", {{11, 2, 3}}},
      {"half xformOp:translateY = 5|xformOp:translateY", {{1, 7, 3}}},
      {"float3 xformOp:scale = (2, 3, 4)|xformOp:scale", {{2, 6, 12}}},
      {"float xformOp:scaleZ = 2|xformOp:scaleZ", {{1, 2, 6}}},
      {"double xformOp:rotateZ = 90|xformOp:rotateZ", {{-2, 1, 3}}},
      {"float3 xformOp:rotateXYZ = (90, 0, 90)|xformOp:rotateXYZ", {{3, 1, 2}}},
      {"float3 xformOp:rotateZYX = (90, 0, 90)|xformOp:rotateZYX", {{-2, -3, 1}}},
      {"quatf xformOp:orient = (0.70710678, 0, 0, 0.70710678)|xformOp:orient", {{-2, 1, 3}}},
      {"double xformOp:rotateX = 90|!invert!xformOp:rotateX", {{1, 3, -2}}},
      {"matrix4d xformOp:transform = ((0,1,0,0),(-1,0,0,0),(0,0,1,0),(5,0,0,1))|xformOp:transform",
       {{3, 1, 3}}},
  };
  for (const XformCase& c : cases) {
    const std::string text = c.ops;
    const std::size_t bar = text.find('|');
    const Stage stage =
        open_text("def Xform \"A\" {\n" + text.substr(0, bar) +
                  "\nuniform token[] xformOpOrder = [\"" + text.substr(bar + 1) + "\"]\n}\n");
    Diagnostics diagnostics;
    const LocalTransform local = local_transform(at(stage, "/A"), {}, &diagnostics);
    EXPECT_TRUE(diagnostics.empty()) << text;
    const Vec3d image = transform_point({{1, 2, 3}}, local.matrix);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(image[i], c.image[i], 1e-6) << text;
    }
  }
}

TEST(TransformAt, ResetDropsTheParentAndInversePairsCancel) {
  const Stage stage = open_text(R"(
def Xform "A" {
    double3 xformOp:translate = (1, 0, 0)
    uniform token[] xformOpOrder = ["xformOp:translate"]
    def Xform "B" {
        double3 xformOp:translate = (0, 2, 0)
        double xformOp:scaleX:pivot = 0
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:scaleX:pivot",
            "!invert!xformOp:scaleX:pivot"]
    }
    def Xform "R" { uniform token[] xformOpOrder = ["!resetXformStack!"] }
    def Scope "S" { def Xform "T" {} }
}
)");
  const Vec3d origin;
  EXPECT_EQ(transform_point(origin, local_to_world(at(stage, "/A/B"), {})), (Vec3d{{1, 2, 0}}));
  EXPECT_EQ(transform_point(origin, local_to_world(at(stage, "/A/R"), {})), (Vec3d{{0, 0, 0}}));
  TransformCache cache{Time()};
  EXPECT_EQ(transform_point(origin, cache.local_to_world(at(stage, "/A/S/T"))), (Vec3d{{1, 0, 0}}));
  EXPECT_EQ(transform_point(origin, cache.local_to_world(at(stage, "/A/B"))), (Vec3d{{1, 2, 0}}));
}

TEST(StageUnits, FallbacksAndBrokenValues) {
  Diagnostics diagnostics;
  const StageUnits plain = read_stage_units(open_text("def \"A\" {}"), diagnostics);
  EXPECT_EQ(plain.meters_per_unit, 0.01);
  EXPECT_EQ(plain.kilograms_per_unit, 1);
  EXPECT_EQ(plain.up_axis, UpAxis::Y);
  EXPECT_TRUE(diagnostics.empty());
  const Stage broken = open_text("(metersPerUnit = -1\nkilogramsPerUnit = 0\nupAxis = \"W\")");
  EXPECT_EQ(read_stage_units(broken, diagnostics).meters_per_unit, 0.01);
  EXPECT_EQ(diagnostics.size(), 3u);
}

constexpr const char* kMaterials = R"(
def Material "M" {}
def Material "P" {}
def Material "C" {}
def Xform "W" (prepend apiSchemas = ["MaterialBindingAPI", "CollectionAPI:some"]) {
    rel material:binding = </M>
    rel material:binding:physics = </P>
    rel material:binding:collection:physics:some = [</W.collection:some>, </C>]
    rel collection:some:includes = </W/In>
    rel collection:some:excludes = </W/In/Out>
    def Cube "In" { def Cube "Out" {} def Cube "Own" { rel material:binding:physics = </M> } }
    def Cube "Plain" {}
}
def Cube "Alone" { rel material:binding = </M> }
)";

TEST(MaterialBinding, PurposesCollectionsAndInheritance) {
  const Stage stage = open_text(kMaterials);
  const struct {
    const char* prim;
    const char* purpose;
    const char* material;
  } cases[] = {
      {"/W/Plain", "physics", "/P"}, {"/W/Plain", "", "/M"},         {"/W/Plain", "full", "/M"},
      {"/W/In", "physics", "/C"},    {"/W/In/Out", "physics", "/P"}, {"/W/In/Own", "physics", "/M"},
      {"/Alone", "physics", "/M"},
  };
  for (const auto& c : cases) {
    EXPECT_EQ(bound_material(at(stage, c.prim), c.purpose), Path::from(c.material))
        << c.prim << " " << c.purpose;
  }
  EXPECT_TRUE(find_material_binding(at(stage, "/Alone"), "physics").binding_api_missing);
  EXPECT_FALSE(find_material_binding(at(stage, "/W/Plain"), "physics").binding_api_missing);
}

TEST(Flatten, HasNoArcsAndTheSameValues) {
  const Stage stage = open_text(R"(
def "R" (customData = { int a = 1 }) { double z = 1
 def "C" { rel up = </R> } }
def "A" (instanceable = true; references = </R>) { double z.timeSamples = { 0: 1 } }
def "B" (references = </R>) {}
)");
  const layer::Layer flat = flatten(stage);
  EXPECT_FALSE(flat.find(Path::from("/B"))->has("references"));
  EXPECT_TRUE(flat.has(Path::from("/B/C.up")));
  EXPECT_TRUE(flat.find(Path::from("/A"))->has("references"));
  EXPECT_TRUE(flat.has(Path::from("/Flattened_Prototype_1/C.up")));
  EXPECT_EQ(flat.find(Path::from("/B.z"))->get_or("default", 0.0), 1);
  EXPECT_TRUE(flat.find(Path::from("/A.z"))->has("timeSamples"));
}

TEST(Flatten, AssetPathsMeanTheSameAnywhere) {
  const Stage stage = open_text({
      {"root", R"(def "A" (references = @/in/ref@</R>) {})"},
      {"/in/ref", R"(def "R" { asset a = @./x.png@
 asset b = @y.png@ })"},
  });
  const layer::Layer flat = flatten(stage);
  const auto authored = [&](const char* path) {
    const layer::Spec* spec = flat.find(Path::from(path));
    return spec->get_or(layer::fields::default_value, layer::AssetPath()).authored;
  };
  EXPECT_EQ(authored("/A.a"), "/in/x.png");
  EXPECT_EQ(authored("/A.b"), "y.png");
}

// Most attributes are taken as they stand; these are not.
TEST(Flatten, AttributesThatOneOpinionDoesNotTellAreComposed) {
  const Stage stage = open_text({
      {"root", R"((subLayers = [@weak@])
        def Sphere "A" { custom uniform double radius = 2
          double plain = 1 (doc = "d")
          double b = None
          nonsense unknown = 3
          timecode when = 4
          double both = 5 } def "R" (references = @late@</L> (offset = 10)) {})"},
      {"weak", R"(over "A" { double both (hidden = true) })"},
      {"late", R"(def "L" { double x.timeSamples = { 1: 2 }
          timecode t = 1 })"},
  });
  const layer::Layer flat = flatten(stage);
  const auto spec = [&](const char* path) { return flat.find(Path::from(path)); };
  EXPECT_FALSE(spec("/A.radius")->get_or("custom", true));
  EXPECT_EQ(spec("/A.radius")->get_or("variability", layer::Variability::Uniform),
            layer::Variability::Varying);
  EXPECT_EQ(spec("/A.radius")->get_or("default", 0.0), 2);
  EXPECT_EQ(spec("/A.plain")->get_or("documentation", std::string()), "d");
  EXPECT_TRUE(spec("/A.b")->find("default")->is_block());
  EXPECT_EQ(spec("/A.unknown"), nullptr);
  EXPECT_EQ(spec("/A.when")->get_or("default", layer::TimeCode{}).value, 4);
  EXPECT_TRUE(spec("/A.both")->get_or("hidden", false));
  EXPECT_EQ(spec("/A.both")->get_or("default", 0.0), 5);
  EXPECT_EQ(spec("/R.x")->get<layer::TimeSamples>("timeSamples")->times, std::vector<double>{11});
  EXPECT_EQ(spec("/R.t")->get_or("default", layer::TimeCode{}).value, 11);
}

TEST(Flatten, ALayerStackBecomesOneLayer) {
  const Stage stage = open_text({{"root", R"((
    subLayers = [@sub@ (offset = 10)]
    upAxis = "Z"
)
over "A" (prepend references = </R>; customData = { int a = 1 }) {
    double hidden = 1
    double y = 1
})"},
                                 {"sub", R"((upAxis = "Y")
def Xform "A" (prepend references = </S>; customData = { int a = 2
 int b = 2 }) {
    double hidden.timeSamples = { 0: 1 }
    double x.timeSamples = { 0: 1 }
}
def "R" {}
def "S" {})"}});
  const layer::Layer flat = flatten_layer_stack(stage);
  EXPECT_EQ(flat.root().get_or<Token>("upAxis", Token()), "Z");
  EXPECT_FALSE(flat.root().has("subLayers"));
  const layer::Spec& a = *flat.find(Path::from("/A"));
  EXPECT_EQ(a.get_or("specifier", layer::Specifier::Over), layer::Specifier::Def);
  EXPECT_EQ(a.get_or<Token>("typeName", Token()), "Xform");
  EXPECT_EQ(a.get<layer::ListOp<layer::Reference>>("references")->prepended.size(), 2u);
  EXPECT_EQ(*a.get<layer::Dictionary>("customData")->find("b"), layer::Value(std::int32_t{2}));
  EXPECT_FALSE(flat.find(Path::from("/A.hidden"))->has("timeSamples"));
  EXPECT_EQ(flat.find(Path::from("/A.x"))->get<layer::TimeSamples>("timeSamples")->times,
            std::vector<double>{10});
  EXPECT_EQ(layer::Layer::children(a, "properties"), (std::vector<Token>{"hidden", "x", "y"}));
}

TEST(Flatten, EditsOfALayerStackBecomeOneEdit) {
  // As OpenUSD 26.11: added items are appended, orders dropped.
  const Stage stage = open_text({{"root", R"((
    subLayers = [@sub@]
)
over "A" (delete apiSchemas = ["d", "x"]; append apiSchemas = ["z"]; append inherits = </C>) {})"},
                                 {"sub", R"(def "A" (
    delete apiSchemas = ["e"]
    prepend apiSchemas = ["p", "x"]
    add inherits = [</D>, </E>]
    reorder inherits = [</E>]
) {})"}});
  const layer::Layer flat = flatten_layer_stack(stage);
  const layer::Spec& a = *flat.find(Path::from("/A"));
  const auto& apis = *a.get<layer::ListOp<Token>>("apiSchemas");
  EXPECT_EQ(apis.deleted, (std::vector<Token>{"e", "d", "x"}));
  EXPECT_EQ(apis.prepended, std::vector<Token>{"p"});
  EXPECT_EQ(apis.appended, std::vector<Token>{"z"});
  const auto& inherits = *a.get<layer::ListOp<Path>>("inheritPaths");
  EXPECT_EQ(inherits.appended,
            (std::vector<Path>{Path::from("/D"), Path::from("/E"), Path::from("/C")}));
  EXPECT_TRUE(inherits.added.empty() && inherits.ordered.empty());
}

TEST(Flatten, LayersOfAStackKeepTheirTimesOrdersAndPlaces) {
  const Stage stage = open_text({{"root", R"((
    subLayers = [@sub@ (offset = 10; scale = 2)]
)
over "A" {
    reorder nameChildren = ["y", "x"]
    double p
}
)"},
                                 {"sub", R"((
    customLayerData = { int weak = 1 }
    unknownField = 3
)
def "A" (
    references = @`"a.usda"`@</R>
    customData = { timecode t = 5 }
    clips = { dictionary default = { double2[] times = [(0, 0), (5, 1)] } }
) {
    timecode[] times = [1, 2]
    asset broken = @`"bad`@
    custom double p
    def "x" {}
    def "y" {}
})"}});
  const layer::Layer flat = flatten_layer_stack(stage);
  EXPECT_FALSE(flat.root().has("unknownField"));
  EXPECT_TRUE(flat.root().has("customLayerData"));
  const layer::Spec& a = *flat.find(Path::from("/A"));
  EXPECT_EQ(a.get<layer::ListOp<layer::Reference>>("references")->explicit_items.at(0).asset_path,
            "a.usda");
  EXPECT_EQ(a.get<layer::Dictionary>("customData")->find("t")->get<layer::TimeCode>()->value, 20);
  const auto& clips = *a.get<layer::Dictionary>("clips")->find("default")->get<layer::Dictionary>();
  const auto& times = *clips.find("times")->get<layer::Array<Vec2d>>();
  EXPECT_EQ(times[1][0], 20);
  EXPECT_EQ(times[1][1], 1);
  EXPECT_EQ(layer::Layer::children(a, "primChildren"), (std::vector<Token>{"y", "x"}));
  const auto* codes =
      flat.find(Path::from("/A.times"))->get<layer::Array<layer::TimeCode>>("default");
  EXPECT_EQ((*codes)[1].value, 14);
  EXPECT_EQ(*flat.find(Path::from("/A.broken"))->find("default"), layer::Value(layer::AssetPath()));
  EXPECT_FALSE(flat.find(Path::from("/A.p"))->get_or("custom", false));
}

TEST(Values, ASampleIsExactAtItsOwnStageTime) {
  // 100 codes of 1/24 s end at 4.1666666666666661 s, which is 99.999999999999986 codes.
  const Stage stage = open_text({{"root", R"((
    timeCodesPerSecond = 1
    subLayers = [@sub@]
)
)"},
                                 {"sub", R"(def "A" {
    double x.timeSamples = { 0: 0, 100: 100, 200: 0 }
})"}});
  const Attribute x = stage.prim(Path::from("/A")).attribute("x");
  for (const double time : x.time_samples()) {
    EXPECT_EQ(x.get_as<double>(time), time > 4 && time < 5 ? 100.0 : 0.0) << time;
  }
  EXPECT_EQ(x.get_as<double>(-1.0), 0.0);
  EXPECT_EQ(x.get_as<double>(9.0), 0.0);
  EXPECT_NEAR(*x.get_as<double>(6.25), 50, 1e-9);
}

TEST(PrimIndex, SearchesShortListsOfPropertiesAlone) {
  compose::PrimIndex index;
  std::vector<Token> names;
  for (std::size_t i = 0; i < layer::Layer::kShortList; ++i) {
    names.push_back(Token("a" + std::to_string(i)));
  }
  index.set_property_names(compose::NameList(names));
  EXPECT_TRUE(index.may_have_property("a0"));
  for (int i = 0; i < 100; ++i) {  // some of them have the mark of one that is there
    EXPECT_FALSE(index.may_have_property(Token("none" + std::to_string(i))));
  }
  names.push_back("one more");
  index.set_property_names(compose::NameList(names));
  EXPECT_TRUE(index.may_have_property("one more"));
  for (int i = 0; i < 100; ++i) {
    const Token name("none" + std::to_string(i));
    EXPECT_EQ(index.may_have_property(name),
              (index.name_marks & compose::PrimIndex::mark_of(name)) != 0);
    EXPECT_FALSE(index.has_property(name));
  }
}

TEST(Prim, KnowsItsPropertiesHoweverManyTheyAre) {
  for (const std::size_t count : {std::size_t{3}, 2 * layer::Layer::kShortList}) {
    std::string text = "def \"P\" {\nrel last\n";
    for (std::size_t i = 0; i < count; ++i) {
      text += "int a" + std::to_string(i) + "\n";
    }
    const Stage stage = open_text(Texts{{"root", text + "}\n"}});
    const Prim prim = stage.prim(Path::from("/P"));
    EXPECT_FALSE(prim.has_property("none"));
    EXPECT_FALSE(prim.is_relationship("none"));
    EXPECT_FALSE(prim.is_relationship("a1"));
    EXPECT_TRUE(prim.is_relationship("last"));
    EXPECT_TRUE(prim.relationship("none").targets().empty());
    EXPECT_TRUE(prim.attribute("none").get().empty());
  }
}

}  // namespace
}  // namespace tenon::stage
