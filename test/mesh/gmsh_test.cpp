// Gmsh files: the four variants agree, every cell type is read, and each kind of bad file gets a clear
// message.
#include "ifsi/mesh/gmsh.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "mesh/measure.hpp"

namespace ifsi {
namespace {

using testing_mesh::boundary_is_exterior;
using testing_mesh::boundary_measures;
using testing_mesh::faces_conform;
using testing_mesh::volume;

const std::filesystem::path meshes = IFSI_DATA_DIR "/meshes";

std::string sample(const std::string& name) { return (meshes / name).string(); }

std::string content(const std::string& name) {
  std::ostringstream text;
  text << std::ifstream(sample(name), std::ios::binary).rdbuf();
  return text.str();
}

/// A file in the temporary directory that goes away with the object.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& content)
      : path_((std::filesystem::temp_directory_path() /
               ("ifsi_gmsh_" + std::to_string(reinterpret_cast<std::uintptr_t>(this)) + ".msh"))
                  .string()) {
    std::ofstream(path_, std::ios::binary) << content;
  }
  TemporaryFile(const TemporaryFile&) = delete;
  ~TemporaryFile() { std::filesystem::remove(path_); }
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// The complaint about a file with this content, without its path.
template <class Element = Tri1>
std::string complaint(const std::string& content, const GmshOptions& options = {}) {
  const TemporaryFile file(content);
  try {
    read_gmsh<Element>(file.path(), options);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::file);
    const std::string text = error.what();
    EXPECT_EQ(text.rfind(file.path() + ":", 0), 0u) << text;
    return text.substr(std::min(text.size(), file.path().size() + 1));
  }
  return "";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

#define EXPECT_CONTAINS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

TEST(Gmsh, AllVariantsGiveTheSameMesh) {
  const auto first = read_gmsh<Tri1>(sample("channel_22_ascii.msh"));
  EXPECT_TRUE(boundary_is_exterior(first));
  auto length = boundary_measures(first);
  EXPECT_NEAR(length["inlet side"], 1, 1e-12);
  EXPECT_NEAR(length["outlet"], 1, 1e-12);
  EXPECT_NEAR(length["walls"], 4, 1e-12);
  const int chords = static_cast<int>(std::lround(length["hole"] / (0.4 * std::sin(std::numbers::pi / 6))));
  EXPECT_EQ(chords, 6);
  EXPECT_NEAR(volume(first), 2 - testing_mesh::area_within_arcs(1, chords, 0.2), 1e-9);
  EXPECT_EQ(first.boundary_names.size(), 4u);
  EXPECT_EQ(first.region_names, (std::vector<std::string>{"fluid"}));
  for (const char* name : {"channel_22_binary.msh", "channel_41_ascii.msh", "channel_41_binary.msh"}) {
    const auto mesh = read_gmsh<Tri1>(sample(name));
    EXPECT_EQ(mesh.n_points(), first.n_points()) << name;
    EXPECT_EQ(mesh.n_cells(), first.n_cells()) << name;
    EXPECT_NEAR(volume(mesh), volume(first), 1e-12) << name;
    EXPECT_EQ(mesh.region_names, first.region_names) << name;
    for (auto& [boundary, measure] : boundary_measures(mesh))
      EXPECT_NEAR(measure, length[boundary], 1e-12) << name;
  }
}

/// The block 3 x 1 x 1: two regions, three named faces (one inside), the rest unnamed.
template <class Element>
void expect_block(const std::string& name) {
  SCOPED_TRACE(name);
  const auto mesh = read_gmsh<Element>(sample(name));
  EXPECT_TRUE(boundary_is_exterior(mesh));
  EXPECT_TRUE(faces_conform(mesh));
  EXPECT_NEAR(volume(mesh), 3, 1e-12);
  EXPECT_EQ(mesh.boundary_names.size(), 3u);
  auto area = boundary_measures(mesh);
  EXPECT_NEAR(area["inlet"], 1, 1e-12);
  EXPECT_NEAR(area["outlet"], 1, 1e-12);
  EXPECT_NEAR(area["default"], 12, 1e-12);
  EXPECT_NEAR(area["flux"], 9, 1e-12);
  const std::map<std::string, double> plane{{"inlet", 0}, {"outlet", 3}};
  for (const auto& face : mesh.boundary_faces) {
    const auto end = plane.find(mesh.boundary_names[face.boundary]);
    if (end == plane.end()) continue;
    for (int a : Element::face_nodes(face.local_face))
      EXPECT_NEAR(mesh.points[mesh.cells[face.cell][a]][0], end->second, 1e-14);
  }
  ASSERT_EQ(mesh.region_names.size(), 2u);
  for (int c = 0; c < mesh.n_cells(); ++c) {
    double x = 0;
    for (int a = 0; a < Element::n_vertices; ++a) x += mesh.cell_coordinates(c)[a][0] / Element::n_vertices;
    EXPECT_EQ(mesh.region_names[mesh.cell_region[c]], x < 1 ? "near" : "far");
  }
}

TEST(Gmsh, ReadsEverySolidCell) {
  expect_block<Tet1>("block_tet1.msh");
  expect_block<Tet2>("block_tet2.msh");
  expect_block<Hex1>("block_hex1.msh");
  expect_block<Hex2>("block_hex2.msh");
  expect_block<Wedge1>("block_wedge1.msh");
}

/// Order-2 nodes must lie where their reference coordinates put them in a straight cell: the node order is
/// right.
template <class Element, class Linear>
void expect_straight(const std::string& name) {
  const auto mesh = read_gmsh<Element>(sample(name));
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const auto X = mesh.cell_coordinates(c);
    std::array<Vec<double, Element::dim>, Linear::n_nodes> vertices;
    for (int a = 0; a < Linear::n_nodes; ++a) vertices[a] = X[a];
    for (int a = 0; a < Element::n_nodes; ++a) {
      const auto difference = X[a] - map<Linear>(Element::nodes[a], vertices);
      EXPECT_LT(dot(difference, difference), 1e-22) << "node " << a;
    }
  }
}

TEST(Gmsh, OrderTwoNodesAreInOurOrder) {
  expect_straight<Tet2, Tet1>("block_tet2.msh");
  expect_straight<Hex2, Hex1>("block_hex2.msh");
}

/// Two squares side by side, each region with its own number; the right-hand sides unnamed, one line inside.
const std::string two_quads = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
1 7 "left end"
2 1 "metal"
$EndPhysicalNames
$Comment
anything
$EndComment
$Nodes
8
10 0 0 1
20 1 0 1
30 2 0 1
40 0 1 1
50 1 1 1
60 2 1 1
70 5 5 5
80 0.5 0.5 1
$EndNodes
$Elements
6
1 15 2 0 1 80
2 1 2 7 1 10 40
3 1 2 7 1 20 50
4 1 2 9 1 30 60
5 3 2 1 1 10 20 50 40
6 3 2 2 1 20 30 60 50
$EndElements
)";

TEST(Gmsh, GroupsWithoutNameAreCalledByNumberAndUnusedPointsGo) {
  const TemporaryFile file(two_quads);
  const auto mesh = read_gmsh<Quad1>(file.path());
  EXPECT_EQ(mesh.n_points(), 6);
  EXPECT_EQ(mesh.region_names, (std::vector<std::string>{"metal", "2"}));
  EXPECT_EQ(mesh.cell_region, (std::vector<int>{0, 1}));
  EXPECT_EQ(mesh.boundary_names, (std::vector<std::string>{"left end", "9", "default"}));
  auto length = boundary_measures(mesh);
  EXPECT_DOUBLE_EQ(length["left end"], 1);
  EXPECT_DOUBLE_EQ(length["9"], 1);
  EXPECT_DOUBLE_EQ(length["default"], 4);
}

TEST(Gmsh, ASurfaceTurnedOverIsTurnedBackButOneCellIsAnError) {
  auto text = replaced(two_quads, "10 20 50 40", "40 50 20 10");
  EXPECT_CONTAINS(complaint<Quad1>(text), "1 of 2 cells are inverted");
  text = replaced(text, "20 30 60 50", "50 60 30 20");
  const TemporaryFile file(text);
  const auto mesh = read_gmsh<Quad1>(file.path());
  EXPECT_NEAR(volume(mesh), 2, 1e-14);
  EXPECT_TRUE(boundary_is_exterior(mesh));
}

TEST(Gmsh, PeriodicNodesAreIdentifiedWhenAskedFor) {
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n8\n";
  for (int i = 0; i < 8; ++i)
    text += std::to_string(i + 1) + " " + std::to_string(i % 4) + " " + std::to_string(i / 4) + " 0\n";
  text += "$EndNodes\n$Elements\n3\n1 3 2 0 1 1 2 6 5\n2 3 2 0 1 2 3 7 6\n3 3 2 0 1 3 4 8 7\n$EndElements\n";
  const std::string periodic =
      text + "$Periodic\n1\n1 2 4\nAffine 1 0 0 3 0 1 0 0 0 0 1 0 0 0 0 1\n2\n4 1\n8 5\n$EndPeriodic\n";
  const TemporaryFile file(periodic);
  EXPECT_TRUE(read_gmsh<Quad1>(file.path()).point_node.empty());
  const auto mesh = read_gmsh<Quad1>(file.path(), {.periodic = true});
  EXPECT_EQ(mesh.node(3), mesh.node(0));
  EXPECT_EQ(mesh.node(7), mesh.node(4));
  EXPECT_NE(mesh.node(0), mesh.node(4));
  EXPECT_EQ(mesh.boundary_faces.size(), 6u);
  EXPECT_CONTAINS(complaint<Quad1>(text, {.periodic = true}), "$Periodic");
}

TEST(GmshErrors, MissingFile) {
  try {
    read_gmsh<Tri1>("no/such/file.msh");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::file);
    EXPECT_CONTAINS(std::string(error.what()), "no/such/file.msh");
  }
}

TEST(GmshErrors, NotAGmshFileOrAnotherVersion) {
  EXPECT_CONTAINS(complaint("hello\n"), "1: found \"hello\"; expected $MeshFormat");
  EXPECT_CONTAINS(complaint(""), "expected $MeshFormat");
  EXPECT_CONTAINS(complaint("$MeshFormat\n4 0 8\n$EndMeshFormat\n"), "version 4.0; expected 2.2 or 4.1");
  EXPECT_CONTAINS(complaint("$MeshFormat\n2.2 0 4\n$EndMeshFormat\n"), "data size 4");
  const std::string swapped("$MeshFormat\n2.2 1 8\n\0\0\0\1\n$EndMeshFormat\n", 40);
  EXPECT_CONTAINS(complaint(swapped), "byte order");
}

TEST(GmshErrors, OtherCells) {
  const auto text = complaint<Quad1>(content("channel_41_ascii.msh"));
  EXPECT_CONTAINS(text, "triangle of 3 nodes");
  EXPECT_CONTAINS(text, "expected cells of type \"quadrangle of 4 nodes\" (quad1) only");
  EXPECT_CONTAINS(complaint<Tri1>(content("block_tet1.msh")), "tetrahedron of 4 nodes");
  EXPECT_CONTAINS(complaint<Tet1>(content("channel_41_ascii.msh")), "no cells");
  EXPECT_CONTAINS(complaint<Quad1>(replaced(two_quads, "6 3 2 2 1 20 30 60 50", "6 2 2 2 1 20 30 60")),
                  "1 elements of type \"triangle of 3 nodes\"");
}

TEST(GmshErrors, BadNumbersAreFoundWithTheirLine) {
  EXPECT_CONTAINS(complaint<Quad1>(replaced(two_quads, "20 1 0 1", "20 1 x 1")),
                  "15: found \"x\"; expected a coordinate");
  EXPECT_CONTAINS(complaint<Quad1>(replaced(two_quads, "50 1 1 1", "50 nan 1 1")), "coordinates (nan");
  EXPECT_CONTAINS(complaint<Quad1>(replaced(two_quads, "20 30 60 50", "20 30 61 50")), "found node 61");
  EXPECT_CONTAINS(complaint<Quad1>(replaced(two_quads, "6 3 2 2 1", "6 77 2 2 1")), "element type 77");
  EXPECT_CONTAINS(complaint<Quad1>(replaced(two_quads, "$Nodes\n8", "$Nodes\n88888888")),
                  "count of 88888888 nodes");
  EXPECT_CONTAINS(complaint<Quad1>(replaced(two_quads, "$Nodes\n8", "$Nodes\n9")), "found \"$EndNodes\"");
  EXPECT_CONTAINS(complaint<Quad1>(replaced(two_quads, "$Nodes\n8", "$Nodes\n7")), "expected $EndNodes");
  EXPECT_CONTAINS(complaint<Quad1>(replaced(two_quads, "1 7 \"left end\"", "1 7 left")), "in quotes");
  EXPECT_CONTAINS(complaint<Quad1>(replaced(two_quads, "30 2 0 1", "30 2 0 3")), "plane");
}

TEST(GmshErrors, ATruncatedFileIsFoundWhereverItEnds) {
  for (const char* name :
       {"channel_22_ascii.msh", "channel_22_binary.msh", "channel_41_ascii.msh", "channel_41_binary.msh"}) {
    const std::string whole = content(name);
    ASSERT_GT(whole.size(), 1000u);
    for (size_t length = 0; length + 14 < whole.size(); length += 97)
      EXPECT_NE(complaint(whole.substr(0, length)), "") << name << " cut after " << length;
  }
}

TEST(GmshErrors, PartitionedMesh) {
  EXPECT_CONTAINS(complaint("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PartitionedEntities\n"), "partitioned");
}

}  // namespace
}  // namespace ifsi
