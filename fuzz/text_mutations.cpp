// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/text_mutations.h"

#include <algorithm>
#include <iterator>
#include <span>
#include <string_view>
#include <utility>

namespace tenon::fuzz {
namespace {

constexpr std::string_view kNumbers[] = {"0",
                                         "-1",
                                         "1e308",
                                         "-1e308",
                                         "1e-320",
                                         "inf",
                                         "-inf",
                                         "nan",
                                         "2147483647",
                                         "-2147483648",
                                         "4294967295",
                                         "9223372036854775807",
                                         "-9223372036854775808",
                                         "18446744073709551615",
                                         "65504",
                                         "0.1",
                                         "1000000",
                                         "-3",
                                         "1e-300",
                                         "1e14",
                                         "1000000000",
                                         "3"};
constexpr std::string_view kUsdWords[] = {"{",
                                          "}",
                                          "(",
                                          ")",
                                          "[",
                                          "]",
                                          "<",
                                          ">",
                                          "=",
                                          ",",
                                          ";",
                                          ":",
                                          "@",
                                          "@@@",
                                          "\"",
                                          "'''",
                                          "\"\"\"",
                                          "\n",
                                          "\r\n",
                                          std::string_view("\0", 1),
                                          "\xef\xbb\xbf",
                                          "\xc3\x28",
                                          "\\",
                                          "#",
                                          "None",
                                          "def ",
                                          "over ",
                                          "class ",
                                          "\"A\"",
                                          "</A>",
                                          "</A{v=x}B>",
                                          "<../../..>",
                                          ".timeSamples",
                                          ".connect",
                                          ".spline",
                                          "references",
                                          "payload",
                                          "inherits",
                                          "specializes",
                                          "variantSet \"v\"",
                                          "variants",
                                          "subLayers",
                                          "relocates",
                                          "dictionary",
                                          "prepend ",
                                          "append ",
                                          "delete ",
                                          "add ",
                                          "reorder ",
                                          "1e400",
                                          "-inf",
                                          "nan",
                                          "0x7fffffff",
                                          "-9223372036854775809",
                                          "18446744073709551616",
                                          "1_000",
                                          "`${A}`",
                                          "matrix4d m = ((",
                                          "quath",
                                          "double3[]",
                                          "timecode",
                                          "pathExpression",
                                          "rel r",
                                          "uniform ",
                                          "custom ",
                                          "varying ",
                                          "offset = ",
                                          "scale = 0",
                                          "instanceable = true",
                                          "clips",
                                          "bezier",
                                          "loop repeat",
                                          "AnimationBlock"};
constexpr std::string_view kXmlWords[] = {
    "<",
    ">",
    "/>",
    "</",
    "<!--",
    "-->",
    "<![CDATA[",
    "]]>",
    "<?xml version=\"1.0\"?>",
    "<!DOCTYPE a [<!ENTITY b \"bbbbbbbb\">]>",
    "&b;",
    "&#x0;",
    "&#1114112;",
    "&lt;",
    "\"",
    "'",
    "=",
    " ",
    "\n",
    std::string_view("\0", 1),
    "\xef\xbb\xbf",
    "\xff\xfe",
    " name=\"\"",
    " count=\"-1\"",
    " count=\"4294967295\"",
    " size=\"0 0 0\"",
    " scale=\"nan nan nan\"",
    " filename=\"../../../etc/passwd\"",
    " filename=\"package://a/../b\"",
    " file=\"/dev/zero\"",
    " xyz=\"1e308 -1e308 inf\"",
    " stride=\"0\"",
    " offset=\"4294967295\"",
    " source=\"#nowhere\"",
    " nuser_geom=\"1000000000\"",
    " nrow=\"30000\" ncol=\"30000\"",
    " range=\"1 -1\"",
    " class=\"none\"",
    "<body>",
    "<geom size=\"1\"/>",
    "<include file=\"model.xml\"/>",
    "<replicate count=\"1000000\">",
    "<composite type=\"grid\" count=\"1000 1000 1\" spacing=\"1\"/>",
    "<flexcomp type=\"grid\" count=\"100 100 100\" name=\"f\"/>",
    "<joint type=\"ball\"/>",
    "<freejoint/>",
    "<mesh file=\"m.obj\"/>",
    "<link name=\"a\"/>",
    "<mimic joint=\"a\"/>",
    "<safety_controller k_velocity=\"1\"/>",
    "<node>",
    "</node>",
    "<p>0 4294967295 -1</p>",
    "<instance_geometry url=\"#g\"/>",
    "<float_array id=\"x\" count=\"4294967295\">",
    "<triangles count=\"2147483647\">"};
constexpr std::string_view kJsonWords[] = {"{",
                                           "}",
                                           "[",
                                           "]",
                                           ",",
                                           ":",
                                           "\"",
                                           "\\u0000",
                                           "\\ud800",
                                           "null",
                                           "true",
                                           "false",
                                           "-1",
                                           "1e999",
                                           "4294967295",
                                           "18446744073709551615",
                                           "\"count\": 4294967295",
                                           "\"byteOffset\": -1",
                                           "\"byteLength\": 4294967295",
                                           "\"byteStride\": 0",
                                           "\"bufferView\": 99",
                                           "\"componentType\": 5121",
                                           "\"type\": \"MAT4\"",
                                           "\"sparse\": {\"count\": 9}",
                                           "\"mode\": 7",
                                           "\"children\": [0]",
                                           "\"mesh\": -1",
                                           "\"uri\": \"/etc/passwd\"",
                                           "\"uri\": \"data:;base64,AAAA\"",
                                           "\"matrix\": [1]",
                                           "\"extensions\": {}",
                                           "\n",
                                           std::string_view("\0", 1),
                                           "\xff"};
constexpr std::string_view kMeshWords[] = {"facet normal 0 0 1",
                                           "outer loop",
                                           "vertex nan inf -inf",
                                           "endloop",
                                           "endfacet",
                                           "endsolid",
                                           "solid",
                                           "v 1e308 -1e308 1e400\n",
                                           "v 0 0\n",
                                           "vn 0 0 0\n",
                                           "vt 0\n",
                                           "f 1 2 3\n",
                                           "f -1 -2 -3\n",
                                           "f 1//1 2//2 99999999//1\n",
                                           "f 0 0 0\n",
                                           "f 2147483648 1 2\n",
                                           "f 1/2/3/4/5 1 1\n",
                                           "g a\n",
                                           "o b\n",
                                           "usemtl none\n",
                                           "mtllib nowhere.mtl\n",
                                           "map_Kd ../../etc/passwd\n",
                                           "\\\n",
                                           "#",
                                           "\n",
                                           "\r",
                                           " ",
                                           "/",
                                           std::string_view("\0", 1),
                                           "\xff",
                                           "p 1\n",
                                           "l 1 2\n",
                                           "curv 0 1 1 2\n",
                                           "1e",
                                           "--1"};

std::span<const std::string_view> words_of(Grammar grammar) {
  switch (grammar) {
    case Grammar::Usd:
      return kUsdWords;
    case Grammar::Xml:
      return kXmlWords;
    case Grammar::Json:
      return kJsonWords;
    case Grammar::Mesh:
      return kMeshWords;
  }
  return kUsdWords;
}

/// Start and length, line feed included, of the line that holds byte `at`.
std::pair<std::size_t, std::size_t> line_around(const std::string& text, std::size_t at) {
  const std::size_t before = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
  const std::size_t start = before == std::string::npos ? 0 : before + 1;
  const std::size_t end = text.find('\n', at);
  return {start, (end == std::string::npos ? text.size() : end + 1) - start};
}

/// Lines left out, repeated and moved: most such texts still are layers.
void mutate_lines(std::string& text, Dice& dice) {
  const auto [from, length] = line_around(text, dice.below(text.size() + 1));
  const std::string line = text.substr(from, length);
  switch (dice.below(4)) {
    case 0:
      text.erase(from, length);
      break;
    case 1:
      text.insert(from, line);
      break;
    default:
      text.insert(line_around(text, dice.below(text.size() + 1)).first, line);
      break;
  }
}

/// A number or name of the text replaced by an extreme or by another of its own.
void mutate_literal(std::string& text, Dice& dice) {
  constexpr std::string_view kLiteral =
      "0123456789.-abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_:";
  const auto literal = [&](std::size_t near) {
    const std::size_t start = std::min(text.find_first_of(kLiteral, near), text.size());
    return std::pair(start, std::min(text.find_first_not_of(kLiteral, start), text.size()) - start);
  };
  const auto [at, length] = literal(dice.below(text.size() + 1));
  const auto [other, other_length] = literal(dice.below(text.size() + 1));
  const bool number = at < text.size() && text[at] <= '9';
  const std::string_view extreme = kNumbers[dice.below(std::size(kNumbers))];
  text.replace(at, length,
               number && dice.one_in(2) ? std::string(extreme) : text.substr(other, other_length));
}

void mutate_words(std::string& text, std::span<const std::string_view> words, Dice& dice) {
  const std::size_t at = dice.below(text.size() + 1);
  const std::size_t from = dice.below(text.size() + 1);
  switch (dice.below(5)) {
    case 0:
    case 1:
      text.insert(at, words[dice.below(words.size())]);
      break;
    case 2:
      text.erase(at, dice.below(64));
      break;
    case 3:
      text.insert(at, text.substr(from, dice.below(256)));
      break;
    default: {  // repeated as a hostile file would have it
      const std::string piece = dice.one_in(2) ? text.substr(from, dice.below(24) + 1)
                                               : std::string(words[dice.below(words.size())]);
      const std::size_t times = std::size_t{1} << dice.below(13);
      std::string many;
      for (std::size_t i = 0; i < times; ++i) {
        many += piece;
      }
      text.insert(at, many);
      break;
    }
  }
}

/// Start and length of what stands between `open` and the next `close`, at or behind byte `at`.
std::pair<std::size_t, std::size_t> between(const std::string& text, std::string_view open,
                                            char close, std::size_t at) {
  at = text.find(open, at);
  const std::size_t start = at == std::string::npos ? text.size() : at + open.size();
  const std::size_t end = text.find(close, start);
  return {start, end == std::string::npos ? 0 : end - start};
}

/// A number, or the value of an attribute, replaced by another one: the markup around it stays.
void mutate_value(std::string& text, Dice& dice) {
  const std::size_t near = dice.below(text.size() + 1);
  const std::size_t other = dice.below(text.size() + 1);
  if (dice.one_in(3)) {
    const auto [at, length] = between(text, "=\"", '"', near);
    const auto [from, other_length] = between(text, "=\"", '"', other);
    text.replace(at, length, text.substr(from, other_length));
    return;
  }
  constexpr std::string_view kNumber = "0123456789.eE+-";
  const auto number = [&](std::size_t from) {
    const std::size_t start = std::min(text.find_first_of("0123456789", from), text.size());
    return std::pair(start, std::min(text.find_first_not_of(kNumber, start), text.size()) - start);
  };
  const auto [at, length] = number(near);
  const auto [from, other_length] = number(other);
  const std::string extreme(kNumbers[dice.below(std::size(kNumbers))]);
  text.replace(at, length, dice.one_in(3) ? text.substr(from, other_length) : extreme);
}

/// Start and length of the innermost bracketed piece around byte `at`; nothing: length 0.
std::pair<std::size_t, std::size_t> block_around(const std::string& text, std::size_t at) {
  std::size_t open = 0;
  std::size_t depth = 0;
  for (open = at; open > 0; --open) {
    const char c = text[open - 1];
    depth += c == '}' || c == ']' || c == ')' ? 1 : 0;
    if (c == '{' || c == '[' || c == '(') {
      if (depth == 0) {
        break;
      }
      --depth;
    }
  }
  if (open == 0) {
    return {0, 0};
  }
  depth = 0;
  for (std::size_t end = open; end < text.size(); ++end) {
    const char c = text[end];
    depth += c == '{' || c == '[' || c == '(' ? 1 : 0;
    if (c == '}' || c == ']' || c == ')') {
      if (depth == 0) {
        return {open - 1, end + 2 - open};
      }
      --depth;
    }
  }
  return {0, 0};
}

/// Start and length of an element that begins at or behind byte `at`; nothing: length 0.
std::pair<std::size_t, std::size_t> element_behind(const std::string& text, std::size_t at) {
  while ((at = text.find('<', at)) != std::string::npos) {
    const std::size_t name_end = std::min(text.find_first_of(" \t\n/>", at + 1), text.size());
    const std::string name = text.substr(at + 1, name_end - at - 1);
    const std::size_t tag_end = text.find('>', at);
    if (name.empty() || name[0] == '/' || name[0] == '!' || name[0] == '?' ||
        tag_end == std::string::npos) {
      ++at;
      continue;
    }
    if (text[tag_end - 1] == '/') {
      return {at, tag_end + 1 - at};
    }
    const std::size_t close = text.find("</" + name + ">", tag_end);
    return {at, (close == std::string::npos ? tag_end + 1 : close + name.size() + 3) - at};
  }
  return {0, 0};
}

/// A block or element taken out, repeated beside itself, or put into itself many times over.
void mutate_block(std::string& text, Grammar grammar, Dice& dice) {
  const std::size_t near = dice.below(text.size() + 1);
  const auto [at, length] =
      grammar == Grammar::Xml ? element_behind(text, near) : block_around(text, near);
  if (length < 2) {
    return;
  }
  const std::string block = text.substr(at, length);
  const std::size_t middle = at + (grammar == Grammar::Xml ? block.find('>') + 1 : length / 2);
  switch (dice.below(4)) {
    case 0:
      text.erase(at, length);
      break;
    case 1:
      text.insert(at, block);
      break;
    case 2:
      text.insert(std::min(middle, text.size()), block);
      break;
    default: {  // deeper and deeper
      const std::size_t head = std::min(middle - at, length);
      const std::size_t times = std::size_t{1} << dice.below(13);
      std::string start;
      std::string end;
      for (std::size_t i = 0; i < times && start.size() < (1u << 20); ++i) {
        start += block.substr(0, head);
        end += block.substr(head);
      }
      text.replace(at, length, start + (dice.one_in(4) ? "" : end));
      break;
    }
  }
}

/// A piece of another file put in, or the two joined in the middle.
void splice(std::string& text, std::string_view other, Dice& dice) {
  if (other.empty()) {
    return;
  }
  const std::size_t from = dice.below(other.size());
  if (dice.one_in(2)) {
    text.insert(dice.below(text.size() + 1), other.substr(from, dice.below(2000)));
  } else {
    text.resize(dice.below(text.size() + 1));
    text += other.substr(from);
  }
}

}  // namespace

std::string mutate_text(std::string_view text, const TextMutation& how, Dice& dice) {
  std::string result(text);
  const std::size_t times = dice.one_in(2) ? 1 : dice.below(4) + 1;
  const bool marked_up = how.grammar == Grammar::Xml || how.grammar == Grammar::Json;
  const std::size_t kinds = dice.one_in(2) ? 7 : 12;  // the first ones often leave it well formed
  for (std::size_t i = 0; i < times; ++i) {
    switch (dice.below(kinds)) {
      case 4:
        mutate_block(result, how.grammar, dice);
        break;
      case 5:
      case 6:
        if (marked_up) {
          mutate_block(result, how.grammar, dice);
        } else {
          mutate_lines(result, dice);
        }
        break;
      case 7:
        mutate_bytes(result, dice);
        break;
      case 8:
      case 9:
        mutate_words(result, words_of(how.grammar), dice);
        break;
      case 10:
        splice(result, how.other, dice);
        break;
      case 11:
        result.resize(dice.below(result.size() + 1));
        break;
      default:
        if (marked_up && !dice.one_in(8)) {
          mutate_value(result, dice);
        } else {
          mutate_literal(result, dice);
        }
        break;
    }
  }
  if (result.size() > how.max_bytes) {
    result.resize(how.max_bytes);
  }
  return result;
}

}  // namespace tenon::fuzz
