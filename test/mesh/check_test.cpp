// Unfit meshes are refused with what is wrong and where; names are looked up with help.
#include "ifsi/mesh/check.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "ifsi/mesh/box.hpp"
#include "ifsi/mesh/names.hpp"
#include "ifsi/mesh/partition.hpp"

namespace ifsi {
namespace {

/// What an action complains about, and with which exit code.
std::string complaint(const std::function<void()>& action, ExitCode expected = ExitCode::file) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), expected);
    return error.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A good box after one change, checked.
template <class Element = Quad1, class Change>
std::string complaint_after(Change change, const CheckOptions& options = {}) {
  auto mesh = [] {
    if constexpr (Element::dim == 2) return box<Element>({0, 0}, {3, 2}, {3, 2});
    if constexpr (Element::dim == 3) return box<Element>({0, 0, 0}, {3, 2, 1}, {3, 2, 1});
  }();
  change(mesh);
  return complaint([&] { check(mesh, options); });
}

TEST(Check, GoodMeshPasses) {
  EXPECT_EQ(complaint_after([](auto&) {}), "");
  EXPECT_EQ(complaint_after<Tet2>([](auto&) {}), "");
}

TEST(Check, InvertedCellIsNamedWithItsPlace) {
  const auto turned = complaint_after([](auto& m) { std::swap(m.cells[4][1], m.cells[4][3]); });
  EXPECT_TRUE(contains(turned, "1 of 6")) << turned;
  EXPECT_TRUE(contains(turned, "cell 4")) << turned;
  EXPECT_TRUE(contains(turned, "(1.0")) << turned;
}

TEST(Check, TangledAndFlatCellsAreFound) {
  // A vertex pulled beyond the opposite diagonal: the centre is still right-handed, a corner is not.
  EXPECT_TRUE(contains(complaint_after([](auto& m) { m.points[m.cells[0][0]] = {0.9, 0.9}; }), "cell 0"));
  EXPECT_TRUE(
      contains(complaint_after<Tri1>([](auto& m) { m.points[m.cells[0][0]] = m.points[m.cells[0][1]]; }),
               "inverted or flat"));
  EXPECT_TRUE(
      contains(complaint_after<Tet1>([](auto& m) { std::swap(m.cells[7][1], m.cells[7][2]); }), "cell 7"));
  // An order-2 cell whose mid node is pulled too far although its vertices are fine.
  EXPECT_TRUE(contains(complaint_after<Quad2>([](auto& m) {
                         m.points[m.cells[0][4]] = {0.9, 0};
                       }),
                       "cell 0"));
}

TEST(Check, DisconnectedPartIsNamed) {
  const auto separate = [](auto& m) {
    auto other = box<Quad1>({10, 0}, {11, 1}, {1, 1});
    for (auto& cell : other.cells)
      for (int& p : cell) p += m.n_points();
    m.points.insert(m.points.end(), other.points.begin(), other.points.end());
    m.cells.insert(m.cells.end(), other.cells.begin(), other.cells.end());
  };
  const auto text = complaint_after(separate);
  EXPECT_TRUE(contains(text, "2 disconnected parts") && contains(text, "cell 6") && contains(text, "(10.0"))
      << text;
  EXPECT_EQ(complaint_after(separate, {.connected = false}), "");
}

TEST(Check, BadNumbersAreNamed) {
  EXPECT_TRUE(contains(complaint_after([](auto& m) { m.points[5][1] = NAN; }), "point 5"));
  EXPECT_TRUE(contains(complaint_after([](auto& m) { m.points[5][0] = INFINITY; }), "finite"));
  EXPECT_TRUE(contains(complaint_after([](auto& m) { m.cells[2][1] = 99; }), "cell 2 names point 99"));
  EXPECT_TRUE(contains(complaint_after([](auto& m) { m.cells[2][1] = -1; }), "point -1"));
  EXPECT_TRUE(contains(complaint_after([](auto& m) { m.cells.clear(); }), "no cells"));
  EXPECT_TRUE(contains(complaint_after([](auto& m) { m.boundary_faces[0].boundary = 4; }), "boundary 4"));
  EXPECT_TRUE(contains(complaint_after([](auto& m) { m.boundary_faces[0].cell = 6; }), "cell 6"));
  EXPECT_TRUE(contains(complaint_after([](auto& m) { m.cell_region = {0}; }), "cell_region"));
  EXPECT_TRUE(contains(complaint_after([](auto& m) { m.point_node = {0}; }), "point_node"));
}

TEST(Check, UnusedPointIsNamedAndCanBeDropped) {
  const auto add = [](auto& m) {
    m.points.insert(m.points.begin() + 2, {7, 8});
    for (auto& cell : m.cells)
      for (int& p : cell) p += p >= 2;
  };
  const auto text = complaint_after(add);
  EXPECT_TRUE(contains(text, "point 2") && contains(text, "(7.0")) << text;
  EXPECT_EQ(complaint_after(add, {.points_used = false}), "");
  auto mesh = box<Quad1>({0, 0}, {3, 2}, {3, 2});
  const auto before = mesh;
  add(mesh);
  drop_unused_points(mesh);
  EXPECT_EQ(mesh.points, before.points);
  EXPECT_EQ(mesh.cells, before.cells);
}

TEST(Check, DroppingKeepsPeriodicNodes) {
  auto mesh = box<Quad1>({0, 0}, {3, 2}, {3, 2}, {{true, false}});
  const auto before = mesh;
  mesh.points.insert(mesh.points.begin(), {7, 8});
  for (auto& cell : mesh.cells)
    for (int& p : cell) ++p;
  for (int& node : mesh.point_node) ++node;
  mesh.point_node.insert(mesh.point_node.begin(), 0);
  drop_unused_points(mesh);
  EXPECT_EQ(mesh.cells, before.cells);
  EXPECT_EQ(mesh.point_node, before.point_node);
}

TEST(Check, MoreRanksThanCells) {
  EXPECT_NO_THROW(check_ranks(3, 3));
  const auto text = complaint([] { check_ranks(3, 4); }, ExitCode::configuration);
  EXPECT_TRUE(contains(text, "3 cells") && contains(text, "4 ranks")) << text;
}

TEST(Topology, AFaceOfThreeCellsIsRefused) {
  auto mesh = box<Quad1>({0, 0}, {2, 1}, {2, 1});
  mesh.cells.push_back(mesh.cells[0]);
  EXPECT_TRUE(contains(complaint([&] { exterior_faces(mesh); }), "more than two cells"));
}

TEST(Topology, DualGraphOfARow) {
  const CellGraph graph = dual_graph(box<Quad1>({0, 0}, {3, 1}, {3, 1}));
  EXPECT_EQ(graph.begin, (std::vector<int>{0, 1, 3, 4}));
  EXPECT_EQ(graph.adjacency, (std::vector<int>{1, 0, 2, 1}));
}

TEST(Partition, PartsAreFullAndConnectedCellsStayTogether) {
  const CellGraph graph = dual_graph(box<Quad1>({0, 0}, {1, 1}, {20, 20}));
  const auto part = partition_graph(graph.begin, graph.adjacency, 4);
  std::vector<int> size(4, 0);
  int cut = 0;
  for (int c = 0; c < 400; ++c) {
    ++size[part[c]];
    for (int k = graph.begin[c]; k < graph.begin[c + 1]; ++k) cut += part[c] < part[graph.adjacency[k]];
  }
  for (int n : size) EXPECT_NEAR(n, 100, 10);
  EXPECT_LT(cut, 60);  // two straight cuts need 40
}

TEST(Partition, EveryPartHasACellDownToOneEach) {
  for (int parts : {1, 2, 3, 5, 7}) {
    const CellGraph graph = dual_graph(box<Quad1>({0, 0}, {7, 1}, {7, 1}));
    const auto part = partition_graph(graph.begin, graph.adjacency, parts);
    std::vector<int> size(parts, 0);
    for (int p : part) ++size.at(p);
    for (int n : size) EXPECT_GE(n, 1) << parts << " parts";
  }
  EXPECT_TRUE(contains(complaint(
                           [] {
                             partition_graph({0, 0}, {}, 2);
                           },
                           ExitCode::configuration),
                       "2 parts"));
}

TEST(Names, WrongNameGetsTheListAndTheNearest) {
  const std::vector<std::string> names{"inlet", "outlet", "walls"};
  EXPECT_EQ(find_name("boundary", "outlet", names), 1);
  const auto ask = [&](const std::string& name, const std::vector<std::string>& all) {
    return complaint([&] { find_name("boundary", name, all); }, ExitCode::configuration);
  };
  const auto text = ask("wall", names);
  for (const char* part : {"boundary", "\"wall\"", "\"inlet\"", "did you mean \"walls\""})
    EXPECT_TRUE(contains(text, part)) << text;
  EXPECT_FALSE(contains(ask("somewhere else", names), "did you mean"));
  EXPECT_TRUE(contains(ask("wall", {}), "has none"));
}

}  // namespace
}  // namespace ifsi
