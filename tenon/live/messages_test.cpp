// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/live/messages.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "tenon/live/session.h"

namespace tenon::live {
namespace {

std::string rule_of(const std::string& text) {
  Asked asked;
  const auto read = Listener(requests()).read(text, asked);
  return read ? "" : read.error().diagnostic().rule;
}

TEST(Messages, AreReadByTheirTable) {
  Asked asked;
  const auto index =
      Listener(requests())
          .read(R"({"do":"setDrive","id":7,"joint":"/a/j","position":1.5,"velocity":null})", asked);
  ASSERT_TRUE(index) << index.error().to_string();
  EXPECT_EQ(requests()[*index].name, "setDrive");
  EXPECT_EQ(asked.id(), Json(7));
  EXPECT_EQ(asked.path("joint").str(), "/a/j");
  EXPECT_EQ(asked.number("position"), 1.5);
  EXPECT_FALSE(asked.has("velocity"));
  EXPECT_EQ(asked.number("velocity", 2), 2);
}

TEST(Messages, RefuseWhatIsNoMessage) {
  for (const char* text : {"", "{", "[]", "7", "\"play\"", "{}", R"({"do":7})", R"({"do":null})",
                           R"({"do":"play"} more)", R"({"do":"play","x":1e999})", "\xff"}) {
    EXPECT_EQ(rule_of(text), "live.bad-message") << text;
  }
  EXPECT_EQ(rule_of(std::string(60000, '[')), "live.bad-message");
  EXPECT_EQ(rule_of(R"({"do":"fly"})"), "live.unknown-request");
}

TEST(Messages, RefuseFieldsThatAreNotOfTheirType) {
  for (const char* text :
       {R"({"do":"play","fast":true})", R"({"do":"setDrive"})", R"({"do":"setDrive","joint":7})",
        R"({"do":"setDrive","joint":"a/b"})", R"({"do":"setDrive","joint":"/a","position":"1"})",
        R"({"do":"setDrive","joint":null})", R"({"do":"step","count":-1})",
        R"({"do":"step","count":1.5})", R"({"do":"step","count":10000000})",
        R"({"do":"force","body":"/a","point":[1,2],"force":[0,0,0]})",
        R"({"do":"force","body":"/a","point":[1,2,"3"],"force":[0,0,0]})",
        R"({"do":"observe","plots":1})"}) {
    EXPECT_EQ(rule_of(text), "live.bad-field") << text;
  }
}

TEST(Messages, HaveRowsWithFieldsOfTheirOwn) {
  Asked asked;
  const auto index =
      Listener(requests())
          .read(R"({"do":"setLimits","limits":[{"joint":"/a/j","dof":"rotX","maxEffort":2,)"
                R"("speedLimit":null}]})",
                asked);
  ASSERT_TRUE(index) << index.error().to_string();
  const std::vector<Asked> rows = asked.rows("limits");
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].path("joint").str(), "/a/j");
  EXPECT_EQ(rows[0].number("maxEffort"), 2);
  EXPECT_FALSE(rows[0].has("speedLimit"));
  std::string many = R"({"do":"testDrives","test":"snap","joints":["/a")";
  for (int i = 0; i < 256; ++i) {
    many += R"(,"/a")";
  }
  for (const std::string& text : std::vector<std::string>{
           R"({"do":"setLimits","limits":{}})", R"({"do":"setLimits","limits":[7]})",
           R"({"do":"setLimits","limits":[{"joint":"/a"}]})",
           R"({"do":"setLimits","limits":[{"joint":"a","dof":"rotX"}]})",
           R"({"do":"setLimits","limits":[{"joint":"/a","dof":"rotX","x":1}]})",
           R"({"do":"setLimits","limits":[{"joint":"/a","dof":"rotX","maxEffort":[[[]]]}]})",
           R"({"do":"filterPairs","filter":[{"bodyA":"/etc/x.srdf","bodyB":"/b"}]})",
           R"({"do":"filterPairs","filter":["/a,/b"]})",
           R"({"do":"testDrives","test":"snap","joints":["a.*"]})", many + "]}"}) {
    EXPECT_EQ(rule_of(text), "live.bad-field") << text.substr(0, 80);
  }
}

TEST(Messages, OfStrangersAreAnsweredWithTheirId) {
  Asked asked;
  EXPECT_FALSE(Listener(requests()).read(R"({"do":"fly","id":"x"})", asked));
  EXPECT_EQ(asked.id(), Json("x"));
  EXPECT_EQ(asked.name(), "fly");
}

TEST(Messages, HaveSchemas) {
  const Json tables = messages_json(requests());
  std::set<std::string> names;
  for (const char* list : {"requests", "notices"}) {
    for (const Json& row : tables[list]) {
      EXPECT_TRUE(names.insert(std::string(list) + row["name"].get<std::string>()).second);
      EXPECT_FALSE(row["meaning"].get<std::string>().empty());
      EXPECT_EQ(row["schema"]["additionalProperties"], false);
      const char* tag = list == std::string("requests") ? "do" : "is";
      EXPECT_EQ(row["schema"]["properties"][tag]["const"], row["name"]);
      EXPECT_EQ(row.contains("result"), tag == std::string("do")) << row["name"];
    }
  }
  EXPECT_EQ(names.size(), requests().size() + notices().size());
}

TEST(Messages, HaveSchemasOfWhatIsInThem) {
  const Json tables = messages_json(requests());
  const auto row = [&](const char* list, const char* name) {
    return *std::find_if(tables[list].begin(), tables[list].end(),
                         [&](const Json& one) { return one["name"] == name; });
  };
  const Json scene = row("notices", "scene")["schema"];
  const Json joint = scene["properties"]["joints"]["items"];
  EXPECT_EQ(joint["title"], "LiveJoint");
  EXPECT_EQ(joint["additionalProperties"], false);
  EXPECT_EQ(joint["properties"]["dofs"]["items"]["properties"]["lower"]["type"],
            Json::array({"number", "null"}));
  EXPECT_EQ(scene["properties"]["problem"]["title"], "Finding");
  EXPECT_EQ(scene["required"].size(), scene["properties"].size()) << "all of it, or null";
  EXPECT_FALSE(scene["properties"]["bodies"].contains("maxItems"));
  const Json tested = row("requests", "testDrives")["result"];
  EXPECT_EQ(tested["properties"]["engines"]["items"]["properties"]["results"]["items"]["title"],
            "Tested");
  EXPECT_EQ(tested["additionalProperties"], true) << "as the verb has them";
  const Json step = row("requests", "step");
  EXPECT_EQ(step["schema"]["properties"]["count"]["maximum"], 1000);
  EXPECT_EQ(step["result"]["properties"], Json::object());
}

}  // namespace
}  // namespace tenon::live
