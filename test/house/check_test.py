"""tools/check.py finds each fault it is there for, and nothing in a tree without fault."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

CHECK = pathlib.Path(__file__).resolve().parents[2] / "tools" / "check.py"


class Check(unittest.TestCase):
    def run_on(self, **files):
        """Exit code and output of the checks on a tree with these files ('/' written as '__', '.' as '_DOT_')."""
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                path = pathlib.Path(folder, name.replace("__", "/").replace("_DOT_", "."))
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            done = subprocess.run([sys.executable, CHECK, folder], capture_output=True, text=True, check=False)
            return done.returncode, done.stdout + done.stderr

    def assert_fault(self, expected, **files):
        code, output = self.run_on(**files)
        self.assertEqual(code, 1, output)
        self.assertIn(expected, output)
        self.assertEqual(output.count("\n"), 1, output)

    def test_nothing_wrong(self):
        code, output = self.run_on(
            include__ifsi__core__a_DOT_hpp="int f();\n",
            include__ifsi__mesh__b_DOT_hpp='#include "ifsi/core/a.hpp"\n// (eq. 1)\n',
            src__b_DOT_cpp='#include "ifsi/mesh/b.hpp"\n#include <metis.h>\n',
            docs__equations_DOT_md="**(eq. 1)** x = 1\n\n[self](equations.md)\n")
        self.assertEqual((code, output), (0, ""))

    def test_include_upwards(self):
        self.assert_fault("include/ifsi/core/a.hpp:2: core/ may not include ifsi/mesh/b.hpp",
                          include__ifsi__core__a_DOT_hpp='#pragma once\n#include "ifsi/mesh/b.hpp"\n')

    def test_io_and_assembly_are_side_by_side(self):
        self.assert_fault("io/ may not include ifsi/assembly/b.hpp",
                          include__ifsi__io__a_DOT_hpp='#include "ifsi/assembly/b.hpp"\n')

    def test_source_belongs_to_the_layer_of_its_header(self):
        self.assert_fault("src/a.cpp:2: linalg/ may not include ifsi/element/b.hpp",
                          src__a_DOT_cpp='#include "ifsi/linalg/a.hpp"\n#include "ifsi/element/b.hpp"\n')

    def test_unknown_layer(self):
        self.assert_fault("'utils' is no layer", include__ifsi__utils__a_DOT_hpp="")

    def test_cycle(self):
        self.assert_fault("include cycle",
                          include__ifsi__core__a_DOT_hpp='#include "ifsi/core/b.hpp"\n',
                          include__ifsi__core__b_DOT_hpp='#include "ifsi/core/a.hpp"\n')

    def test_standard_header_missing(self):
        self.assert_fault("include/ifsi/core/a.hpp:2: std::vector without #include <vector>",
                          include__ifsi__core__a_DOT_hpp="// std::map\nstd::vector<std::size_t> a, b;\n")

    def test_standard_header_by_another_of_ours(self):
        code, output = self.run_on(include__ifsi__core__a_DOT_hpp="#include <vector>\n",
                                   include__ifsi__core__b_DOT_hpp='#include "ifsi/core/a.hpp"\nstd::vector<int> b;\n')
        self.assertEqual((code, output), (0, ""))

    def test_hidden_library(self):
        self.assert_fault("<HYPRE_parcsr_ls.h> in a public header",
                          include__ifsi__linalg__a_DOT_hpp="#include <HYPRE_parcsr_ls.h>\n")

    def test_unknown_equation(self):
        self.assert_fault("a.hpp:1: (eq. 7) is not in docs/equations.md",
                          include__ifsi__core__a_DOT_hpp="// (eqs. 1, 7)\n",
                          docs__equations_DOT_md="**(eq. 1)** x = 1\n")

    def test_equation_defined_twice(self):
        self.assert_fault("(eq. 1) is defined 2 times", docs__equations_DOT_md="**(eq. 1)** x\n\n**(eq. 1)** y\n")

    def test_long_function(self):
        body = "".join(f"  g({i});\n" for i in range(80))
        for head in ["void f(int n) {\n", "template <class T>\nauto A<T>::f(T x) const -> T {\n",
                     "A::A(int n) : n_{n}, m_(n) {\n", "inline void f() {\n  for (;;) { g(0); }\n"]:
            tiny = "int a() { return 1; }\nint b() { return 1; }\n"
            self.assert_fault("include/ifsi/core/a.hpp:3: ",
                              include__ifsi__core__a_DOT_hpp=tiny + head + body + "}\n")

    def test_long_class_is_no_long_function(self):
        members = "".join(f'  int f{i}() {{ return "{{"[0]; }}  // {{\n' for i in range(100))
        code, output = self.run_on(include__ifsi__core__a_DOT_hpp=f"namespace a {{\nclass B {{\n{members}}};\n}}\n")
        self.assertEqual((code, output), (0, ""))

    def test_median(self):
        self.assert_fault("the median function has 12 lines", src__a_DOT_cpp="int f() {\n" + "  g();\n" * 10 + "}\n")

    def test_long_driver(self):
        self.assert_fault("a driver has at most 80 lines", drivers__a_DOT_cpp="\n" * 81,
                          docs__cases__a_DOT_md="", docs__cases__README_DOT_md="[a](a.md)")

    def test_driver_without_a_page(self):
        expected = "drivers/a.cpp:1: expected a page docs/cases/a.md"
        self.assert_fault(expected, drivers__a_DOT_cpp="")
        self.assert_fault(expected, drivers__a_DOT_cpp="", docs__cases__a_DOT_md="")

    def test_dead_link(self):
        self.assert_fault("README.md:2: the link to docs/nothing.md leads nowhere",
                          README_DOT_md="\n[x](docs/nothing.md#y) [z](https://example.org)\n")


if __name__ == "__main__":
    unittest.main()
