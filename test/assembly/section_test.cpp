#include "ifsi/assembly/section.hpp"

#include <gtest/gtest.h>

#include "ifsi/mesh/box.hpp"
#include "ifsi/mesh/distribute.hpp"
#include "ifsi/mesh/elevate.hpp"

namespace ifsi {
namespace {

class Sections : public testing::Test {
 protected:
  Sections() : mesh_(distribute(box<Tet1>({0, 0, 0}, {2, 3, 1}, {3, 4, 5}), Communicator())) {
    for (const auto& x : mesh_.node_coordinates()) u_.insert(u_.end(), {1.0, 2.0 * x[0] - x[1] + 5.0 * x[2]});
  }
  Mesh<Tet1> mesh_;
  std::vector<double> u_;  // two components per node: 1, and a linear function
};

TEST_F(Sections, IntegrateLinearFieldsExactly) {
  for (double z : {0.01, 0.2, 0.31, 0.5, 0.99}) {  // between nodes and through them
    const Section<Tet1> cut(mesh_, 2, z);
    EXPECT_NEAR(cut.area(), 6.0, 1e-12) << z;
    EXPECT_NEAR(cut.integral(u_, 2, 0), 6.0, 1e-12);
    EXPECT_NEAR(cut.mean(u_, 2, 1), 2.0 - 1.5 + 5.0 * z, 1e-12) << z;
  }
  EXPECT_NEAR(Section<Tet1>(mesh_, 0, 0.77).mean(u_, 2, 1), 1.54 - 1.5 + 2.5, 1e-12);
}

TEST_F(Sections, OfCellsOfOrder2HoldTheEighthsOfThem) {
  const auto mesh = distribute(elevate<Tet2>(box<Tet1>({0, 0, 0}, {2, 3, 1}, {3, 4, 5})), Communicator());
  std::vector<double> u;
  for (const auto& x : mesh.node_coordinates())
    u.insert(u.end(), {2.0 * x[0] - x[1] + 5.0 * x[2], x[2] * x[2]});
  for (double z : {0.01, 0.2, 0.31, 0.5, 0.99}) {
    const Section<Tet2> cut(mesh, 2, z);
    EXPECT_NEAR(cut.area(), 6.0, 1e-12) << z;
    EXPECT_NEAR(cut.mean(u, 2, 0), 2.0 - 1.5 + 5.0 * z, 1e-12) << z;
    EXPECT_NEAR(cut.mean(u, 2, 1), z * z, 0.1 * 0.1 / 4.0 + 1e-12) << z;  // nodes 0.1 apart, linear between
  }
}

TEST_F(Sections, OutsideOfTheMeshAreRefused) {
  EXPECT_THROW(Section<Tet1>(mesh_, 2, 1.5), Error);
  EXPECT_THROW(Section<Tet1>(mesh_, 1, -0.1), Error);
}

}  // namespace
}  // namespace ifsi
