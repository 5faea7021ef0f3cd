// Distribution over ranks: nothing lost, nothing twice, the same mesh on any number of ranks.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "ifsi/mesh/distribute.hpp"
#include "ifsi/mesh/generators.hpp"

namespace ifsi {
namespace {

template <class Element>
GlobalMesh<Element> sample(bool periodic) {
  BoxOptions<Element::dim> options;
  options.periodic[0] = periodic;
  std::array<Axis, Element::dim> axes;
  for (int d = 0; d < Element::dim; ++d) axes[d] = geometric_axis(0, 1 + d, 3 + d, 2);
  return box<Element>(axes, options);
}

template <class Element>
class Distribute : public testing::Test {
 protected:
  const Communicator comm;

  static void check_all(const GlobalMesh<Element>& global) {
    SCOPED_TRACE(global.point_node.empty() ? "plain" : "periodic");
    const auto mesh = distribute(global, Communicator());
    expect_cells(global, mesh);
    expect_nodes(global, mesh);
    expect_halo(global, mesh);
    expect_boundaries(global, mesh);
  }

 private:
  /// Owned cells of all ranks are the cells of the input, each once, with the same coordinates.
  static void expect_cells(const GlobalMesh<Element>& global, const Mesh<Element>& mesh) {
    EXPECT_GE(mesh.n_owned_cells, 1);
    EXPECT_EQ(mesh.n_global_cells, global.n_cells());
    std::vector<int> owned(mesh.input_cell.begin(), mesh.input_cell.begin() + mesh.n_owned_cells);
    auto all = mesh.comm.all_gather(owned);
    std::sort(all.begin(), all.end());
    ASSERT_EQ(all.size(), global.cells.size());
    for (int c = 0; c < global.n_cells(); ++c) ASSERT_EQ(all[c], c);
    for (int c = 0; c < mesh.n_cells(); ++c) {
      ASSERT_EQ(mesh.cell_coordinates(c), global.cell_coordinates(mesh.input_cell[c]));
      for (int a = 0; a < Element::n_nodes; ++a) {
        ASSERT_EQ(mesh.point_node[mesh.cell_points[c][a]], mesh.cells[c][a]);
        ASSERT_EQ(mesh.input_point[mesh.cell_points[c][a]], global.cells[mesh.input_cell[c]][a]);
      }
    }
  }

  /// Every topological node has one global number, the same on each rank that knows it, and one owner.
  static void expect_nodes(const GlobalMesh<Element>& global, const Mesh<Element>& mesh) {
    std::set<int> topological;
    for (int p = 0; p < global.n_points(); ++p) topological.insert(global.node(p));
    EXPECT_EQ(mesh.nodes.n_global(), static_cast<long>(topological.size()));
    std::vector<std::array<long, 2>> pairs;
    for (int p = 0; p < mesh.n_points(); ++p)
      pairs.push_back({global.node(mesh.input_point[p]), mesh.nodes.global(mesh.point_node[p])});
    std::map<long, long> number, node;
    for (auto [topology, global_number] : mesh.comm.all_gather(pairs)) {
      EXPECT_EQ(number.emplace(topology, global_number).first->second, global_number);
      EXPECT_EQ(node.emplace(global_number, topology).first->second, topology);
    }
    EXPECT_EQ(number.size(), topological.size());
    if (global.point_node.empty()) {
      EXPECT_EQ(mesh.n_points(), mesh.n_nodes());
    }
    for (int i = mesh.n_owned_nodes() + 1; i < mesh.n_nodes(); ++i)
      EXPECT_LT(mesh.nodes.global(i - 1), mesh.nodes.global(i));
  }

  /// Each owned node sees all of its cells; ghost cells touch an owned node; the owner is the lowest rank.
  static void expect_halo(const GlobalMesh<Element>& global, const Mesh<Element>& mesh) {
    std::vector<std::array<int, 2>> rank_of_cell;
    for (int c = 0; c < mesh.n_owned_cells; ++c)
      rank_of_cell.push_back({mesh.input_cell[c], mesh.comm.rank()});
    std::vector<int> rank(global.n_cells());
    for (auto [cell, r] : mesh.comm.all_gather(rank_of_cell)) rank[cell] = r;
    std::map<int, int> uses, lowest;
    for (int c = 0; c < global.n_cells(); ++c)
      for (int p : global.cells[c]) {
        ++uses[global.node(p)];
        lowest[global.node(p)] = std::min(lowest.emplace(global.node(p), rank[c]).first->second, rank[c]);
      }
    std::map<int, int> seen;
    for (int c = 0; c < mesh.n_cells(); ++c) {
      bool touches = false;
      for (int a = 0; a < Element::n_nodes; ++a) {
        if (mesh.cells[c][a] >= mesh.n_owned_nodes()) continue;
        touches = true;
        ++seen[global.node(global.cells[mesh.input_cell[c]][a])];
      }
      EXPECT_TRUE(touches || c < mesh.n_owned_cells);
    }
    int owned = 0;
    for (auto [node, r] : lowest) {
      if (r != mesh.comm.rank()) continue;
      ++owned;
      EXPECT_EQ(seen[node], uses[node]);
    }
    EXPECT_EQ(owned, mesh.n_owned_nodes());
    EXPECT_EQ(static_cast<int>(seen.size()), owned);
  }

  /// Faces of local cells, and all local nodes of each boundary even where the face lives on another rank.
  static void expect_boundaries(const GlobalMesh<Element>& global, const Mesh<Element>& mesh) {
    ASSERT_EQ(mesh.boundary_names, global.boundary_names);
    std::set<std::array<int, 3>> expected, found;
    std::vector<std::set<int>> nodes(global.boundary_names.size());
    std::map<int, int> local_cell, local_node;
    for (int c = 0; c < mesh.n_cells(); ++c) local_cell[mesh.input_cell[c]] = c;
    for (int p = 0; p < mesh.n_points(); ++p)
      local_node[global.node(mesh.input_point[p])] = mesh.point_node[p];
    for (const auto& f : global.boundary_faces) {
      if (local_cell.contains(f.cell)) expected.insert({local_cell[f.cell], f.local_face, f.boundary});
      for (int a : Element::face_nodes(f.local_face)) {
        const auto it = local_node.find(global.node(global.cells[f.cell][a]));
        if (it != local_node.end()) nodes[f.boundary].insert(it->second);
      }
    }
    for (const auto& f : mesh.boundary_faces) found.insert({f.cell, f.local_face, f.boundary});
    EXPECT_EQ(found, expected);
    EXPECT_EQ(found.size(), mesh.boundary_faces.size());
    for (size_t b = 0; b < nodes.size(); ++b)
      EXPECT_EQ(mesh.nodes_on(mesh.boundary_names[b]), std::vector<int>(nodes[b].begin(), nodes[b].end()));
  }
};

using AllCells = testing::Types<Line1, Line2, Tri1, Tri2, Quad1, Quad2, Tet1, Tet2, Hex1, Hex2, Wedge1>;
TYPED_TEST_SUITE(Distribute, AllCells);

TYPED_TEST(Distribute, Box) { this->check_all(sample<TypeParam>(false)); }
TYPED_TEST(Distribute, PeriodicBox) { this->check_all(sample<TypeParam>(true)); }

TEST(DistributeMesh, GhostsFollowTheirOwners) {
  const auto mesh = distribute(channel_with_cylinder<Quad2>(CylinderChannel{}.refined(0.5)), Communicator());
  std::vector<Vec<double, 2>> x = mesh.points;
  for (int i = mesh.n_owned_nodes(); i < mesh.n_nodes(); ++i) x[i] = {-1, -1};
  mesh.nodes.update_ghosts(x.data());
  EXPECT_EQ(x, mesh.points);
}

TEST(DistributeMesh, RegionsComeAlong) {
  auto global = box<Quad1>({0, 0}, {1, 1}, {4, 4});
  global.region_names = {"a", "b", "c"};
  for (int c = 0; c < 16; ++c) global.cell_region.push_back(c % 3);
  const auto mesh = distribute(global, Communicator());
  EXPECT_EQ(mesh.region("c"), 2);
  for (int c = 0; c < mesh.n_cells(); ++c) EXPECT_EQ(mesh.cell_region[c], mesh.input_cell[c] % 3);
}

TEST(DistributeMesh, SizesAreThoseOfTheWholeMesh) {
  const auto mesh = distribute(box<Quad1>({Axis{0, 1, 1.25, 3}, Axis{0, 1, 2}}), Communicator());
  EXPECT_DOUBLE_EQ(mesh.h_min(), 0.25);
  EXPECT_DOUBLE_EQ(mesh.h_max(), std::sqrt(1.75 * 1.75 + 1));
}

TEST(DistributeMesh, PeriodicNodesHaveOnePlace) {
  const auto mesh = distribute(box<Quad1>({0, 0}, {1, 1}, {4, 4}, {{true, true}}), Communicator());
  EXPECT_EQ(mesh.nodes.n_global(), 16);
  const auto x = mesh.node_coordinates();
  for (int p = 0; p < mesh.n_points(); ++p)
    for (int d = 0; d < 2; ++d) EXPECT_EQ(std::remainder(mesh.points[p][d] - x[mesh.point_node[p]][d], 1), 0);
}

/// Nodes of a cell have near numbers: along the rows of this long box they would be 2^6 to 2^8 apart in the
/// mean.
TEST(DistributeMesh, NumberingIsLocal) {
  const auto mesh = distribute(box<Quad1>({0, 0}, {16, 1}, {256, 16}), Communicator());
  double spread = 0;
  for (int c = 0; c < mesh.n_owned_cells; ++c) {
    const auto [low, high] = std::minmax_element(mesh.cells[c].begin(), mesh.cells[c].end());
    spread += std::log2(1.0 + *high - *low);
  }
  EXPECT_LT(spread / mesh.n_owned_cells, 5);
}

TEST(DistributeMesh, WrongBoundaryNameGetsHelp) {
  const auto mesh = distribute(box<Quad1>({0, 0}, {1, 1}, {4, 4}), Communicator());
  try {
    (void)mesh.boundary("lef");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean \"left\""), std::string::npos);
  }
}

TEST(DistributeMesh, MoreRanksThanCellsIsRefused) {
  const Communicator comm;
  if (comm.size() == 1) return;
  EXPECT_THROW(distribute(box<Quad1>({0, 0}, {1, 1}, {1, 1}), comm), Error);
  const auto mesh = distribute(box<Quad1>({0, 0}, {1, 1}, {comm.size(), 1}), comm);
  EXPECT_EQ(mesh.n_owned_cells, 1);
}

}  // namespace
}  // namespace ifsi
