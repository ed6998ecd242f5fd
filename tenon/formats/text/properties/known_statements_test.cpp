// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Statements that begin as one before them, and blocks of metadata that came before, are taken over
// from the cache. A prim reads the same when it is the only one in the text, without the cache.
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tenon/formats/text/reader.h"

namespace tenon::formats {
namespace {

// Some differ only after the value, some are longer by a few bytes, some mean something else in
// another prim.
const std::vector<std::string> kStatements = {
    "double a = 1",
    "double a = 12",
    "double a = 1 (doc = \"x\")",
    "double a = 1 # note",
    "double a=1",
    "double a = 1;",
    "double a = 1\r",
    "double a = 2",
    "double a",
    "custom double b = 1",
    "double b = 1",
    "uniform token c = \"x\"",
    "uniform token c = \"xy\"",
    "uniform token[] d = [\"x\", \"y\"]",
    "uniform token[] d = [\"x\", \"y\", \"z\"]",
    "uniform token[] d = []",
    "float3[] e = [(1, 2, 3), (4, 5, 6)]",
    "float3[] e = [\n(1, 2, 3),\n(4, 5, 6)]",
    "string f = \"\"\"two\nlines\"\"\"",
    "string f = 'a # b'",
    "asset g = @./x.png@",
    "pathExpression h = \"./x\"",
    "pathExpression h = \"../x//y\"",
    "pathExpression h = \"{\"",
    "int[] i = edit [append 3]",
    "strange j = (1, 2)",
    "float k.timeSamples = { 1: 2, 3: None }",
    "float k.connect = <../p0.a>",
    "float k = 1",
    "float k = None",
    "float k = <.a>",
    "rel l = <../p1>",
    "rel l = [<x>, <../p2>]",
    "double m = 1 (\n    customData = { int x = 1 }\n)",
    "double m = 1 (\n    customData = { int x = 2 }\n)",
    "double n = 3 (\n    customData = { int x = 1 }\n)",
    "double /* = */ o = 1",
};

const std::vector<std::string> kMetadata = {
    "",
    "(\n    prepend apiSchemas = [\"A\", \"B\"]\n)\n",
    "(\n    prepend apiSchemas = [\"A\", \"B\"]\n    kind = \"x\"\n)\n",
    "(\n    prepend apiSchemas = [\"A\", \"A\"]\n)\n",
    "(kind = \"x\")",
    "(\n    inherits = </class>\n    kind = \"x\"\n)\n",
    "(\n    references = @./x.usda@</x> (offset = 2)\n)\n",
    "(\n    prepend variantSets = [\"v\"]\n    variants = { string v = \"w\" }\n)\n",
    "(\n    strange = 3\n)\n",
};

/// Random prims, each of some of the statements; the first one of a name declares its type.
std::vector<std::string> random_prims(unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::string> prims;
  for (std::size_t i = 0; i < 12; ++i) {
    std::string prim = "def Xform \"p" + std::to_string(i) + "\" " +
                       kMetadata[random() % kMetadata.size()] + "{\n";
    std::string last = "?";
    for (const std::string& statement : kStatements) {
      const std::string name = statement.substr(0, statement.find_first_of("=.(;\r"));
      if (random() % 3 == 0 && name != last) {
        prim += "    " + statement + "\n";
        last = name;
      }
    }
    prims.push_back(prim + "}\n");
  }
  return prims;
}

std::string as_blanks(std::string text) {
  for (char& c : text) {
    c = c == '\n' ? c : ' ';
  }
  return text;
}

struct Reading {
  std::vector<std::string> findings;
  Result<layer::Layer> layer;
};

Reading read_with_findings(const std::string& text) {
  Diagnostics diagnostics;
  Result<layer::Layer> layer = read_text(text, "t.usda", diagnostics);
  std::vector<std::string> findings;
  for (const Diagnostic& diagnostic : diagnostics) {
    findings.push_back(diagnostic.to_string());
  }
  return {std::move(findings), std::move(layer)};
}

void expect_same(const layer::Spec& a, const layer::Spec& b, const std::string& where) {
  EXPECT_EQ(a.kind, b.kind) << where;
  EXPECT_EQ(a.line, b.line) << where;
  EXPECT_EQ(a.column, b.column) << where;
  const layer::FieldRange x = a.fields();
  const layer::FieldRange y = b.fields();
  ASSERT_EQ(x.size(), y.size()) << where;
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_EQ(x[i].name, y[i].name) << where;
    EXPECT_TRUE(x[i].value == y[i].value) << where << " " << x[i].name.str();
  }
}

/// How many specs of `alone` were compared, without the root.
std::size_t compare(const layer::Layer& alone, const layer::Layer& all) {
  std::size_t compared = 0;
  for (const layer::Layer::Entry& entry : alone.entries()) {
    if (entry.path == Path::absolute_root()) {
      continue;
    }
    const layer::Spec* const other = all.find(entry.path);
    EXPECT_NE(other, nullptr) << entry.path.str();
    if (other != nullptr) {
      expect_same(entry.spec, *other, entry.path.str());
      ++compared;
    }
  }
  return compared;
}

TEST(KnownStatements, APrimAmongOthersReadsAsAlone) {
  std::size_t compared = 0;
  std::size_t findings = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const std::vector<std::string> prims = random_prims(seed);
    std::string text = "#usda 1.0\n";
    for (const std::string& prim : prims) {
      text += prim;
    }
    const Reading all = read_with_findings(text);
    ASSERT_TRUE(all.layer) << all.layer.error().to_string() << "\n" << text;
    std::vector<std::string> said;
    std::size_t specs = 1;
    for (std::size_t i = 0; i < prims.size(); ++i) {
      std::string only = "#usda 1.0\n";
      for (std::size_t j = 0; j < prims.size(); ++j) {
        only += j == i ? prims[j] : as_blanks(prims[j]);
      }
      const Reading alone = read_with_findings(only);
      ASSERT_TRUE(alone.layer) << alone.layer.error().to_string() << "\n" << only;
      said.insert(said.end(), alone.findings.begin(), alone.findings.end());
      specs += compare(*alone.layer, *all.layer);
    }
    EXPECT_EQ(all.layer->spec_count(), specs);
    EXPECT_EQ(all.findings, said);
    compared += specs;
    findings += said.size();
  }
  EXPECT_GT(compared, 20000u);
  EXPECT_GT(findings, 500u);
}

// What a spec got from other statements does not come along with a line that is taken over.
TEST(KnownStatements, ALineBringsOnlyWhatItSays) {
  const Reading reading = read_with_findings(
      "#usda 1.0\n"
      "def \"a\" {\n  float x.timeSamples = { 1: 1 }\n  float x = 1\n}\n"
      "def \"b\" {\n  float x.timeSamples = { 1: 1 }\n  float x = 1\n}\n"
      "def \"c\" {\n  float x = 1\n}\n"
      "def \"d\" {\n  float x = 1\n  float x.timeSamples = { 1: 1 }\n}\n"
      "def \"e\" {\n  float x = 1\n}\n");
  ASSERT_TRUE(reading.layer) << reading.layer.error().to_string();
  const auto fields_at = [&](const char* path) {
    return reading.layer->find(Path::from(path))->fields().size();
  };
  EXPECT_EQ(fields_at("/b.x"), 5u);
  EXPECT_EQ(fields_at("/c.x"), 4u);
  EXPECT_EQ(fields_at("/d.x"), 5u);
  EXPECT_EQ(fields_at("/e.x"), 4u);
}

// An error behind a known head is where and what it is in a text of its own.
TEST(KnownStatements, FaultsAreFoundAsEver) {
  const std::string good = "    double a = 1\n";
  for (const std::string bad :
       {"    double a = x\n", "    double a = 1 2\n", "    double a = (\n", "    double a =\n",
        "    double a = 1 (nonsense\n", "    double a = \"1\n", "    double a = 1\n    int a = 2\n",
        "    double a = /* \n"}) {
    const std::string first =
        "#usda 1.0\ndef \"a\"\n{\n" + good + "}\ndef \"b\"\n{\n" + good + "}\n";
    const std::string last = "def \"c\"\n{\n" + bad + "}\n";
    const std::string alone = "#usda 1.0\n" + as_blanks(first.substr(10)) + last;
    const Reading known = read_with_findings(first + last);
    const Reading unknown = read_with_findings(alone);
    ASSERT_FALSE(known.layer) << bad;
    ASSERT_FALSE(unknown.layer) << bad;
    EXPECT_EQ(known.layer.error().to_string(), unknown.layer.error().to_string());
  }
}

// Lines that come again share their fields; so do the values of blocks of metadata.
TEST(KnownStatements, AreSharedInMemory) {
  std::string text = "#usda 1.0\n";
  for (int i = 0; i < 5; ++i) {
    text += "def \"p" + std::to_string(i) + "\" (\n    kind = \"x\"\n)\n{\n" +
            "    token[] a = [\"x\", \"y\"]\n    rel r\n}\n";
  }
  const Reading reading = read_with_findings(text);
  ASSERT_TRUE(reading.layer);
  const auto list_of = [&](const char* path) {
    return reading.layer->find(Path::from(path))->field_list();
  };
  EXPECT_FALSE(list_of("/p0.a").is_same(list_of("/p4.a")));
  EXPECT_TRUE(list_of("/p2.a").is_same(list_of("/p4.a")));
  EXPECT_TRUE(list_of("/p2").is_same(list_of("/p4")));
}

// More heads than slots: what is forgotten is read again.
TEST(KnownStatements, MayBeForgotten) {
  std::string text = "#usda 1.0\n";
  for (const char* prim : {"a", "b", "c"}) {
    text += std::string("def \"") + prim + "\"\n{\n";
    for (int i = 0; i < 5000; ++i) {
      text += "    int x" + std::to_string(i) + " = " + std::to_string(i) + "\n";
    }
    text += "}\n";
  }
  const Reading reading = read_with_findings(text);
  ASSERT_TRUE(reading.layer);
  for (const std::string prim : {"/a", "/b", "/c"}) {
    for (int i = 0; i < 5000; ++i) {
      const layer::Spec* const spec =
          reading.layer->find(Path::from(prim + ".x" + std::to_string(i)));
      ASSERT_NE(spec, nullptr);
      EXPECT_EQ(spec->get_or(layer::fields::default_value, -1), i);
    }
  }
}

}  // namespace
}  // namespace tenon::formats
