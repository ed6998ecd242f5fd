#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The checks of this folder reject what they are there to reject."""

import os
import pathlib
import tempfile
import types
import unittest
from unittest import mock

import check_answers
import check_folders
import check_limits
import check_links
import check_outputs
import check_sizes
import check_snippets
import check_text
import check_words
import make_architecture
import report_counts
import tidy

RULE = "base :\nlayer : base\nengines : base\nengines/mujoco : base engines\ntenon : base layer\n"
RULE += "engines tests : layer\n"


def tree(files):
    """A temporary project with these files {path: text}; the caller closes it."""
    root = tempfile.TemporaryDirectory()
    for path, text in {"tenon/folders.txt": RULE, **files}.items():
        full = os.path.join(root.name, path)
        os.makedirs(os.path.dirname(full), exist_ok=True)
        with open(full, "w", encoding="utf-8") as file:
            file.write(text)
    return root


class Folders(unittest.TestCase):
    CASES = [
        # file, include line, allowed
        ("tenon/layer/a.h", '#include "tenon/base/b.h"', True),
        ("tenon/layer/a.h", '#include "tenon/layer/sub/b.h"', True),
        ("tenon/layer/sub/a.h", '#include "tenon/base/b.h"', True),
        ("tenon/layer/a.h", "#include <vector>", True),
        ("tenon/base/a.h", '#include "tenon/layer/b.h"', False),
        ("tenon/base/a.h", '#  include "tenon/layer/b.h"', False),
        ("tenon/base/a.h", '#include "tenon/tenon.h"', False),
        ("tenon/tenon.h", '#include "tenon/layer/b.h"', True),
        ("tenon/tenon.h", '#include "tenon/engines/mujoco/b.h"', True),
        ("tenon/wiring.h", '#include "tenon/engines/b.h"', False),
        ("tenon/wiring.h", '#include "tenon/tenon.h"', False),
        ("tenon/engines/a.h", '#include "tenon/engines/mujoco/b.h"', False),
        ("tenon/engines/mujoco/a.h", '#include "tenon/engines/b.h"', True),
        ("tenon/engines/a.cpp", '#include "tenon/layer/b.h"', False),
        ("tenon/engines/a_test.cpp", '#include "tenon/layer/b.h"', True),
        ("tenon/engines/test_a.h", '#include "tenon/layer/b.h"', True),
        ("tenon/engines/a.cpp", '#include "tenon/engines/test_a.h"', False),
        ("tenon/engines/a_test.cpp", '#include "tenon/engines/test_a.h"', True),
        ("tenon/layer/a.h", '#include "cli/b.h"', False),
        ("tenon/layer/a.h", '#include "b.h"', False),
        ("tenon/unlisted/a.h", "", False),
        ("tenon/layer/a.cpp", "#include <lz4.h>", False),
        ("tenon/layer/a.h", "#include <Eigen/Core>", False),
        ("tenon/engines/mujoco/mujoco_library.h", "#include <mujoco/mujoco.h>", True),
        ("tenon/engines/mujoco/a.cpp", "#include <mujoco/mujoco.h>", False),
        ("cli/a.cpp", '#include "tenon/layer/b.h"', True),
        ("cli/a.cpp", "#include <mujoco/mujoco.h>", False),
    ]

    def test_include_lines(self):
        for path, line, allowed in self.CASES:
            with self.subTest(path=path, line=line), tree({path: line + "\n"}) as root:
                files, faults = check_folders.check(root)
                self.assertEqual(files, [path])
                self.assertEqual(faults == [], allowed, faults)

    DISK_CASES = [
        # file, line, allowed
        ("tenon/layer/a.cpp", "fs::path(name).parent_path();", True),
        ("tenon/layer/a.cpp", "namespace fs = std::filesystem;", True),
        ("tenon/layer/a.cpp", "fs::exists(name, error);", False),
        ("tenon/layer/a.cpp", "std::filesystem::recursive_directory_iterator at(name);", False),
        ("tenon/layer/a.cpp", "using namespace std::filesystem;", False),
        ("tenon/layer/a.cpp", "bytes::FileBytes::open(name);", False),
        ("tenon/layer/a.cpp", "bytes::FileBytes::own(text);", True),
        ("tenon/layer/a.cpp", "bytes::AssetResolver().open(name);", False),
        ("tenon/layer/a.cpp", "bytes::Files()->open(name, {});", False),
        ("tenon/layer/a.h", "  bytes::Files files;", True),
        ("tenon/layer/a.cpp", "std::ifstream file(name);", False),
        ("tenon/layer/a.cpp", "#include <fstream>", False),
        ("tenon/layer/a.cpp", "// fs::exists(name)", True),
        ("tenon/layer/a.cpp", 'say("fs::exists(name)");', True),
        ("tenon/layer/a_test.cpp", "fs::exists(name, error);", True),
        ("tenon/base/a.cpp", "fs::exists(name, error);", True),
        ("tenon/guard/workers.cpp", "fs::exists(name, error);", True),
        ("tenon/guard/workers.cpp", "fs::path(name);", False),  # need not be an exception
        ("cli/a.cpp", "fs::exists(name, error);", True),
    ]

    def test_who_asks_the_disk(self):
        rule = {"tenon/folders.txt": RULE + "guard : base\n"}
        for path, line, allowed in self.DISK_CASES:
            with self.subTest(path=path, line=line), tree({path: line + "\n", **rule}) as root:
                faults = check_folders.check(root)[1]
                self.assertEqual(faults == [], allowed, faults)

    def test_own_header_first(self):
        own, other = '#include "tenon/layer/a.h"\n', '#include "tenon/base/b.h"\n'
        for text, faults in ((own + other, 0), (other + own, 1), ("", 0)):
            files = {"tenon/layer/a.h": "", "tenon/layer/a.cpp": text}
            with self.subTest(text=text), tree(files) as root:
                self.assertEqual(len(check_folders.check(root)[1]), faults)

    def test_cycle(self):
        with tree({"tenon/folders.txt": "a : b\nb : a\n"}) as root:
            self.assertEqual(len(check_folders.check(root)[1]), 1)


class Outputs(unittest.TestCase):
    FILES = {
        "tenon/bytes/put.h": "", "tenon/bytes/put.cpp": "int f() { return ::rename(a, b); }\n",
        "tenon/bytes/many.h": "", "tenon/bytes/many.cpp": '#include "tenon/bytes/put.h"\n',
        "tenon/bytes/get.h": "",
        "tenon/formats/save.cpp": '#include "tenon/bytes/many.h"\nvoid save_layer(int a) {\n'
                                  "  write_file(a);\n}\nvoid read_layer() {\n  get();\n}\n",
        "tenon/asset/edit.cpp": "void write_all(int a) {\n  formats::save_layer(a);\n}\n",
        "cli/output.cpp": '#include "tenon/bytes/put.h"\nint g() { return std::fwrite(a); }\n',
    }
    CASES = [
        # file, line, allowed
        ("cli/a.cpp", '#include "tenon/bytes/get.h"', True),
        ("cli/a.cpp", '#include "tenon/bytes/put.h"', False),
        ("cli/a.cpp", '#include "tenon/bytes/many.h"', False),
        ("cli/a.cpp", "formats::read_layer();", True),
        ("cli/a.cpp", "formats::save_layer(1);", False),
        ("cli/a.cpp", "write_all(1);", False),
        ("cli/a.cpp", "other::write_all(1);", True),
        ("cli/a.cpp", 'std::printf("x");', False),
        ("cli/a.cpp", 'std::fprintf(stderr, "x");', True),
        ("cli/a.cpp", 'std::fprintf(stdout, "x");', False),
        ("cli/a.cpp", "std::fputs(a.c_str(), stdout);", False),
        ("cli/a.cpp", "std::ofstream(a) << 1;", False),
        ("cli/a.cpp", "std::cout << 1;", False),
        ("cli/a.cpp", "// std::cout << 1;", True),
        ("cli/a.cpp", 'say("a tree that puts std::cout to sleep");', True),
        ("cli/a_test.cpp", "std::ofstream(a) << 1;", True),
        ("tenon/layer/a.cpp", 'std::fopen(name, "w");', False),
        ("tenon/layer/a.cpp", 'std::fopen("/dev/null", "w");', True),
        ("tenon/layer/a.cpp", "::open(a, O_CREAT);", False),
        ("tenon/bytes/a.cpp", "::open(a, O_CREAT);", True),
    ]

    def test_who_writes(self):
        for path, line, allowed in self.CASES:
            files = {**self.FILES, path: line + "\n"}
            with self.subTest(path=path, line=line), tree(files) as root:
                faults = check_outputs.check(root, list(files))
                self.assertEqual(faults == [], allowed, faults)


class Answers(unittest.TestCase):
    CASES = [
        # file, line, allowed
        ("cli/a.cpp", "return report.finish(kOk, edited_json(edits));", True),
        ("cli/a.cpp", 'print(answer["masses"].get<std::string>());', True),
        ("cli/a.cpp", 'if (answer["prim"] == name) {', True),
        ("cli/a.cpp", "const Json answer = answers::info_json(stage);", True),
        ("cli/a.cpp", 'rows.push_back({"body", "mass"});', True),
        ("cli/a.cpp", '// return {{"rule", id}};', True),
        ("cli/a.cpp", "#include <nlohmann/json.hpp>", False),
        ("cli/a.cpp", 'return report.finish(kOk, {{"rule", id}, {"page", page}});', False),
        ("cli/a.cpp", 'return report.finish(\n    kOk,\n    {{"rule", id}});', False),
        ("cli/a.cpp", 'return {{"rule", id}};', False),
        ("cli/a.cpp", 'rows.push_back({{"rule", id}});', False),
        ("cli/a.cpp", "Json rows = Json::array();", False),
        ("cli/a.cpp", "const Json json = Json::parse(text);", False),
        ("cli/a.cpp", "return text.empty() ? Json(nullptr) : other;", False),
        ("cli/a.cpp", 'body["prims"] = tree;', False),
        ("cli/a.cpp", "Json body;", False),
        ("cli/a.cpp", 'const Json body = {{"rule", id}};', False),
        ("cli/a.cpp", "print_data(body.dump(2));", False),
        ("cli/text/command_json.cpp", "Json rows = Json::array();", True),
        ("cli/a_test.cpp", "Json rows = Json::array();", True),
        ("tenon/asset/a.cpp", "Json rows = Json::array();", True),
    ]

    def test_who_builds_json(self):
        for path, line, allowed in self.CASES:
            with self.subTest(path=path, line=line), tree({path: line + "\n"}) as root:
                faults = check_answers.check(root, [path])
                self.assertEqual(faults == [], allowed, faults)


class Limits(unittest.TestCase):
    TABLE = "inline constexpr std::size_t kOne = 1'000;\ninline constexpr int kTwo = 1u << 20;\n"
    PAGE = "| `kOne` | 1000 | a |\n| `kTwo` | 1 048 576 | b |\n"
    USE = "int x = limits::kOne + limits::kTwo;\n"

    def faults(self, page=PAGE, use=USE):
        files = {"tenon/base/limits/limits.h": self.TABLE, check_limits.PAGE: page,
                 "tenon/a.cpp": use}
        with tree(files) as root:
            return check_limits.check(root, list(files))

    def test_good(self):
        self.assertEqual(self.faults(), [])

    def test_bad(self):
        self.assertEqual(len(self.faults(use="limits::kOne\n")), 1)
        self.assertEqual(len(self.faults(page=self.PAGE.replace("1000", "1001"))), 1)
        self.assertEqual(len(self.faults(page=self.PAGE.replace("kOne", "kThree"))), 2)


class Sizes(unittest.TestCase):
    def run_on(self, lines, exceptions=""):
        one = types.SimpleNamespace(
            name="f", start_line=3, nloc=lines, cyclomatic_complexity=1)
        files = {"tools/size_exceptions.txt": exceptions, "tenon/base/a.cpp": "x\n"}
        with tree(files) as root:
            return check_sizes.check(
                root, lambda path, text: types.SimpleNamespace(function_list=[one]))[1]

    def test_limit(self):
        self.assertEqual(self.run_on(60), [])
        self.assertEqual(len(self.run_on(61)), 1)

    def test_exception_is_used_or_a_fault(self):
        excuse = "tenon/base/a.cpp | f | a decoder's switch\n"
        self.assertEqual(self.run_on(61, excuse), [])
        self.assertEqual(len(self.run_on(60, excuse)), 1)

    def test_long_files_have_a_head(self):
        licence, body = "// a\n// b\n", "int x;\n" * 150
        self.assertTrue(check_sizes.lacks_head("tenon/base/a.cpp", licence + body))
        self.assertTrue(check_sizes.lacks_head("cli/a.cpp", licence + "\n" + body))
        for path, text in [("tenon/base/a.cpp", licence + "//\n// Why.\n" + body),
                           ("tenon/base/a_test.cpp", licence + body),
                           ("tenon/base/a.h", licence + body), ("tests/a.cpp", licence + body),
                           ("tenon/base/a.cpp", licence + "int x;\n")]:
            self.assertFalse(check_sizes.lacks_head(path, text), path)


class Architecture(unittest.TestCase):
    FOLDERS = ("# Head.\n\nbase :\n# words\n#    of all\n#+ a limit | `a.h`\n#    and `b.h`\n"
               "layer : base\n# one layer\n#> text -> Layer\nstage : base layer\n# the scene\n"
               "#@ cli/\n# the command\n\n# Tests.\nstage tests : base\n")
    MARKS = make_architecture.BEGIN + make_architecture.END

    def made(self, folders, document):
        with tree({"tenon/folders.txt": folders, "ARCHITECTURE.md": document}) as root:
            texts, faults = make_architecture.made(pathlib.Path(root))
            return [texts[path] for path in sorted(texts)], faults

    def test_table_and_page(self):
        (table, page), faults = self.made(self.FOLDERS, "Before.\n" + self.MARKS + "Behind.\n")
        self.assertEqual(faults, [])
        self.assertIn("| `tenon/base` | words of all |  |  |\n", table)
        self.assertIn("| `tenon/layer` | one layer | text -> Layer | base |\n", table)
        self.assertIn("| `tenon/stage` | the scene |  | layer |\n| `cli/` | the command |", table)
        self.assertTrue(table.startswith("Before.\n") and table.endswith("Behind.\n"))
        self.assertIn("## tenon/base\n\n| to add | go to |\n|---|---|\n"
                      "| a limit | `a.h` and `b.h` |\n", page)

    def test_faults(self):
        self.assertEqual(len(self.made("base :\n", self.MARKS)[1]), 1)
        self.assertEqual(len(self.made(self.FOLDERS, "no marks\n")[1]), 1)


class Classes(unittest.TestCase):
    # What stands in the private part of a class, and how many member functions that are.
    CASES = [
        ("int f();", 1),
        ("int f(); int g() const { return h(1); }", 2),
        ("A(); explicit A(int a) : a_(a), b_{a} { f(); } ~A();", 3),
        ("bool operator()(int a) const; A& operator=(A&&) = default; bool operator<(const A&);", 3),
        ("template <class T>\nvoid f(const T& call);", 1),
        ("template <class T>\n  requires(sizeof(T) > 1)\nvoid f(const T& call);", 1),
        ("static Result<std::vector<int>> f(std::function<void(int)> call = [] { g(); });", 1),
        ("[[nodiscard]] virtual auto f() -> int = 0;", 1),
        ("std::function<void(int)> call_; std::vector<int> list_{f(1)}; int a_ = g(2);", 0),
        ("int a_ = 0; std::array<int, 3> b_{}; const char* c_ = \"f();\"; char d_ = ';';", 0),
        ("// int f();\n/* int g(); */\n#define H int h();\n", 0),
        ("friend class B; friend int f(A a); using B::B; static_assert(f(1));", 0),
        ("struct B { int f(); int a = 0; }; enum class C { One }; B b_;", 0),
        ("public: int f(); private: int g(); protected: int h();", 1),
    ]

    def count(self, text):
        return {name: count for name, _, count in report_counts.classes(text)}

    def test_counts(self):
        for text, wanted in self.CASES:
            with self.subTest(text=text):
                inside = f"class A final : public Base<int> {{\n {text}\n}};\n"
                self.assertEqual(self.count(inside)["A"], wanted)

    def test_what_is_public_does_not_count(self):
        self.assertEqual(self.count("struct A {\n int f();\n};\n"), {"A": 0})
        self.assertEqual(self.count("struct A {\n int f();\n private:\n int g();\n};\n"), {"A": 1})
        self.assertEqual(self.count("enum class A { One };\nclass B;\n"), {})
        self.assertEqual(self.count("struct A { class B { int f(); }; };\n"), {"A": 0, "B": 1})

    def test_rows(self):
        text = "class A {\n" + "".join(f"  int f{i}();\n" for i in range(21)) + "};\n"
        with tree({"tenon/base/a.h": text, "tenon/base/b.cpp": "class B {};\n"}) as root:
            self.assertEqual(report_counts.class_rows(root)[0], (21, "tenon/base/a.h", 1, "A"))
            self.assertEqual(report_counts.folder_rows(root), [(2, "tenon/base")])


class Snippets(unittest.TestCase):
    PROGRAM = "int main() {\n  if (true) {\n    first();\n      second();\n  }\n}\n"

    def faults(self, snippet):
        page = f"# Page\n\n```cpp\n{snippet}```\n"
        with tree({"docs/cpp/a.md": page, "examples/cpp/a.cpp": self.PROGRAM}) as root:
            return check_snippets.check(root)[1]

    def test_parts_of_programs(self):
        for good in ("first();\n", "first();\n  second();\n", self.PROGRAM):
            self.assertEqual(self.faults(good), [], good)
        # Both the snippet and the program that no page shows are faults.
        for bad in ("third();\n", "first();\nsecond();\n", "  first();\n"):
            self.assertEqual(len(self.faults(bad)), 2, bad)

    def test_short_names_are_explained(self):
        program = ("using a::layer::Value;\nnamespace fs = std::filesystem;\n\n"
                   "void f() {\n  Value v = b::Value(1);\n  g(x.fs);\n}\n")
        shown = "using a::layer::Value;\n```\n\n```cpp\n"
        for snippet, faults in (("Value v = b::Value(1);\n", 1), ("g(x.fs);\n", 0),
                                (shown + "Value v = b::Value(1);\n", 0), (program, 0)):
            page = f"```cpp\n{snippet}```\n"
            with tree({"docs/cpp/a.md": page, "examples/cpp/a.cpp": program}) as root:
                self.assertEqual(len(check_snippets.check(root)[1]), faults, snippet)

    def test_a_recorded_failure_is_refused_unless_it_is_meant(self):
        mark = "<!-- meant to fail: they differ -->\n"
        block = "```console\n$ true\n$ {}\n{}```\n"
        good, bad = block.format("true", ""), block.format("false", "[exit code 1]\n")
        for text, line in ((good, None), (mark + bad, None), (bad, 3), (mark + good, 1),
                           (mark + "\n" + bad, 5), (good + bad, 7), (bad + mark + bad, 3)):
            found = list(check_snippets.failures("docs/a.md", text))
            self.assertEqual([fault.split(":")[1] for fault in found],
                             [] if line is None else [str(line)], text)
        with tree({"docs/a.md": bad}) as root:
            self.assertEqual(len(check_snippets.check(root)[1]), 1)


class Links(unittest.TestCase):
    def faults(self, text, **more):
        files = {"README.md": "[d](docs/a.md)\n", "docs/a.md": text, "docs/b/c.txt": "", **more}
        with tree(files) as root:
            return list(check_links.faults(root, [name for name in files if name.endswith(".md")]))

    def test_good(self):
        for text in ("[x](b/c.txt)", "[x](b)", "[x](../README.md)", "# A b\n[x](#a-b)",
                     "`[x](gone.md)`", "```\n[x](gone.md)\n```\n", "[x](mailto:a@b)",
                     "# `a.b`: c, d\n[x](a.md#ab-c-d)"):
            self.assertEqual(self.faults(text), [], text)

    def test_bad(self):
        for text in ("[x](gone.md)", "[x](../../etc)", "[x](#gone)", "[x](../README.md#gone)",
                     "![x](gone.svg)"):
            self.assertEqual(len(self.faults(text)), 1, text)

    def test_files_that_comments_cite(self):
        for text, count in (("// see base/a.h\n", 0), ("// see tenon/base/a.h\n", 0),
                            ("// see base/b.h and docs/b.md\n", 2), ('#include "base/b.h"\n', 0),
                            ("// include/mujoco/mujoco.h\n", 0), ("int b;  // base/b.h\n", 1)):
            files = {"tenon/base/a.h": text, "docs/a.md": "`tenon/base/a.h`\n"}
            with tree(files) as root:
                found = list(check_links.cited_faults(root, list(files)))
                self.assertEqual(len(found), count, text)

    def test_a_page_that_nothing_leads_to(self):
        self.assertEqual(len(self.faults("", **{"docs/lonely.md": "[a](a.md)"})), 1)


class Text(unittest.TestCase):
    HEAD = "".join(f"// {line}\n" for line in check_text.SPDX) + "#pragma once\n"

    def faults(self, path, text):
        return list(check_text.check_file(path, text))

    def test_good(self):
        self.assertEqual(self.faults("tenon/base/a.h", self.HEAD + "int x;\n"), [])

    def test_bad(self):
        for path, text in [
            ("tenon/base/a.h", "#pragma once\nint x;\n"),
            ("tenon/base/a.h", self.HEAD.replace("#pragma once\n", "int x;\n")),
            ("tenon/base/a.h", self.HEAD + "int x; \n"),
            ("tenon/base/a.h", self.HEAD + "\tint x;\n"),
            ("tenon/base/a.h", self.HEAD + "int x;"),
            ("tenon/base/a.h", self.HEAD + "// " + "x" * 98 + "\n"),
            ("tenon/base/a.h", self.HEAD + "// https:" + "//example.invalid/simple\n"),
            ("tenon/base/text_utils.h", self.HEAD),
            ("ARCHITECTURE.md", "x\n" * 151),
            ("README.md", "x\n" * 101),
            ("README.md", "pip install" " tenon-usd\n"),
            ("CHANGELOG.md", "x\n" * 151),
        ]:
            with self.subTest(path=path, text=text[-40:]):
                self.assertTrue(self.faults(path, text))


class Words(unittest.TestCase):
    """Phrases of the glossary's last column are found in prose, and their numbers only shrink."""
    RULES = check_words.avoided("| Word | Meaning | Not |\n|---|---|---|\n"
                                "| skipped | not used | `lost*`, `put ... aside` |\n"
                                "| body | a rigid body | link |\n")
    CASES = [
        # file, text, how many
        ("a.md", "It is lost.", 1),
        ("a.md", "Losting, LOST and a los.", 2),
        ("a.md", "`x.lost`, lost-and-found, part-lost, my_lost", 0),
        ("a.md", "They put all of it aside, and put one two three four aside.", 1),
        ("a.md", "A link may stay.", 0),
        ("a.md", "one\n\n```\nlost\n```\n", 0),
        ("tenon/a.cpp", "int lost;  // lost\n", 1),
        ("tenon/a.cpp", "f(\"it is lost\", lost);\n", 1),
        ("tenon/folders.txt", "# lost\n", 1),
    ]

    def test_prose(self):
        for path, text, count in self.CASES:
            with self.subTest(path=path, text=text):
                self.assertEqual(len(check_words.places(path, text, self.RULES)), count)

    def test_place(self):
        self.assertEqual(check_words.places("a.md", "one\nis lost\n", self.RULES),
                         ['a.md:2: "lost"; write: skipped'])

    def test_files(self):
        held = ["a.md", "docs/a.md", "tenon/a.h", "cli/a.cpp", "tenon/folders.txt", "tenon/a.def"]
        free = ["docs/glossary.md", "tests/a.cpp", "tenon/generated/a.h", "tools/a.py"]
        self.assertEqual([name for name in held + free if check_words.is_held(name)], held)

    def test_numbers_only_shrink(self):
        left = check_words.read_left("# head\n2 a.md\n1 b.md\n1 c.md\n")
        found = {"a.md": ["1"], "b.md": ["1", "2"], "c.md": [], "d.md": ["1"]}
        self.assertEqual(check_words.too_many(found, left), ["1", "2", "1"])
        self.assertEqual(check_words.lowered(left, found), {"a.md": 1, "b.md": 1})

    def test_the_glossary_itself(self):
        rules = check_words.avoided(check_words.read(check_words.GLOSSARY))
        self.assertGreater(len(rules), 50)
        for phrase in ("is left out", "what is seen", "takes meshes apart", "Whoever reads it"):
            self.assertTrue(any(rule.search(phrase) for rule, _ in rules), phrase)


class Tidy(unittest.TestCase):
    """What `--changed` takes for a change of code, which is judged again."""
    CODE = 'int a() { return 1; }  // one\n'

    def test_comments_alone(self):
        for other in ("/* 1 */ int a() { return 1; }\n",
                      "// What it does,\n// and why.\nint a() {\n  return 1;\n}\n"):
            with self.subTest(other=other):
                self.assertEqual(tidy.code_of(self.CODE), tidy.code_of(other))

    def test_messages(self):
        for before, after in (('f("no mesh", 1);', 'f("there is "\n  "no mesh", 1);'),
                              ('f("//one");', 'f("//two");')):
            self.assertEqual(tidy.code_of(before), tidy.code_of(after))

    def test_code(self):
        cases = [
            (self.CODE, "int a() { return 2; }  // one\n"),
            (self.CODE, "int a() { return 1; }  // NOLINT(some-check)\n"),
            ('f("//one", 1);', 'f("//one", 2);'),
            ('f("%d\\n");', 'f("%s\\n");'),
            ('#include "a.h"', '#include "b.h"'),
            ('f(R"x(a)" // 1)x");', 'f(R"x(a)" // 2)x");'),
            ("f('\"', 1);  // it's", "f('\"', 2);  // it's"),
            ("f(1'000'000, \"//1\", 1);", "f(1'000'000, \"//1\", 2);"),
            ("f(/* 1 */ 1);", "f(/* 1 */ 2);"),
        ]
        for before, after in cases:
            with self.subTest(before=before):
                self.assertNotEqual(tidy.code_of(before), tidy.code_of(after))

    def test_names(self):
        """A file that the commit has as it is, one whose text is gone, and one that is new."""
        name = "tools/tidy.py"
        with open(os.path.join(tidy.ROOT, name), encoding="utf-8") as file:
            commits = {"same": file.read(), "other": "int a;\n", "new": None}
        with mock.patch.object(tidy, "git", lambda _, at: commits[at.split(":")[0]]):
            changed = [commit for commit in commits if tidy.has_changed_code(name, commit)]
        self.assertEqual(changed, ["other", "new"])


if __name__ == "__main__":
    unittest.main()
