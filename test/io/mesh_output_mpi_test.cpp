// Output and checkpoints of distributed meshes: each cell once, each value at its point, on any number of
// ranks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ifsi/io/mesh_checkpoint.hpp"
#include "ifsi/io/mesh_output.hpp"
#include "ifsi/mesh/box.hpp"
#include "ifsi/mesh/distribute.hpp"
#include "scratch_folder.hpp"
#include "vtu_reader.hpp"

namespace ifsi {
namespace {

using test::VtuReader;

/// Smooth, and the same at x = 0 and x = 1, so that it is a nodal field on a mesh periodic in x too.
template <int dim>
double value_at(const Vec<double, dim>& x) {
  double value = std::cos(2.0 * std::numbers::pi * x[0]);
  for (int d = 1; d < dim; ++d) value += (d + 1) * x[d];
  return value;
}

template <class Element>
GlobalMesh<Element> unit_box(int n, bool periodic) {
  constexpr int dim = Element::dim;
  Vec<double, dim> upper = Vec<double, dim>::zero();
  std::array<int, dim> cells;
  cells.fill(n);
  for (int d = 0; d < dim; ++d) upper[d] = 1.0;
  BoxOptions<dim> options;
  options.periodic[0] = periodic;
  return box<Element>(Vec<double, dim>::zero(), upper, cells, options);
}

/// (v, p) per node: v_i = (i + 1) f, p = -f.
template <class Element>
std::vector<double> state_of(const Mesh<Element>& mesh) {
  constexpr int dim = Element::dim;
  std::vector<double> state;
  for (const auto& x : mesh.node_coordinates()) {
    for (int d = 0; d < dim; ++d) state.push_back((d + 1) * value_at<dim>(x));
    state.push_back(-value_at<dim>(x));
  }
  return state;
}

template <class Element>
class MeshIo : public testing::Test {
 protected:
  static constexpr int dim = Element::dim;
  Communicator comm;
  test::ScratchFolder folder;

  [[nodiscard]] VtuReader my_piece(const std::string& frame) const {
    const std::string rank = "_000" + std::to_string(comm.rank());
    return VtuReader(folder.read(frame + (comm.size() > 1 ? rank : "") + ".vtu"));
  }
  void expect_values(const std::vector<double>& points, const std::vector<double>& v,
                     const std::vector<double>& p) {
    for (std::size_t i = 0; i < p.size(); ++i) {
      Vec<double, dim> x;
      for (int d = 0; d < dim; ++d) x[d] = points[3 * i + d];
      EXPECT_NEAR(p[i], -value_at<dim>(x), 1e-12);
      for (int d = 0; d < 3; ++d)
        EXPECT_NEAR(v[3 * i + d], d < dim ? (d + 1) * value_at<dim>(x) : 0.0, 1e-12);
    }
  }
  /// A sum over coordinates with incommensurable weights tells cells apart.
  void expect_each_cell_once(const VtuReader& file, long n_cells) {
    const auto points = file.array<double>("Points");
    const auto connectivity = file.array<long>("connectivity"), offsets = file.array<long>("offsets");
    std::vector<double> marks;
    long begin = 0;
    for (const long end : offsets) {
      double mark = 0.0;
      for (; begin < end; ++begin)
        for (int d = 0; d < 3; ++d) mark += std::sqrt(d + 1.0) * points[3 * connectivity[begin] + d];
      marks.push_back(mark);
    }
    marks = comm.all_gather(marks);
    std::sort(marks.begin(), marks.end());
    EXPECT_EQ(static_cast<long>(marks.size()), n_cells);
    const auto same = [](double a, double b) { return std::abs(a - b) < 1e-9; };
    EXPECT_EQ(std::adjacent_find(marks.begin(), marks.end(), same), marks.end()) << "a cell is there twice";
  }
};

using Elements = testing::Types<Tri1, Quad2, Wedge1>;
TYPED_TEST_SUITE(MeshIo, Elements);

TYPED_TEST(MeshIo, EachCellOnceAndEachValueAtItsPoint) {
  constexpr int dim = TypeParam::dim;
  for (const bool periodic : {false, true}) {
    const auto global = unit_box<TypeParam>(4, periodic);
    const auto mesh = distribute(global, this->comm);
    const std::vector<double> state = state_of(mesh);
    std::vector<double> rank(mesh.n_owned_cells, this->comm.rank());
    MeshOutput<TypeParam> output(mesh);
    output.node_field("velocity", "m/s", state.data(), dim + 1, 0, dim);
    output.node_field("pressure", "Pa", state.data(), dim + 1, 0, 1);
    output.node_field("pressure", "Pa", state.data(), dim + 1, dim, 1);  // takes the place of the first
    output.cell_field("rank", "-", rank.data());
    VtuSeries series(this->comm, this->folder.path(), "fluid", VtuPrecision::double_precision);
    series.write(0.5, output.piece());

    const VtuReader file = this->my_piece("fluid_000000");
    this->expect_values(file.template array<double>("Points"), file.template array<double>("velocity"),
                        file.template array<double>("pressure"));
    this->expect_each_cell_once(file, global.n_cells());
    EXPECT_EQ(file.count("NumberOfPoints") * 3,
              static_cast<long>(file.template array<double>("Points").size()));
    EXPECT_EQ(file.template array<double>("rank"), rank);
    for (const unsigned char type : file.template array<unsigned char>("types"))
      EXPECT_EQ(type, TypeParam::vtk_type);
    this->comm.barrier();
  }
}

TYPED_TEST(MeshIo, DisplacedPoints) {
  constexpr int dim = TypeParam::dim;
  const auto mesh = distribute(unit_box<TypeParam>(3, false), this->comm);
  const std::vector<double> u = state_of(mesh);
  MeshOutput<TypeParam> output(mesh);
  const std::vector<double> before = output.piece().points;
  output.displace(u.data(), dim + 1);
  output.node_field("u", "m", u.data(), dim + 1, 0, dim);
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_DOUBLE_EQ(output.piece().points[i], before[i] + output.piece().point_fields[0].values[i]);
}

TYPED_TEST(MeshIo, CheckpointReadsBackOnAnotherNumberOfRanks) {
  constexpr int dim = TypeParam::dim;
  for (const bool periodic : {false, true}) {
    const auto global = unit_box<TypeParam>(4, periodic);
    const auto mesh = distribute(global, this->comm);
    CheckpointWriter writer(this->comm);
    write_nodes(writer, "state", mesh, state_of(mesh).data(), dim + 1);
    const std::string path = writer.save(this->folder.path(), 1);
    for (const Communicator& readers : {this->comm, Communicator(MPI_COMM_SELF)}) {
      const auto other = distribute(global, readers);
      std::vector<double> state((dim + 1) * other.n_nodes(), 0.0);
      read_nodes(Checkpoint(readers, path), "state", other, state.data(), dim + 1);
      const std::vector<double> expected = state_of(other);
      for (std::size_t i = 0; i < state.size(); ++i) EXPECT_NEAR(state[i], expected[i], 1e-13);
    }
  }
}

TEST(MeshOutputSeries, ParallelFileNamesThePiecesAndFields) {
  const Communicator comm;
  const test::ScratchFolder folder;
  const auto mesh = distribute(unit_box<Tri1>(3, false), comm);
  const std::vector<double> state = state_of(mesh);
  MeshOutput<Tri1> output(mesh);
  output.node_field("velocity", "m/s", state.data(), 3, 0, 2);
  VtuSeries(comm, folder.path(), "fluid").write(0.0, output.piece());
  comm.barrier();
  const std::string file = comm.size() > 1 ? "fluid_000000.pvtu" : "fluid_000000.vtu";
  EXPECT_NE(folder.read("fluid.pvd").find("timestep=\"0\" part=\"0\" file=\"" + file + "\""),
            std::string::npos);
  if (comm.size() == 1) return;
  const std::string index = folder.read(file);
  EXPECT_NE(index.find("<PDataArray type=\"Float32\" Name=\"velocity\" NumberOfComponents=\"3\"/>"),
            std::string::npos);
  for (int r = 0; r < comm.size(); ++r) {
    const std::string piece = "fluid_000000_000" + std::to_string(r) + ".vtu";
    EXPECT_NE(index.find("<Piece Source=\"" + piece + "\"/>"), std::string::npos);
    EXPECT_TRUE(folder.has(piece));
  }
}

/// Compares nodes of the reference cell, scaled to [0, 1], with VTK's order as its file format defines the
/// cell types.
template <class Element>
void expect_node_order(const std::vector<std::array<double, 3>>& expected) {
  const bool simplex = Element::shape == Shape::triangle || Element::shape == Shape::tet;
  ASSERT_EQ(expected.size(), static_cast<std::size_t>(Element::n_nodes));
  for (std::size_t k = 0; k < expected.size(); ++k)
    for (int d = 0; d < Element::dim; ++d) {
      const double xi = Element::nodes[Element::vtk_order[k]][d];
      EXPECT_DOUBLE_EQ(simplex ? xi : 0.5 * (xi + 1.0), expected[k][d]) << "node " << k;
    }
}

/// VTK wants the first triangle of a wedge to look outwards, unlike our node order.
TEST(VtkNodeOrder, Wedge) {
  const auto mesh = distribute(unit_box<Wedge1>(2, false), Communicator(MPI_COMM_SELF));
  const MeshOutput<Wedge1> output(mesh);
  const VtuPiece& piece = output.piece();
  for (std::size_t cell = 0; cell < piece.types.size(); ++cell) {
    Mat<double, 3> edges;  // from node 0 to nodes 1, 2, 3
    for (int i = 0; i < 3; ++i)
      for (int d = 0; d < 3; ++d)
        edges(i, d) = piece.points[3 * piece.connectivity[6 * cell + i + 1] + d] -
                      piece.points[3 * piece.connectivity[6 * cell] + d];
    EXPECT_LT(det(edges), 0.0);
  }
}

TEST(VtkNodeOrder, QuadraticCells) {
  const double h = 0.5;
  expect_node_order<Tri2>({{0, 0}, {1, 0}, {0, 1}, {h, 0}, {h, h}, {0, h}});
  expect_node_order<Quad2>({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {h, 0}, {1, h}, {h, 1}, {0, h}, {h, h}});
  expect_node_order<Tet2>({{0, 0, 0},
                           {1, 0, 0},
                           {0, 1, 0},
                           {0, 0, 1},
                           {h, 0, 0},
                           {h, h, 0},
                           {0, h, 0},
                           {0, 0, h},
                           {h, 0, h},
                           {0, h, h}});
  expect_node_order<Hex2>({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1},
                           {0, 1, 1}, {h, 0, 0}, {1, h, 0}, {h, 1, 0}, {0, h, 0}, {h, 0, 1}, {1, h, 1},
                           {h, 1, 1}, {0, h, 1}, {0, 0, h}, {1, 0, h}, {1, 1, h}, {0, 1, h}, {0, h, h},
                           {1, h, h}, {h, 0, h}, {h, 1, h}, {h, h, 0}, {h, h, 1}, {h, h, h}});
}

}  // namespace
}  // namespace ifsi
