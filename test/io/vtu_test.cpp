// VTK files: what a reader unpacks is what was handed over.
#include "ifsi/io/vtu.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "expect_error.hpp"
#include "scratch_folder.hpp"
#include "vtu_reader.hpp"

namespace ifsi {
namespace {

using test::VtuReader;

/// Two triangles that share an edge.
VtuPiece two_triangles() {
  VtuPiece p;
  p.points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  p.connectivity = {0, 1, 2, 0, 2, 3};
  p.offsets = {3, 6};
  p.types = {5, 5};
  p.point_fields = {{"pressure", "Pa", 1, {0.1, 0.2, 0.3, 0.4}}};
  p.cell_fields = {{"stress", "Pa", 2, {1, 2, 3, 4}}};
  return p;
}

TEST(Vtu, ArraysUnpackToWhatWasWritten) {
  const test::ScratchFolder folder;
  const VtuPiece p = two_triangles();
  write_vtu(folder.file("a.vtu"), p, VtuPrecision::double_precision);
  const VtuReader file(folder.read("a.vtu"));
  EXPECT_EQ(file.count("NumberOfPoints"), 4);
  EXPECT_EQ(file.count("NumberOfCells"), 2);
  EXPECT_EQ(file.attribute("Name=\"pressure\"", "type"), "Float64");
  EXPECT_EQ(file.attribute("Name=\"stress\"", "NumberOfComponents"), "2");
  EXPECT_EQ(file.array<double>("Points"), p.points);
  EXPECT_EQ(file.array<double>("pressure"), p.point_fields[0].values);
  EXPECT_EQ(file.array<double>("stress"), p.cell_fields[0].values);
  EXPECT_EQ(file.array<long>("connectivity"), p.connectivity);
  EXPECT_EQ(file.array<long>("offsets"), p.offsets);
  EXPECT_EQ(file.array<unsigned char>("types"), p.types);
  EXPECT_NE(folder.read("a.vtu").find("<!-- pressure [Pa] -->"), std::string::npos);
}

TEST(Vtu, SinglePrecision) {
  const test::ScratchFolder folder;
  write_vtu(folder.file("a.vtu"), two_triangles(), VtuPrecision::single_precision);
  const VtuReader file(folder.read("a.vtu"));
  EXPECT_EQ(file.attribute("Name=\"pressure\"", "type"), "Float32");
  EXPECT_EQ(file.array<float>("pressure"), (std::vector<float>{0.1f, 0.2f, 0.3f, 0.4f}));
}

/// Sizes around the 2^17 bytes of a block, where a last block is partial, full, or absent.
TEST(Vtu, ArraysOfSeveralBlocks) {
  const test::ScratchFolder folder;
  for (const std::size_t n : {16383u, 16384u, 16385u, 32768u, 40000u}) {
    VtuPiece p;
    p.points.assign(3 * n, 0.0);
    VtuField f{"f", "-", 1, {}};
    for (std::size_t i = 0; i < n; ++i) f.values.push_back(static_cast<double>(i * i % 9973) / 7.0);
    p.point_fields = {f};
    write_vtu(folder.file("a.vtu"), p, VtuPrecision::double_precision);
    EXPECT_EQ(VtuReader(folder.read("a.vtu")).array<double>("f"), f.values) << n;
  }
}

TEST(Vtu, EmptyPieceOfARankWithoutCells) {
  const test::ScratchFolder folder;
  write_vtu(folder.file("a.vtu"), VtuPiece{}, VtuPrecision::single_precision);
  const VtuReader file(folder.read("a.vtu"));
  EXPECT_EQ(file.count("NumberOfCells"), 0);
  EXPECT_TRUE(file.array<float>("Points").empty());
}

TEST(Vtu, FieldOfTheWrongSizeIsAMistakeOfTheCaller) {
  VtuPiece p = two_triangles();
  p.point_fields[0].values.pop_back();
  EXPECT_THROW(write_vtu("unused.vtu", p, VtuPrecision::single_precision), std::logic_error);
}

TEST(Vtu, UnwritableFile) {
  test::expect_error([] { write_vtu("/nonexistent/a.vtu", two_triangles(), VtuPrecision::single_precision); },
                     ExitCode::file, {"/nonexistent/a.vtu"});
}

TEST(VtuSeries, ResumeDropsTheFramesAfterTheRestart) {
  const test::ScratchFolder folder;
  VtuSeries first(Communicator(), folder.path(), "fluid");
  for (const double t : {0.0, 0.1, 0.2, 0.3}) first.write(t, two_triangles());
  VtuSeries second(Communicator(), folder.path(), "fluid");
  second.resume(0.2);
  second.write(0.25, two_triangles());
  const std::string index = folder.read("fluid.pvd");
  for (const char* entry : {"timestep=\"0.2\" part=\"0\" file=\"fluid_000002.vtu\"",
                            "timestep=\"0.25\" part=\"0\" file=\"fluid_000003.vtu\""})
    EXPECT_NE(index.find(entry), std::string::npos) << index;
  EXPECT_EQ(index.find("timestep=\"0.3\""), std::string::npos);
}

}  // namespace
}  // namespace ifsi
