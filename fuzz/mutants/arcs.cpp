// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Layers whose arcs form random graphs, cycles and branches included, and layers of motion: splines
// and value clips with numbers at which loops go wrong.
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/mutants/mutant.h"
#include "fuzz/text_mutations.h"

namespace tenon::fuzz {
namespace {

constexpr std::string_view kTimes[] = {
    "0",   "1",    "-1",   "1e308", "-1e308", "1e-320", "nan",  "inf",    "1e14",       "24",
    "0.5", "1e-9", "2e-5", "-3",    "10",     "1e300",  "1000", "100000", "99999999999"};

std::string_view a_time(Dice& dice) {
  return dice.one_in(2) ? kTimes[dice.below(2)] : kTimes[dice.below(std::size(kTimes))];
}

/// A graph of arcs between the prims of a few layers.
class ArcGraph {
 public:
  explicit ArcGraph(Dice& dice)
      : dice_(dice),
        layers_(1 + dice.below(5)),
        names_(2 + dice.below(5)),
        arcs_(1 + dice.below(dice.one_in(4) ? 12 : 4)) {}

  std::string layer(std::size_t number) {
    std::string text = "#usda 1.0\n(\n    defaultPrim = \"" + name() + "\"\n";
    if (dice_.one_in(3)) {
      text += "    subLayers = [" + file(dice_.one_in(2)) + ", " + file(true) + "]\n";
    }
    if (dice_.one_in(4)) {
      text += "    relocates = {\n        <" + path() + ">: <" + path() + ">,\n        </M" +
              path() + ">: <" + path() + ">,\n    }\n";
    }
    if (dice_.one_in(6)) {
      text += "    expressionVariables = { string A = \"`'${B}${B}'\"; string B = \"l0.usda\" }\n";
    }
    text += ")\n";
    for (std::size_t i = 0; i < names_; ++i) {
      prim(text, std::string(1, static_cast<char>('A' + i)), 0);
    }
    return text + "# layer " + std::to_string(number) + "\n";
  }
  std::size_t layers() const { return layers_; }

 private:
  std::string name() { return std::string(1, static_cast<char>('A' + dice_.below(names_))); }
  std::string path() {
    std::string text;
    for (std::size_t left = 1 + dice_.below(3); left > 0; --left) {
      text += "/" + name();
    }
    return text;
  }
  std::string file(bool with_offset) {
    std::string text = "@l" + std::to_string(dice_.below(layers_ + 1)) + ".usda@";
    if (with_offset && dice_.one_in(6)) {
      text += " (offset = " + std::string(a_time(dice_)) +
              "; scale = " + std::string(a_time(dice_)) + ")";
    }
    return text;
  }
  std::string target() {
    switch (dice_.below(5)) {
      case 0:
        return file(true);
      case 1:
      case 2:
        return file(false) + "<" + path() + ">";
      default:
        return "<" + path() + ">";
    }
  }
  void arcs(std::string& text, const std::string& indent) {
    static constexpr std::string_view kEdits[] = {"", "prepend ", "append ", "add ", "delete "};
    static constexpr std::string_view kArcs[] = {"references", "payload", "inherits",
                                                 "specializes"};
    for (std::size_t left = dice_.below(3); left > 0; --left) {
      const std::string_view arc = kArcs[dice_.below(std::size(kArcs))];
      const bool inside = arc == "inherits" || arc == "specializes";
      text += indent + std::string(kEdits[dice_.below(std::size(kEdits))]) + std::string(arc);
      std::set<std::string> targets;  // a list that names one twice is refused
      for (std::size_t items = 1 + dice_.below(arcs_); items > 0; --items) {
        targets.insert(inside ? "<" + path() + ">" : target());
      }
      text += " = [";
      for (const std::string& each : targets) {
        text += each + ", ";
      }
      text.resize(text.size() - 2);
      text += "]\n";
    }
  }
  void prim(std::string& text, const std::string& called, std::size_t depth) {
    const std::string indent(4 * depth, ' ');
    const bool variants = dice_.one_in(4);
    text += indent + (dice_.one_in(5) ? "class \"" : "def Xform \"") + called + "\" (\n";
    arcs(text, indent + "    ");
    if (dice_.one_in(6)) {
      text += indent + "    instanceable = true\n";
    }
    if (variants) {
      text +=
          indent + "    variantSets = \"v\"\n" + indent + "    variants = { string v = \"a\" }\n";
    }
    text += indent + ")\n" + indent + "{\n" + indent + "    double x = 1\n" + indent +
            "    rel r = <" + path() + ">\n" + indent + "    double y.connect = <" + path() +
            ".x>\n";
    if (dice_.one_in(6)) {
      text += indent + "    pathExpression e = \"//{type:Xform} + " + path() + "//" + name() +
              "* - %" + path() + ":c\"\n";
    }
    if (variants) {
      text += indent + "    variantSet \"v\" = {\n" + indent + "        \"a\" (\n";
      arcs(text, indent + "            ");
      text += indent + "        ) {\n";
      if (depth < 3) {
        prim(text, name(), depth + 1);
      }
      text += indent + "        }\n" + indent + "    }\n";
    }
    for (std::size_t i = 0; depth < 3 && i < names_; ++i) {
      if (dice_.one_in(2 + depth)) {
        prim(text, std::string(1, static_cast<char>('A' + i)), depth + 1);
      }
    }
    text += indent + "}\n";
  }

  Dice& dice_;
  std::size_t layers_;
  std::size_t names_;
  std::size_t arcs_;
};

std::string spline(Dice& dice) {
  static constexpr std::string_view kEnds[] = {
      "none", "held", "linear", "loop repeat", "loop reset", "loop oscillate", "sloped(1e308)"};
  const auto time = [&] { return std::string(a_time(dice)); };
  std::string text = dice.one_in(2) ? "bezier,\n" : "hermite,\n";
  text += "pre: " + std::string(kEnds[dice.below(std::size(kEnds))]) + ",\n";
  text += "post: " + std::string(kEnds[dice.below(std::size(kEnds))]) + ",\n";
  if (dice.one_in(2)) {
    text += "loop: (" + time() + ", " + time() + ", " + std::to_string(dice.extreme() >> 33) +
            ", " + std::to_string(dice.below(40)) + ", " + time() + "),\n";
  }
  for (std::size_t knot = 0, knots = dice.below(6); knot < knots; ++knot) {
    text += (dice.one_in(4) ? time() : std::to_string(knot * 10)) + ": " + time();
    text += dice.one_in(3) ? " & " + time() : "";
    text += dice.one_in(2) ? "; pre (" + time() + ", " + time() + ")" : "";
    text += "; post curve (" + time() + ", " + time() + "),\n";
  }
  return text;
}

std::string clip_set(Dice& dice) {
  const auto time = [&] { return std::string(a_time(dice)); };
  const auto times = [&] {
    std::string text = "[";
    for (std::size_t left = dice.below(5); left > 0; --left) {
      text +=
          "(" + time() + ", " + (dice.one_in(2) ? time() : std::to_string(dice.below(3))) + "), ";
    }
    return text + "]";
  };
  std::string text = "string primPath = \"/A\"\n";
  if (dice.one_in(2)) {
    text += "string templateAssetPath = \"./clip." + std::string(1 + dice.below(12), '#') +
            (dice.one_in(2) ? "." + std::string(1 + dice.below(9), '#') : "") +
            ".usda\"\ndouble templateStartTime = " + time() +
            "\ndouble templateEndTime = " + time() + "\ndouble templateStride = " + time() + "\n";
    return text + (dice.one_in(3) ? "double templateActiveOffset = " + time() + "\n" : "");
  }
  text += "asset[] assetPaths = [@./clip.1.usda@, @./clip.2.usda@]\n";
  text += "double2[] active = " + times() + "\ndouble2[] times = " + times() + "\n";
  return text + (dice.one_in(2) ? "asset manifestAssetPath = @./clip.2.usda@\n" : "") +
         (dice.one_in(3) ? "bool interpolateMissingClipValues = true\n" : "");
}

std::string clip_layer(Dice& dice) {
  std::string text = "#usda 1.0\nover \"A\"\n{\n    double t.timeSamples = {\n";
  for (std::size_t left = dice.below(6); left > 0; --left) {
    text += "        " + std::string(a_time(dice)) + ": " + std::to_string(left) + ",\n";
  }
  return text + "    }\n}\n";
}

}  // namespace

Mutant make_arc_graph(Dice& dice) {
  ArcGraph graph(dice);
  Mutant mutant;
  for (std::size_t number = 0; number < graph.layers(); ++number) {
    mutant.files.push_back({"l" + std::to_string(number) + ".usda", graph.layer(number)});
  }
  mutant.asset = "l0.usda";
  mutant.prim = "/A";
  mutant.bound = Bound::Composition;
  return mutant;
}

Mutant make_motion(const Seeds&, Dice& dice) {
  std::string text =
      "#usda 1.0\n(\n    defaultPrim = \"A\"\n    startTimeCode = 1\n    endTimeCode = 5\n)\n"
      "def Xform \"A\" (\n    clips = {\n        dictionary default = {\n" +
      clip_set(dice) + "        }\n    }\n)\n{\n    double t\n    double s.spline = {\n" +
      spline(dice) + "    }\n    double3 xformOp:translate.timeSamples = { " +
      std::string(a_time(dice)) + ": (0, 0, 0), 7: (1, 2, 3) }\n" +
      "    uniform token[] xformOpOrder = [\"xformOp:translate\"]\n}\n";
  if (dice.one_in(3)) {
    text = mutate_text(text, {Grammar::Usd, "", kLargestMutant}, dice);
  }
  Mutant mutant;
  mutant.files.push_back({"clip.1.usda", clip_layer(dice)});
  mutant.files.push_back({"clip.2.usda", clip_layer(dice)});
  mutant.asset = "mutant.usda";
  mutant.files.push_back({mutant.asset, text});
  mutant.prim = "/A";
  mutant.bound = Bound::Composition;
  return mutant;
}

}  // namespace tenon::fuzz
