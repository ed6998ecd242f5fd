// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/text/xml_text.h"

#include <gtest/gtest.h>

namespace tenon {
namespace {

TEST(XmlText, MakesEntitiesOfTheLettersThatAreAskedFor) {
  EXPECT_EQ(xml_text("a & b < c > \"d\""), "a &amp; b &lt; c > &quot;d&quot;");
  EXPECT_EQ(xml_text("a & b < c > \"d\"", "&<>\""), "a &amp; b &lt; c &gt; &quot;d&quot;");
  EXPECT_EQ(xml_text("'plain'"), "'plain'");
}

}  // namespace
}  // namespace tenon
